/// A walking character put at told states: its step follows them, and its turns are put right.

#include "common/sync/audit/followed_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
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

TEST(FollowedStep, OthersAreTriedAndKeptIfTheyFit) {
  FollowedStep step;
  EXPECT_FALSE(step.Add(2, 30, Apart(0.002)));
  EXPECT_EQ(step.Add(4, 30, Apart(0.08)), 0) << "tries the first other";
  EXPECT_EQ(step.Add(6, 30, Apart(0.05)), 1) << "and the next";
  EXPECT_FALSE(step.Add(8, 30, Apart(0.003))) << "keeps it";
  const std::optional<Gain> sum = step.Take();
  ASSERT_TRUE(sum);
  EXPECT_NEAR(sum->seconds, 2 * 0.033, 1e-6) << "not the trials";
  EXPECT_EQ(step.Add(10, 30, Apart(0.08)), 0) << "one that fitted may soon be wrong again";
  EXPECT_EQ(step.Add(12, 30, Apart(0.07)), 1);
  step.NoOther();
  EXPECT_FALSE(step.Add(14, 30, Apart(0.08))) << "all were tried lately";
  EXPECT_EQ(step.Add(44, 30, Apart(0.08)), 0);
}

/// The seat's numbers are behind the character's.
TEST(FollowedStep, OneThatLiesHasOtherStatesThanOneThatStands) {
  const std::string seat = R"(
[[part]]
name = "chair"
box = [0.5, 0.5]
position = [20, 0.25]
[[seat]]
name = "seat"
part = "chair"
button = 5
)";
  SpareWorld spare(Topology(ParseScene(kWalker + seat, "walker")), SpareWorld::Present::kAll);
  const int m = spare.world().mechanism(1);  // body 0 is the chair
  const auto others = [&] {
    int count = 0;
    while (spare.TryOther(m, count)) ++count;
    return count;
  };
  const auto step = [&](int ticks, int lift) {
    Input input;
    input.lift = static_cast<std::int8_t>(lift);
    for (int i = 0; i < ticks; ++i) spare.Step([&](World* to) { to->SetInput(0, input); });
  };
  step(30, 0);
  EXPECT_EQ(others(), 1) << "stands: the other foot";
  step(60, -127);
  EXPECT_EQ(others(), 1) << "limp";
  step(2, 0);
  EXPECT_EQ(others(), 3) << "has fallen: as it is, gets up, stands";
  int most = 0;
  for (int tick = 0; tick < 240; ++tick) {
    step(1, 0);
    most = std::max(most, others());
  }
  EXPECT_EQ(most, 5) << "gets up: as it is, lies on, two stages, is up";
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
