#include "common/sync/send_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/quantised.h"
#include "tests/support/small_world.h"

namespace seam {
namespace send_scheduler_test {

/// Boxes in a row, in free fall, 2 m apart; peer 0 has them all.
class Row {
 public:
  explicit Row(int count)
      : world(std::make_unique<World>(ParseScene(
            "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [0, 0]\nrepeat = {count = " +
                std::to_string(count) + ", step = [2, 0]}\n",
            "test.toml"))) {
    AuthorityRecord own;
    own.authority = kSelf;
    for (int m = 0; m < roles.table().count(); ++m) roles.table().Set(m, own);
  }

  static constexpr int kSelf = 1;  // the server tells all that it has

  /// Steps to the next send. Returns the ids that are told, ascending.
  std::vector<int> NextSend() {
    for (int i = 0; i < config.send_every(); ++i) {
      world->Step();
      scheduler.Collect();
    }
    std::vector<int> told;
    for (const States& states : scheduler.Take()) {
      told.insert(told.end(), states.id.begin(), states.id.end());
    }
    std::sort(told.begin(), told.end());
    return told;
  }

  std::unique_ptr<World> world;
  SyncConfig config = MakeSyncConfig("buffer", "retrospect");
  BodyTable bodies{*world};
  Roles roles{config, kSelf, -1, *world, bodies};
  BodyMemory memory{config, *world, bodies};
  std::vector<InputTrack> inputs;
  Activities activities{config, *world, roles, memory};
  Display display{config, *world, memory, activities};
  Drivers drivers{*world, roles};
  Replay replay{config, *world, roles, drivers, memory, display, inputs};
  Reach reach{config, *world, roles, drivers, inputs};
  SendScheduler scheduler{config, *world, roles, memory, reach, replay};
};

TEST(SendScheduler, BodiesTakeTurnsIfASendCannotHoldAll) {
  constexpr int kBodies = 240;
  Row row(kBodies);
  std::set<int> waiting;
  for (int send = 0; send < 10; ++send) {
    const std::vector<int> told = row.NextSend();
    const std::set<int> distinct(told.begin(), told.end());
    ASSERT_EQ(distinct.size(), kBodiesPerSend) << send;
    for (const int id : waiting) EXPECT_EQ(distinct.count(id), 1u) << id << " waited twice";
    waiting.clear();
    for (int id = 0; id < kBodies; ++id) {
      if (distinct.count(id) == 0) waiting.insert(id);
    }
    EXPECT_EQ(waiting.size(), kBodies - kBodiesPerSend);
  }
}

TEST(SendScheduler, AJustStruckBodyGoesFirst) {
  Row row(240);
  row.memory.track(239).last_impact_tick = 0;
  const std::vector<int> told = row.NextSend();
  EXPECT_EQ(told.back(), 239);
  EXPECT_EQ(told[told.size() - 2], static_cast<int>(kBodiesPerSend) - 2);
}

TEST(SendScheduler, SendsNeitherOthersBodiesNorUnplacedOnes) {
  Row row(4);
  AuthorityRecord other;
  other.authority = 2;
  row.roles.table().Set(row.world->mechanism(1), other);
  row.memory.track(2).placed = false;
  EXPECT_EQ(row.NextSend(), (std::vector<int>{0, 3}));
}

TEST(SendScheduler, NothingIsDueBetweenTwoSends) {
  Row row(2);
  row.world->Step();
  row.scheduler.Collect();
  EXPECT_TRUE(row.scheduler.Take().empty());
  row.world->Step();
  row.scheduler.Collect();
  EXPECT_FALSE(row.scheduler.Take().empty());
  EXPECT_TRUE(row.scheduler.Take().empty());
}

TEST(SendScheduler, ASleepingBodyIsSentWithItsPose) {
  Row row(1);
  BodyState rest = row.world->Read(0);
  rest.position.x() = 0.3001f;  // between two quanta
  row.world->Write(0, rest);
  row.world->SetAwake(0, false);
  int told = 0;
  for (int send = 0; send < 4; ++send) told += static_cast<int>(row.NextSend().size());
  EXPECT_EQ(told, 4);
  EXPECT_EQ(row.world->Read(0).position, rest.position) << "the wire's rounding is not its own";
  EXPECT_NE(row.world->Read(0).position, Quantised(rest).position);
}

TEST(SendScheduler, ABodyCommittedToRestIsNotSent) {
  Row row(2);
  row.world->SetAwake(0, false);
  row.memory.track(0).at_rest = true;
  for (int send = 0; send < 60; ++send) EXPECT_EQ(row.NextSend(), std::vector<int>{1});
  const std::vector<States> everything = row.scheduler.Everything();
  ASSERT_EQ(everything.size(), 1u);
  EXPECT_EQ(everything[0].id, std::vector<std::int32_t>{1}) << "a Rest says where the other lies";
}

}  // namespace send_scheduler_test
}  // namespace seam
