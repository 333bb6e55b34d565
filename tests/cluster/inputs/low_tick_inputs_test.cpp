/// Mode central in rooms of long ticks: a lost datagram is no lost input.

#include <gtest/gtest.h>

#include <string>

#include "common/measure/measure.h"
#include "tests/lab/cluster.h"

namespace seam {
namespace low_tick_inputs_test {

/// Two sleds that their players push to and fro.
std::string Sleds(int tick_hz) {
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
chain = [[-90, 0], [90, 0]]
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
position = [2, 0.27]
owner = "bob"
[[thrust]]
name = "t2"
part = "c"
force = [4, 0]
player = "bob"
)";
}

TEST(LowTickInputs, ReachTheServerInTimeOver4g) {
  for (const int tick_hz : {10, 12, 15, 20}) {
    for (std::int64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(std::to_string(tick_hz) + " Hz, seed " + std::to_string(seed));
      ClusterConfig config;
      config.scene_text = Sleds(tick_hz);
      config.mode = "central";
      config.impair = "4g";
      config.seed = seed;
      config.send_hz = 10;
      const Recording run = RunCluster(config);
      const Measures m = Measure(run, ComputeOracle(run, JudgeOf(run.room)));
      EXPECT_EQ(m.inputs_late, 0);
      EXPECT_LT(m.error_own_m.value_or(9), 0.05) << "0.2 to 1.9 m where one was late";
    }
  }
}

}  // namespace low_tick_inputs_test
}  // namespace seam
