/// Checks the seeds that the processes of a soak share.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/soak.h"

namespace seam {
namespace soak_seeds_test {

TEST(SoakSeeds, ShardsRunEachSeedOnceBetweenThem) {
  if (std::getenv("SEAM_SOAK_SHARD") != nullptr) GTEST_SKIP() << "this test sets it";
  std::vector<int> whole(static_cast<std::size_t>(Soak(10)));
  std::iota(whole.begin(), whole.end(), 5);
  EXPECT_EQ(SoakSeeds(5, 10), whole);
  std::vector<int> all;
  for (const char* share : {"0/3", "1/3", "2/3"}) {
    setenv("SEAM_SOAK_SHARD", share, 1);
    const std::vector<int> some = SoakSeeds(5, 10);
    EXPECT_GE(some.size(), whole.size() / 3);
    all.insert(all.end(), some.begin(), some.end());
  }
  unsetenv("SEAM_SOAK_SHARD");
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, whole);
}

TEST(SoakSeeds, AShareThatIsNoneEndsTheProgram) {
  for (const char* share : {"3/3", "-1/3", "1", "1/3x", "", "a/b", "0/0"}) {
    EXPECT_EXIT(
        {
          setenv("SEAM_SOAK_SHARD", share, 1);
          SoakSeeds(1, 3);
        },
        testing::ExitedWithCode(2), "is not I/N")
        << share;
  }
}

}  // namespace soak_seeds_test
}  // namespace seam
