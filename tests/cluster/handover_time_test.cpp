/// Measures a hand-over, from the revocation to the next grant.

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "client/embed/cluster.h"
#include "tests/support/pendulums.h"

namespace seam {
namespace handover_time_test {

TEST(HandOver, TakesOneRoundTripForAnyNumberOfMechanisms) {
  for (const int count : {1, 8, 60}) {
    ClusterConfig config;
    config.scene = "pendulums.toml";
    config.scene_text = Pendulums(count);
    config.impair = "demo";  // a round trip of 100 to 120 ms
    const std::vector<double> ms = HandOverMs(RunCluster(config));
    ASSERT_GT(ms.size(), 2u * static_cast<std::size_t>(count));
    const double per_second = static_cast<double>(ms.size()) / 20;
    const double median = ms[ms.size() / 2], worst = ms.back();
    std::printf("%5.1f hand-overs/s: median %.0f ms, worst %.0f ms\n", per_second, median, worst);
    EXPECT_LT(median, 160) << per_second << " hand-overs/s";
    EXPECT_LT(worst, 500) << per_second << " hand-overs/s: what is lost is repeated";
  }
}

}  // namespace handover_time_test
}  // namespace seam
