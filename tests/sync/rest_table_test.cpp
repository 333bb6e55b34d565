/// RestTable: incremental sums equal the sums over everything.

#include "common/sync/rest/rest_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/random.h"
#include "common/sync/rest/rest_blocks.h"

namespace seam {
namespace rest_table_test {

template <class T>
std::uint64_t Add(const T& value, std::uint64_t hash) {
  return Fnv1a(&value, sizeof value, hash);
}

/// The hash of docs/protocol.md: id, epoch and the bits of the pose.
std::uint64_t HashOf(PartId id, const RestRecord& record) {
  if (!record.committed) return 0;
  std::uint64_t hash = Add(record.epoch, Add(id, Fnv1a("", 0)));
  hash = Add(record.pose.position.y(), Add(record.pose.position.x(), hash));
  hash = Add(record.pose.angle, hash);
  hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccdULL;
  return hash ^ (hash >> 33);
}

TEST(RestTable, TheIncrementalSumEqualsTheFullSum) {
  for (const int count : {1, 32, 33, 300}) {
    BodyTable bodies(count, 0);
    RestTable table(bodies);
    Random random(7);
    const auto below = [&](int end) { return static_cast<int>(random.Uniform(0, end)); };
    EXPECT_EQ(table.Hash(), 0u);
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
        table.Commit(body, 3 * body, below(70000), round, pose);
      }
      std::uint64_t sum = 0;
      for (int body = 0; body < count; ++body) sum += HashOf(3 * body, table.at(body));
      ASSERT_EQ(table.Hash(), sum) << count << ", round " << round;
    }
    BodyRemap change;
    change.bodies.resize(static_cast<std::size_t>(count));
    std::uint64_t sum = 0;
    for (int body = 0; body < count; ++body) {
      BodyOrigin& origin = change.bodies[static_cast<std::size_t>(body)];
      origin.body = body;
      origin.same = body % 2 == 0;
      if (body % 2 == 0) sum += HashOf(3 * body, table.at(body));
    }
    bodies.Renumber(change);
    EXPECT_EQ(table.Hash(), sum) << "what is another one rests no more";
    table.Clear();
    EXPECT_EQ(table.Hash(), 0u);
  }
}

/// Sums of weak hashes would not tell two swapped poses, or two equal changes, apart.
TEST(RestTable, TheHashTellsBodiesWithSwappedPosesApart) {
  const auto lies = [](float a, float b) {
    const BodyTable bodies(2, 0);
    RestTable table(bodies);
    table.Commit(0, 0, 1, 5, {Vec2(a, 0), 0, Vec2(0, 0), 0});
    table.Commit(1, 1, 1, 5, {Vec2(b, 0), 0, Vec2(0, 0), 0});
    return table.Hash();
  };
  EXPECT_NE(lies(1, 2), lies(2, 1));
  EXPECT_NE(lies(1, 1), lies(2, 2));
  EXPECT_EQ(lies(1, 2), lies(1, 2));
}

TEST(RestBlocks, EachBodyIsInOneBlockAndHasItsTurn) {
  for (const int bodies : {0, 1, 19, 20, 41, 1256, 65535}) {
    const int blocks = RestBlock::Of(bodies, 0).blocks;
    ASSERT_GE(blocks, 1);
    ASSERT_LE(blocks, kRestBlocksMax);
    int next = 0;
    for (int turn = 0; turn < blocks; ++turn) {
      const RestBlock at = RestBlock::Of(bodies, turn);
      EXPECT_EQ(at.begin(bodies), next);
      next = at.end(bodies);
      EXPECT_EQ(RestBlock::Of(bodies, turn + blocks).block, at.block);
    }
    EXPECT_EQ(next, bodies);
  }
}

TEST(RestBlocks, APersistentDifferenceIsALossAndAChangingOneIsInFlight) {
  const RestBlock first{2, 0}, second{2, 1};
  RestBlocks blocks;
  EXPECT_FALSE(blocks.Lost(0, 0, first, 1, 2));
  EXPECT_FALSE(blocks.Lost(0, 0, second, 5, 5));
  EXPECT_FALSE(blocks.Lost(900000, 900000, first, 1, 2)) << "too soon";
  EXPECT_TRUE(blocks.Lost(1000000, 1000000, first, 1, 2));
  EXPECT_FALSE(blocks.Lost(1100000, 1100000, first, 1, 2)) << "it is under way";
  EXPECT_TRUE(blocks.Lost(2000000, 2000000, first, 1, 2));
  EXPECT_FALSE(blocks.Lost(2100000, 2100000, second, 5, 6)) << "each block for itself";
  // Agreement, or a skipped block, restarts the count.
  EXPECT_FALSE(blocks.Lost(2900000, 2900000, first, 2, 2));
  EXPECT_FALSE(blocks.Lost(3000000, 3000000, first, 1, 2));
  blocks.Skip(first);
  EXPECT_FALSE(blocks.Lost(4000000, 4000000, first, 1, 2));
  // A block that changes at each check may have a loss, too.
  bool lost = false;
  for (std::uint64_t i = 1; i < 80 && !lost; ++i) {
    const std::int64_t now_us = 4000000 + static_cast<std::int64_t>(i) * 100000;
    lost = blocks.Lost(now_us, now_us, first, 10 + i, 2);
    EXPECT_FALSE(lost && i < 30);
  }
  EXPECT_TRUE(lost);
}

TEST(RestBlocks, ACommitmentThatWaitsForItsTurnIsNotSentAgain) {
  const RestBlock only{1, 0};
  RestBlocks blocks;
  for (int tenth = 0; tenth < 90; ++tenth) {
    const std::int64_t now_us = 100000 * tenth;
    EXPECT_FALSE(blocks.Lost(now_us, std::min<std::int64_t>(now_us, 900000), only, 1, 2)) << tenth;
  }
  EXPECT_TRUE(blocks.Lost(9000000, 1000000, only, 1, 2)) << "all of the first second is sent";
}

}  // namespace rest_table_test
}  // namespace seam
