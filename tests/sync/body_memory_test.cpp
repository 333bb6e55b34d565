#include "common/sync/body_memory.h"

#include <gtest/gtest.h>

#include "tests/support/small_world.h"

namespace seam {
namespace body_memory_test {

/// Two boxes glued together, a loose one beside them, and an anchored one.
const char* kBoxes =
    "[[part]]\nname = \"left\"\nbox = [1, 1]\nposition = [0, 0]\nvelocity = [1, 0]\n"
    "[[part]]\nname = \"right\"\nbox = [1, 1]\nposition = [1, 0]\nvelocity = [1, 0]\n"
    "[[part]]\nname = \"loose\"\nbox = [1, 1]\nposition = [5, 0]\n"
    "[[part]]\nname = \"fixed\"\nbox = [1, 1]\nposition = [9, 0]\nanchored = true\n"
    "[[joint]]\nname = \"glue\"\nkind = \"glue\"\na = \"left\"\nb = \"right\"\nstrength = 1000\n";
constexpr PartId kLeft = 0, kRight = 1, kLoose = 2, kFixed = 3;

Edit BreakTheGlue() { return Edit(BreakEdit{0}); }

Edit Free(PartId part) { return Edit(FreeEdit{part}); }

/// A track of which no field is as it was at first.
BodyTrack Lived(int seed) {
  BodyTrack track;
  track.last_impact_tick = seed + 1;
  track.heard_tick = seed + 2;
  track.dynamic_since = seed + 3;
  track.placed = false;
  track.priority = static_cast<float>(seed + 4);
  track.asleep_since = seed + 5;
  track.changed_at = -seed;
  track.pull.arrived = seed + 6;
  track.pull.memory.asked.x() = static_cast<float>(seed + 7);
  track.pull.memory.share = 0.5f;
  return track;
}

class BodyMemoryTest : public ::testing::Test {
 protected:
  BodyMemoryTest() {
    Steps(world_.get(), 3);
    for (int body = 0; body < world_->body_count(); ++body) {
      memory_.track(body) = Lived(100 * (body + 1));
    }
    memory_.Record();
  }

  void Apply(const Edit& edit) {
    const std::optional<BodyRemap> change = world_->Apply({edit});
    ASSERT_TRUE(change.has_value());
    bodies_.Renumber(*change);
  }
  BodyTrack& TrackOf(PartId assembly) { return memory_.track(world_->BodyOfId(assembly)); }

  std::unique_ptr<World> world_ = SmallWorld(kBoxes, "", "gravity = [0, 0]");
  SyncConfig config_ = MakeSyncConfig("buffer", "retrospect");
  BodyTable bodies_{*world_};
  BodyMemory memory_{config_, *world_, bodies_};
};

TEST_F(BodyMemoryTest, ARemapKeepsTheMemoryOfUnchangedBodies) {
  const int before = world_->BodyOfId(kLoose);
  Apply(BreakTheGlue());
  ASSERT_NE(world_->BodyOfId(kLoose), before) << "its number has changed";
  const BodyTrack& track = TrackOf(kLoose);
  EXPECT_EQ(track.last_impact_tick, 201);
  EXPECT_EQ(track.heard_tick, 202);
  EXPECT_EQ(track.dynamic_since, 203);
  EXPECT_FALSE(track.placed);
  EXPECT_EQ(track.priority, 204);
  EXPECT_EQ(track.asleep_since, 205);
  EXPECT_EQ(track.changed_at, -200);
  EXPECT_EQ(track.pull.arrived, 206);
  EXPECT_EQ(track.pull.memory.asked.x(), 207);
  EXPECT_EQ(track.pull.memory.share, 0.5f);
}

TEST_F(BodyMemoryTest, BothHalvesRememberImpactsButAreNotComparedWithThePast) {
  Apply(BreakTheGlue());
  for (const PartId half : {kLeft, kRight}) {
    const BodyTrack& track = TrackOf(half);
    EXPECT_EQ(track.last_impact_tick, 101);
    EXPECT_EQ(track.heard_tick, 102);
    EXPECT_FALSE(track.placed);
    EXPECT_EQ(track.priority, 104);
    EXPECT_EQ(track.dynamic_since, world_->tick());
    EXPECT_EQ(track.changed_at, 1);
    EXPECT_EQ(track.asleep_since, -1);
    EXPECT_EQ(track.pull.arrived, -1);
    const int body = world_->BodyOfId(half);
    EXPECT_EQ(memory_.ComparablePast(body, world_->tick() - 1), nullptr);
    ASSERT_NE(memory_.ComparablePast(body, world_->tick()), nullptr);
    EXPECT_EQ(memory_.ComparablePast(body, world_->tick())->position, world_->Read(body).position);
  }
}

TEST_F(BodyMemoryTest, AFreedBodyBeginsWithoutAHistoryAtItsPlace) {
  Apply(Free(kFixed));
  const BodyTrack& track = TrackOf(kFixed);
  EXPECT_EQ(track.last_impact_tick, kLongAgo);
  EXPECT_EQ(track.heard_tick, -1);
  EXPECT_TRUE(track.placed);
  EXPECT_EQ(track.priority, 0);
  EXPECT_EQ(track.changed_at, 1);
  EXPECT_EQ(track.dynamic_since, world_->tick());
  EXPECT_EQ(memory_.snapshots().newest_tick(world_->BodyOfId(kFixed)), world_->tick());
}

TEST(BodyMemoryCoupling, HoldsForAQuarterOfASecondAndThroughARemap) {
  const auto world = SmallWorld(
      "[[part]]\nname = \"ground\"\nbox = [20, 1]\nposition = [0, -0.5]\nanchored = true\n"
      "[[part]]\nname = \"lower\"\nbox = [1, 1]\nposition = [0, 0.51]\n"
      "[[part]]\nname = \"upper\"\nbox = [1, 1]\nposition = [0, 1.52]\n"
      "[[part]]\nname = \"far\"\nbox = [1, 1]\nposition = [8, 0.51]\n");
  const SyncConfig config = MakeSyncConfig("buffer", "retrospect");
  BodyTable bodies(*world);
  BodyMemory memory(config, *world, bodies);
  AuthorityTable table(world->composition(), bodies);
  AuthorityRecord other;
  other.authority = 1;
  table.Set(world->mechanism(1), other);
  for (int i = 0; i < 30; ++i) {
    world->Step();
    memory.RecordContacts(table);
  }
  const auto coupled = [&](PartId assembly) {
    return memory.Coupled(world->mechanism(world->BodyOfId(assembly)));
  };
  EXPECT_TRUE(coupled(1));
  EXPECT_TRUE(coupled(2));
  EXPECT_FALSE(coupled(3));
  table.Set(world->mechanism(1), AuthorityRecord{});  // from now on both are of one authority
  for (int i = 0; i < config.tick_hz / 4; ++i) {
    world->Step();
    memory.RecordContacts(table);
    EXPECT_TRUE(coupled(1)) << i;
  }
  const std::optional<BodyRemap> change = world->Apply({Free(0)});
  ASSERT_TRUE(change.has_value());
  bodies.Renumber(*change);
  EXPECT_TRUE(coupled(1));
  EXPECT_FALSE(coupled(3));
  world->Step();
  EXPECT_FALSE(coupled(1));
}

}  // namespace body_memory_test
}  // namespace seam
