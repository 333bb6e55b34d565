/// How long ago bodies are displayed: what the viewer drives, and may soon touch, in the present.

#include "common/sync/show/show_age.h"

#include <gtest/gtest.h>

#include "tests/support/scripted_world.h"

namespace seam {
namespace show_age_test {

/// ann's box, bob's `gap` m to its right, a crate that touches bob's, and one far away.
class Street {
 public:
  Street(float gap, int own_player, float bobs_speed = 0)
      : street(ParseScene(
            "gravity = [0, 0]\n"
            "[[player]]\nname = \"ann\"\nvehicle = \"hers\"\n"
            "[[player]]\nname = \"bob\"\nvehicle = \"his\"\n"
            "[[part]]\nname = \"hers\"\nbox = [1, 1]\n"
            "[[part]]\nname = \"his\"\nbox = [1, 1]\nposition = [" +
                std::to_string(1 + gap) + ", 0]\nvelocity = [" + std::to_string(bobs_speed) +
                ", 0]\n"
                "[[part]]\nname = \"crate\"\nbox = [1, 1]\nposition = [" +
                std::to_string(2.02f + gap) + ", 0]\nvelocity = [" + std::to_string(bobs_speed) +
                ", 0]\n"
                "[[part]]\nname = \"far\"\nbox = [1, 1]\nposition = [900, 0]\n",
            "street.toml")),
        bodies(street.world),
        roles(config, 1, own_player, street.world, bodies) {
    config.show_age_ticks = 12;
  }
  double Due(const std::string& part, std::int64_t missing = 8) {
    ages.Look(roles, missing);
    return ages.Due(street.world.mechanism(street.Body(part)));
  }

  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  ScriptedWorld street;
  BodyTable bodies;
  Roles roles;
  ShowAge ages{config, street.world, bodies};
};

TEST(ShowAge, IsTheTimeForWhichInputsAreMissingAndAtMostWhatIsAsked) {
  for (const char* part : {"his", "crate", "far"}) {
    EXPECT_EQ(Street(100, 0).Due(part), 8) << part;
    EXPECT_EQ(Street(100, 0).Due(part, 40), 12) << part;
    EXPECT_EQ(Street(100, 0).Due(part, 0), 0) << part;
  }
}

TEST(ShowAge, IsZeroForWhatTheViewerDrivesAndNearlyForMovingBodiesThatTouchIt) {
  Street near(0.02f, 0, 20);
  EXPECT_EQ(near.Due("hers"), 0);
  EXPECT_NEAR(near.Due("his"), 0.09, 0.001) << "it touches hers; 3 cm take it 0.09 ticks";
  EXPECT_NEAR(near.Due("crate"), 0.18, 0.001) << "it touches his, which touches hers";
  EXPECT_EQ(near.Due("far"), 8);
  Street bobs(0.02f, 1, 20);
  EXPECT_EQ(bobs.Due("his"), 0) << "he drives the other one";
  EXPECT_NEAR(bobs.Due("crate"), 0.09, 0.001);
  EXPECT_EQ(bobs.Due("hers"), 8) << "hers stands";
  Street watcher(0.02f, -1, 20);
  for (const char* part : {"hers", "his", "crate", "far"}) EXPECT_EQ(watcher.Due(part), 8) << part;
}

TEST(ShowAge, OfWhatHardlyMovesMayExceedThatOfWhatItTouches) {
  // At 0.6 m/s a body moves by 1 cm in a tick, at 6 mm/s by 3 cm in 300.
  EXPECT_NEAR(Street(0.02f, 0, 0.6f).Due("his"), 3, 0.01);
  EXPECT_EQ(Street(0.02f, 0, 0.006f).Due("his"), 8);
  EXPECT_EQ(Street(0.02f, 0, 0).Due("his"), 8) << "it stands";
}

TEST(ShowAge, GlidesAtTheRatesOfItsLimits) {
  EXPECT_EQ(ShowAge::Glide(90, 100, 9), 91) << "it has its age";
  EXPECT_NEAR(ShowAge::Glide(90, 100, 0), 91 + double{kAgeFall}, 1e-6);
  EXPECT_NEAR(ShowAge::Glide(90, 100, 30), 91 - double{kAgeRise}, 1e-6);
}

TEST(ShowAge, FallsInProportionToTheTimeThatIsLeft) {
  // His box is 2 m away and comes at 8 m/s: 0.24 s are 14.6 ticks, to a gap of 5 cm.
  Street comes(2, 0, -8);
  const double ticks = (2 - kPressGap) / 8 * 60;
  EXPECT_NEAR(comes.Due("his"), double{kAgeFall} * ticks, 0.05) << "boxes have a skin";
  EXPECT_LE(comes.Due("crate"), double{kAgeFall} * ticks + 0.28)
      << "the two that touch share an age";
  EXPECT_EQ(Street(2, 0, 8).Due("his"), 8) << "it goes away";
  EXPECT_EQ(Street(30, 0, -8).Due("his"), 8) << "more time is left than the fall takes";
}

}  // namespace show_age_test
}  // namespace seam
