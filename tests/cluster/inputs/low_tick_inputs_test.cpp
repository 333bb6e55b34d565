/// Mode central in rooms of long ticks: a lost datagram is no lost input.

#include <gtest/gtest.h>

#include <string>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"

namespace seam {
namespace low_tick_inputs_test {

/// Two sleds, `gap` m apart, that their players push to and fro; with a gap of 4 m they collide.
std::string Sleds(int tick_hz, int gap) {
  return "duration = 10\n[solver]\ntick_hz = " + std::to_string(tick_hz) + R"(
[[player]]
name = "ann"
region = [[-200, -50], [-0.01, 100]]
vehicle = "a"
script = [[0, {drive = 1}], [2, {drive = -1}], [3, {drive = 1}], [4.3, {drive = -1}]]
[[player]]
name = "bob"
region = [[0, -50], [200, 100]]
vehicle = "c"
script = [[0.4, {drive = 1}], [2.2, {drive = -1}], [3.6, {drive = 1}], [4.7, {drive = -1}]]
[[part]]
name = "ground"
chain = [[-290, 0], [290, 0]]
[[part]]
name = "a"
box = [1, 0.5]
position = [-2, 0.27]
owner = "ann"
[[thrust]]
name = "t"
part = "a"
force = [4, 0]
player = "ann"
[[part]]
name = "c"
box = [1, 0.5]
position = [)" +
         std::to_string(gap - 2) +
         R"(, 0.27]
owner = "bob"
[[thrust]]
name = "t2"
part = "c"
force = [4, 0]
player = "bob"
)";
}

Measures Played(const std::string& scene, const std::string& mode, std::int64_t seed) {
  ClusterConfig config;
  config.scene_text = scene;
  config.mode = mode;
  config.impair = "4g";
  config.seed = seed;
  config.send_hz = 10;
  const Recording run = RunCluster(config);
  return Measure(run, ComputeOracle(run, JudgeOf(run.room)));
}

TEST(LowTickInputs, ReachTheServerInTimeOver4g) {
  for (const int tick_hz : {10, 12, 15, 20, 30, 60}) {
    for (std::int64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(std::to_string(tick_hz) + " Hz, seed " + std::to_string(seed));
      const Measures m = Played(Sleds(tick_hz, 4), "central", seed);
      EXPECT_EQ(m.inputs_late, 0);
      EXPECT_LT(m.error_own_m.value_or(9), 0.05) << "0.09 to 1.9 m where one was late";
    }
  }
}

/// A sled apart is exact. One that pushes another's feels that player's input too, which is a round
/// trip old when it comes: nobody can know it earlier, and mode buffer does not. A session in which
/// a burst of losses made an input late says nothing about this.
TEST(LowTickInputs, LeaveAnOwnSledExactUnlessItPushesAnothers) {
  double central = 0, buffer = 0;
  int sessions = 0;
  for (const int tick_hz : {10, 15, 20, 30}) {
    for (std::int64_t seed = 1; seed <= 12; ++seed) {
      SCOPED_TRACE(std::to_string(tick_hz) + " Hz, seed " + std::to_string(seed));
      if (seed <= 5) {
        const Measures apart = Played(Sleds(tick_hz, 60), "central", seed);
        EXPECT_LT(apart.error_own_m.value_or(9), 0.001);
      }
      const Measures touching = Played(Sleds(tick_hz, 4), "central", seed);
      if (touching.inputs_late.value_or(1) != 0) continue;
      ++sessions;
      central += touching.error_own_m.value_or(9);
      buffer += Played(Sleds(tick_hz, 4), "buffer", seed).error_own_m.value_or(9);
    }
  }
  EXPECT_GT(sessions, 38);
  EXPECT_GT(buffer, 0.005 * sessions) << "or they never touch";
  EXPECT_LT(central, 1.25 * buffer);
}

}  // namespace low_tick_inputs_test
}  // namespace seam
