/// Impacts found by a replay are reported like those of the first step, and once.

#include <gtest/gtest.h>

#include "tests/support/wired_replicas.h"

namespace seam {
namespace impact_again_test {

/// A vase of bob's, half a metre in front of ann's sledge.
const char* const kVase = R"(
gravity = [0, 0]
[[player]]
name = "ann"
vehicle = "hers"
actions = [{button = 0, part = "hers", impulse = [40, 0]}]
[[player]]
name = "bob"
[[part]]
name = "hers"
box = [1, 1]
position = [0, 0]
density = 4
owner = "ann"
[[part]]
name = "vase"
box = [1, 1]
position = [1.5, 0]
owner = "bob"
health = 100
damage = {above = 1, factor = 1}
)";

/// Reports that bob makes while ann presses at tick 31 and is heard `late` ticks later.
std::vector<ImpactReport> Reports(std::int64_t late) {
  WiredReplicas room(ParseScene(kVase, "vase.toml"), MakeSyncConfig("buffer", "rollback"), late,
                     [](int peer, std::int64_t tick) {
                       return Input{0, 0, static_cast<std::int16_t>(peer == 1 && tick > 30)};
                     });
  std::vector<ImpactReport> all;
  while (room.at(0).tick() < 90) {
    room.Step();
    for (const ImpactReport& report : room.at(2).TakeImpactReports()) all.push_back(report);
  }
  EXPECT_GT(room.Read(2, "vase").velocity.x(), 5) << "it was struck";
  return all;
}

TEST(ImpactsAgain, AnImpactFoundOnlyByAReplayIsReportedAtItsTick) {
  const std::vector<ImpactReport> at_once = Reports(0), late = Reports(9);
  ASSERT_EQ(at_once.size(), 1u);
  ASSERT_EQ(late.size(), 1u) << "found in a replay only: the blow was over when it was heard of";
  EXPECT_EQ(late[0].tick, at_once[0].tick);
  EXPECT_EQ(late[0].dv, at_once[0].dv);
  EXPECT_EQ(late[0].id, at_once[0].id);
}

}  // namespace impact_again_test
}  // namespace seam
