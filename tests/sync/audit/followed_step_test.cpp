/// A walking character put at told states: its step follows them, and its turns are put right.

#include "common/sync/audit/followed_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/scene/character.h"
#include "common/sync/audit/spare_world.h"

namespace seam {
namespace followed_step_test {

const char* const kWalker = R"(
[solver]
substeps = 4
[[player]]
name = "ann"
vehicle = "body.torso"
[[part]]
name = "ground"
chain = [[-100, 50], [-100, 0], [100, 0], [100, 50]]
[[character]]
name = "body"
player = "ann"
position = [0, 0]
)";

Gain Apart(double metres) {
  Gain gain;
  gain.seconds = 0.033;
  gain.apart = metres;
  return gain;
}

/// Walks for `ticks` and puts its states into the spare world each second tick, changed by
/// `change`. Returns the greatest move of a limb beside physics, m, after the first second.
template <class Change>
double GreatestApart(int ticks, const Change& change) {
  const Topology topology(ParseScene(kWalker, "walker"));
  World world(topology);
  SpareWorld spare(topology, SpareWorld::Present::kNone);
  Input drive;
  drive.drive = 76;
  double greatest = 0;
  for (int tick = 1; tick <= ticks; ++tick) {
    world.SetInput(0, drive);
    world.Step();
    spare.Step([&](World* to) { to->SetInput(0, drive); });
    if (tick % 2 != 0) continue;
    std::vector<BodyState> told;
    for (const int body : spare.bodies(0)) told.push_back(world.Read(body));
    change(&told);
    const std::optional<Gain> gain = spare.Compare(0, {told.begin(), told.end()});
    if (gain && tick > 60) greatest = std::max(greatest, gain->apart);
    spare.Put(0, 1, told);
  }
  return greatest;
}

TEST(FollowedStep, AWalkersLimbsGoWhereTheToldStatesSay) {
  EXPECT_LT(GreatestApart(300, [](std::vector<BodyState>*) {}), 0.005);
}

TEST(FollowedStep, TurnsThatTheWireLosesArePutRight) {
  const auto turned = [](std::vector<BodyState>* told) {
    (*told)[kFootLeft].angle += 6.283185307f;
    (*told)[kLowerArmRight].angle -= 2 * 6.283185307f;
  };
  EXPECT_LT(GreatestApart(300, turned), 0.005);
}

TEST(FollowedStep, TheOtherFootIsTriedAndKeptIfItFits) {
  FollowedStep step;
  EXPECT_FALSE(step.Add(2, 30, Apart(0.002)));
  EXPECT_TRUE(step.Add(4, 30, Apart(0.08))) << "tries the other foot";
  EXPECT_FALSE(step.Add(6, 30, Apart(0.003))) << "keeps it";
  const std::optional<Gain> sum = step.Take();
  ASSERT_TRUE(sum);
  EXPECT_NEAR(sum->seconds, 2 * 0.033, 1e-6) << "not the trial";
  EXPECT_FALSE(step.Add(8, 30, Apart(0.08))) << "was tried lately";
  EXPECT_TRUE(step.Add(40, 30, Apart(0.08)));
  EXPECT_TRUE(step.Add(42, 30, Apart(0.07))) << "back";
}

TEST(FollowedStep, AnIntervalThatIsNotKnownSpoilsTheSum) {
  FollowedStep step;
  step.Add(2, 30, Apart(0.002));
  step.Add(4, 30, std::nullopt);
  EXPECT_FALSE(step.Take());
  step.Add(6, 30, Apart(0.002));
  EXPECT_TRUE(step.Take());
}

}  // namespace followed_step_test
}  // namespace seam
