/// A room whose script has stopped is another room: no command gives figures of it.

#include <gtest/gtest.h>

#include <string>

#include "common/base/check.h"
#include "tests/lab/attack/attack.h"
#include "tests/lab/attack/honest.h"
#include "tests/lab/handover/handover.h"
#include "tests/lab/load/load.h"

namespace seam {
namespace lab_stopped_script_test {

ClusterConfig Room() {
  ClusterConfig config;
  config.scene = "stops";
  config.scene_text = R"(duration = 4
[[player]]
name = "ann"
vehicle = "a"
[[player]]
name = "bob"
vehicle = "b"
[[part]]
name = "ground"
chain = [[-50, 0], [50, 0]]
[[part]]
name = "a"
box = [1, 1]
position = [-4, 0.6]
[[part]]
name = "b"
box = [1, 1]
position = [4, 0.6]
[[script]]
name = "s"
code = "function on_tick(t) if t > 2 then error('gone') end end"
)";
  return config;
}

TEST(LabStoppedScript, EachCommandSaysSo) {
  const auto says = [](const auto& run) -> std::string {
    try {
      run();
    } catch (const OperatorError& error) {
      return error.what();
    }
    return "";
  };
  const std::string all[] = {
      says([] { MeasureLoad(Room()); }), says([] { MeasureHandOvers(Room()); }),
      says([] { RunHonest(Room(), false); }), says([] { RunAttack(Room(), "none"); })};
  for (const std::string& said : all) EXPECT_NE(said.find("gone"), std::string::npos) << said;
}

}  // namespace lab_stopped_script_test
}  // namespace seam
