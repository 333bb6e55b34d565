/// How long ago bodies are displayed, and that what is displayed of different moments is apart.

#include "common/sync/show/show_age.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/scripted_world.h"

namespace seam {
namespace show_age_test {

TEST(ShowAge, IsTheTimeForWhichInputsAreMissingAndAtMostWhatIsAsked) {
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.show_age_ticks = 12;
  for (const auto& [missing, due] : {std::pair{8, 8}, std::pair{40, 12}, std::pair{0, 0}}) {
    ShowAge ages(config);
    ages.Look(missing);
    EXPECT_EQ(ages.due(), due);
  }
}

TEST(ShowAge, IsNotThatOfARareLateInput) {
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.show_age_ticks = 30;
  ShowAge ages(config);
  for (int tick = 0; tick < 90; ++tick) ages.Look(tick % 30 == 7 ? 25 : 6);
  EXPECT_EQ(ages.due(), 6);
}

TEST(ShowAge, GlidesAtTheRatesOfItsLimits) {
  EXPECT_EQ(ShowAge::Glide(90, 100, 9), 91) << "it has its age";
  EXPECT_NEAR(ShowAge::Glide(90, 100, 0), 91 + double{kAgeFall}, 1e-6);
  EXPECT_NEAR(ShowAge::Glide(90, 100, 30), 91 - double{kAgeRise}, 1e-6);
}

/// Boxes of 1 m in a row along x at tick 100, without gravity: each touches the next. Each moves at
/// its speed (m/s) and has done so in the past.
class Row {
 public:
  explicit Row(std::vector<float> speeds)
      : speeds_(std::move(speeds)), row_(ParseScene(Text(), "row.toml")) {
    for (int i = 0; i < static_cast<int>(speeds_.size()); ++i) bodies_.push_back({Body(i)});
  }
  /// Returns the ages after KeepApart, of boxes that have these ages before, ticks.
  std::vector<double> Ages(const std::vector<double>& before) {
    std::vector<ShownMechanism> shown;
    for (std::size_t i = 0; i < before.size(); ++i)
      shown.push_back({&bodies_[i], kNow - before[i]});
    const auto pose_at = [this](int body, double moment) {
      BodyState pose = row_.world.Read(body);
      const float seconds = static_cast<float>(kNow - moment) * row_.world.dt();
      pose.position -= pose.velocity * seconds;
      return pose;
    };
    const double oldest = kNow - *std::max_element(before.begin(), before.end());
    KeepApart(row_.world, oldest, pose_at, &shown);
    std::vector<double> after;
    for (const ShownMechanism& each : shown) after.push_back(kNow - each.moment);
    return after;
  }

 private:
  static constexpr double kNow = 100;
  std::string Text() const {
    std::string text = "gravity = [0, 0]\n";
    for (std::size_t i = 0; i < speeds_.size(); ++i) {
      text += "[[part]]\nname = \"" + std::to_string(i) + "\"\nbox = [1, 1]\nposition = [" +
              std::to_string(i) + ", 0]\nvelocity = [" + std::to_string(speeds_[i]) + ", 0]\n";
    }
    return text;
  }
  int Body(int i) const { return row_.Body(std::to_string(i)); }

  std::vector<float> speeds_;
  ScriptedWorld row_;
  std::vector<std::vector<int>> bodies_;
};

TEST(KeepApart, ShowsWhatIsPushedSoLateThatTheOverlapIsNotNoticed) {
  // At 6 m/s a body moves by 10 cm in a tick: 3 cm in .3 ticks. Moments go by quarters.
  const std::vector<double> ages = Row({6, 6}).Ages({0, 8});
  EXPECT_EQ(ages[0], 0);
  EXPECT_NEAR(ages[1], 0.25, 0.01);
}

TEST(KeepApart, PassesOnFromEachMechanismToTheNext) {
  const std::vector<double> ages = Row({6, 6, 6}).Ages({0, 8, 8});
  EXPECT_NEAR(ages[1], 0.25, 0.01);
  EXPECT_NEAR(ages[2], 0.5, 0.01) << "3 cm in the one that is 3 cm in the first";
}

TEST(KeepApart, LeavesWhatComesNearerAndWhatStandsOrTurnsItsBack) {
  EXPECT_EQ(Row({0, -6}).Ages({0, 8}), (std::vector<double>{0, 8})) << "it was farther away";
  EXPECT_EQ(Row({6, 0}).Ages({0, 8}), (std::vector<double>{0, 8})) << "it stands where it stood";
  EXPECT_EQ(Row({6, 0.1f}).Ages({0, 8}), (std::vector<double>{0, 8})) << "1.3 cm";
  EXPECT_EQ(Row({6, 6}).Ages({8, 8}), (std::vector<double>{8, 8})) << "of the same moment";
}

}  // namespace show_age_test
}  // namespace seam
