/// A holder is killed or cut off, in several rooms and over networks drawn from seeds: none of its
/// bodies stops for longer than 0.3 s or jumps by more than half a metre.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/lab/relief/vanish.h"
#include "tests/support/soak.h"

namespace seam {
namespace vanish_seeds_test {

constexpr int kSeeds = 4, kSeedsSoak = 20;
/// Limits after the holder's last state: stand still, s; jump, m.
constexpr double kStandsMax = 0.3, kJumpMax = 0.5;

TEST(VanishCluster, NoBodyStopsOrJumpsWhenAClientVanishes) {
  const int seeds = Soak(kSeeds) > kSeeds ? kSeedsSoak : kSeeds;
  for (const VanishKind& kind : VanishKinds()) {
    Vanished worst;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Vanished now = Vanish(kind, static_cast<std::uint64_t>(seed));
      EXPECT_TRUE(now.held) << kind.name << ", seed " << seed;
      EXPECT_GT(now.looked, 5 * 60) << kind.name << ", seed " << seed;
      EXPECT_LE(now.stands_s, kStandsMax) << kind.name << ", seed " << seed;
      EXPECT_LE(now.jump_m, kJumpMax) << kind.name << ", seed " << seed;
      worst.stands_s = std::max(worst.stands_s, now.stands_s);
      worst.jump_m = std::max(worst.jump_m, now.jump_m);
    }
    std::printf("  %-6s %d seeds: stands for %.3f s, jumps by %.3f m\n", kind.name, seeds,
                worst.stands_s, worst.jump_m);
  }
}

}  // namespace vanish_seeds_test
}  // namespace seam
