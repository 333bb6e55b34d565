/// scenes/regatta.toml and scenes/harbour.toml match their titles in one world.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/scripted_world.h"

namespace seam {
namespace water_scenes_test {

std::string With(std::string text, const std::string& what, const std::string& instead) {
  std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  for (; at != std::string::npos; at = text.find(what, at + instead.size())) {
    text.replace(at, what.size(), instead);
  }
  return text;
}

TEST(Regatta, TheThinBoatOutrunsTheThickOneOfTheSameDisplacement) {
  ScriptedWorld race("regatta");
  const World& w = race.world;
  EXPECT_NEAR(w.mass(race.Body("thin")), w.mass(race.Body("thick")),
              0.01 * double{w.mass(race.Body("thin"))});
  EXPECT_EQ(w.mass(race.Body("thin-hub")), w.mass(race.Body("thick-hub")));
  const float start = race.Read("thin").position.x();
  EXPECT_EQ(start, race.Read("thick").position.x());
  race.StepTo(13 * 60);
  const float thin = race.Read("thin").position.x(), thick = race.Read("thick").position.x();
  EXPECT_GT(thick, 5) << "both cross the seam";
  EXPECT_GT(thin - start, 1.15f * (thick - start));
  EXPECT_NEAR(race.Read("thin").angle, 0, 0.05) << "on an even keel";
}

TEST(Regatta, PaddlesWithoutDragMoveNothing) {
  // No cheating force: without drag the wheels turn and the boats stay.
  const std::string text =
      With(LoadScene("scenes/regatta.toml").text, "viscosity = 0.05\ndrag_tangent = 0.02",
           "viscosity = 0\ndrag_tangent = 0\ndrag_normal = 0");
  ScriptedWorld race(ParseScene(text, "regatta.toml"));
  const float start = race.Read("thin").position.x();
  const float angle = race.Read("thin-hub").angle;
  race.StepTo(5 * 60);
  EXPECT_LT(race.Read("thin-hub").angle, angle - 20) << "three turns at least";
  for (const char* boat : {"thin", "thick"}) {
    EXPECT_NEAR(race.Read(boat).position.x(), start, 0.1) << boat;
  }
}

TEST(Harbour, TheBoatCrossesTheSeamAndPushesFloaters) {
  ScriptedWorld harbour("harbour");
  const float crate = harbour.Read("crate.0").position.x();
  harbour.StepTo(10 * 60);
  EXPECT_LT(harbour.Read("boat").position.x(), 12);
  EXPECT_GT(harbour.Read("boat").position.x(), 1) << "its middle is in bob's region";
  EXPECT_GT(harbour.Read("crate.0").position.x(), crate + 5);
  EXPECT_LT(harbour.Read("wreck").position.y(), -4.5);
  harbour.StepTo(780);
  // Denser bodies float deeper.
  for (const char* cork : {"cork.0", "cork.1"}) EXPECT_GT(harbour.Read(cork).position.y(), 0.1);
  for (const char* awash : {"awash.0", "awash.1"}) {
    EXPECT_LT(harbour.Read(awash).position.y(), 0);
    EXPECT_GT(harbour.Read(awash).position.y(), -0.8);
  }
  const BodyState leaded = harbour.Read("leaded");
  const float lead = std::sin(leaded.angle) * 0.35f + std::cos(leaded.angle) * 0.35f;
  EXPECT_LT(lead, -0.2f) << "the lead hangs below";
  for (const char* cargo : {"cargo.0", "cargo.1"}) {
    EXPECT_GT(harbour.Read(cargo).position.y(), harbour.Read("deck").position.y()) << cargo;
  }
}

}  // namespace water_scenes_test
}  // namespace seam
