/// RestTable: the hash that is made anew only in part is the one over everything.

#include "common/sync/rest/rest_table.h"

#include <gtest/gtest.h>

#include "common/base/bytes.h"
#include "common/base/random.h"

namespace seam {
namespace {

template <class T>
std::uint64_t Add(const T& value, std::uint64_t hash) {
  return Fnv1a(&value, sizeof value, hash);
}

/// As docs/protocol.md has it: id, epoch and the bits of the pose of each that rests.
std::uint64_t HashOfAll(const RestTable& table, const World& world) {
  std::uint64_t hash = Fnv1a("", 0);
  bool any = false;
  for (int body = 0; body < world.body_count(); ++body) {
    const RestRecord& record = table.at(body);
    if (!record.committed) continue;
    any = true;
    hash = Add(record.epoch, Add(world.id(body), hash));
    hash = Add(record.pose.position.y(), Add(record.pose.position.x(), hash));
    hash = Add(record.pose.angle, hash);
  }
  return any ? hash : 0;
}

TEST(RestTable, AHashMadeAnewInPartIsTheOneOverEverything) {
  for (const int count : {1, 32, 33, 300}) {
    const World world(ParseScene("[[part]]\nname = \"ball\"\ncircle = 0.5\nrepeat = {count = " +
                                     std::to_string(count) + ", step = [2, 0]}\n",
                                 "balls.toml"));
    ASSERT_EQ(world.body_count(), count);
    RestTable table(count);
    Random random(7);
    const auto below = [&](int end) { return static_cast<int>(random.Uniform(0, end)); };
    EXPECT_EQ(table.Hash(world), 0u);
    for (int round = 0; round < 300; ++round) {
      for (int i = below(3); i > 0; --i) {
        const int body = below(count);
        if (random.Chance(0.3)) {
          table.End(body);
          continue;
        }
        BodyState pose;
        pose.position = Vec2(static_cast<float>(random.Uniform(-1, 1)),
                             static_cast<float>(below(9999)) * 0.01f);
        pose.angle = random.Chance(0.5) ? 0.0f : -0.0f;
        table.Commit(body, below(70000), round, pose);
      }
      ASSERT_EQ(table.Hash(world), HashOfAll(table, world)) << count << ", round " << round;
    }
    table.Clear();
    EXPECT_EQ(table.Hash(world), 0u);
  }
}

}  // namespace
}  // namespace seam
