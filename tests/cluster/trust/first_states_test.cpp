/// Honest states of a session's first ticks, of bodies that are fast at once.

#include <gtest/gtest.h>

#include "client/embed/cluster.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace first_states_test {

/// A sled that its engine accelerates by 240 m/s^2, and one that does nothing.
constexpr char kRocket[] = R"(
duration = 8
gravity = [0, 0]
[[player]]
name = "ann"
region = [[-200, -50], [-0.01, 100]]
[[player]]
name = "bob"
region = [[0, -50], [200, 100]]
[[part]]
name = "rocket"
box = [1, 1]
position = [-8, 2]
owner = "ann"
[[thrust]]
name = "engine"
part = "rocket"
force = [240, 0]
[[part]]
name = "wall"
box = [1, 9]
position = [20, 2]
anchored = true
)";

TEST(FirstStates, AreComparedWithTheServersCopyFromTickZeroOn) {
  for (const char* impair : {"perfect", "4g", "3g"}) {
    ClusterConfig config;
    config.scene_text = kRocket;
    config.impair = impair;
    config.trust = TrustMode::kAct;
    Cluster cluster(config);
    cluster.RunToTick(120);
    const auto& counts = ServerTestAccess::PlausibleOf(cluster.server()).counts();
    EXPECT_GT(counts.judged, 10) << impair;
    EXPECT_EQ(counts.refused, 0) << impair;
    EXPECT_EQ(counts.doubted, 0) << impair;
  }
}

}  // namespace first_states_test
}  // namespace seam
