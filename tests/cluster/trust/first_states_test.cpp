/// Honest states of a session's first ticks, of bodies that are fast at once.

#include <gtest/gtest.h>

#include <string>
#include <utility>

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

/// A lift of 16 m/s, and a ball that a script adds above it.
std::string LiftText(double period_s, int tick) {
  return R"(
duration = 6
[[player]]
name = "ann"
vehicle = "a"
region = [[-900, -50], [-0.01, 400]]
[[player]]
name = "bob"
vehicle = "b"
region = [[0, -50], [900, 400]]
[[part]]
name = "ground"
chain = [[-500, 0], [500, 0]]
[[part]]
name = "a"
box = [2, 1]
position = [-60, 0.52]
[[part]]
name = "b"
box = [0.6, 0.6]
position = [60, 0.4]
[[part]]
name = "lift"
box = [3, 0.3]
position = [0, 30]
anchored = true
[[joint]]
name = "rail"
kind = "kinematic"
b = "lift"
path = [[0, 0], [0, 20]]
period = )" +
         std::to_string(period_s) +
         R"(
[[script]]
name = "ball"
code = '''
function on_tick(t)
  if world.tick() == )" +
         std::to_string(tick) + R"( then
    world.add_part{name = "ball", circle = 0.3, position = {0.5, 44}}
  end
end
'''
)";
}

TEST(FirstStates, AreBelievedOfAPartThatALiftStrikes) {
  for (const auto& [period_s, tick] :
       {std::pair(2.5, 200), std::pair(2.5, 230), std::pair(3.0, 290)}) {
    for (const char* impair : {"perfect", "4g", "delay=150ms"}) {
      ClusterConfig config;
      config.scene_text = LiftText(period_s, tick);
      config.impair = impair;
      config.trust = TrustMode::kAct;
      Cluster cluster(config);
      cluster.RunToTick(360);
      const auto& counts = ServerTestAccess::PlausibleOf(cluster.server()).counts();
      EXPECT_GT(counts.judged, 10) << impair;
      EXPECT_EQ(counts.refused, 0) << impair << ", a lift of " << 40 / period_s << " m/s";
    }
  }
}

}  // namespace first_states_test
}  // namespace seam
