/// How long ago bodies are displayed, and that what is displayed of different moments is apart.

#include "common/sync/show/show_age.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/measure/screen/thresholds.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace show_age_test {

/// A player lacks so many newest ticks.
MissingInputs Missing(std::int64_t ticks) { return {{1, ticks}}; }

TEST(ShowAge, IsTheTimeForWhichInputsAreMissingAndAtMostWhatIsAsked) {
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.show_age_ticks = 12;
  for (const auto& [missing, due] : {std::pair{8, 8}, std::pair{40, 12}, std::pair{0, 0}}) {
    ShowAge ages(config);
    for (std::size_t tick = 0; tick < RecentAges::kAgesKept; ++tick) ages.Look(Missing(missing));
    EXPECT_EQ(ages.due(), due);
  }
}

TEST(ShowAge, BeginsWithTheGreatestSoThatItNeedNotRise) {
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.show_age_ticks = 8;
  ShowAge ages(config);
  for (int tick = 1; tick <= 30; ++tick) {
    ages.Look(Missing(std::min(tick, 7)));  // the first inputs arrive in tick 7
    EXPECT_EQ(ages.due(), 8);
  }
}

TEST(ShowAge, IsNotThatOfARareLateInput) {
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.show_age_ticks = 30;
  ShowAge ages(config);
  for (int tick = 0; tick < 90; ++tick) ages.Look(Missing(tick % 30 == 7 ? 25 : 6));
  EXPECT_EQ(ages.due(), 6);
}

/// What does not change is told every 6th tick, and a change within 2.
TEST(ShowAge, IsTheTimeThatChangesTake) {
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.show_age_ticks = 8;
  ShowAge ages(config);
  for (int tick = 0; tick < 200; ++tick) {
    if (tick % 20 == 0) ages.NoteLate(1, 2);
    ages.Look(Missing(2 + tick % 6));
  }
  EXPECT_EQ(ages.due(), 2);
  for (int tick = 0; tick < 200; ++tick) {
    if (tick % 10 == 0) ages.NoteLate(1, 7);
    ages.Look(Missing(2 + tick % 6));
  }
  EXPECT_EQ(ages.due(), 7) << "the line has become worse";
}

TEST(ShowAge, GlidesByAsMuchOfTheSpeedAsNobodyNotices) {
  EXPECT_EQ(ShowAge::Glide(90, 100, 9, 5), 91) << "it has its age";
  EXPECT_NEAR(ShowAge::Glide(90, 100, 0, 5), 91 + kUnseenShare, 1e-6);
  EXPECT_NEAR(ShowAge::Glide(90, 100, 30, 5), 91 - kUnseenShare, 1e-6);
  EXPECT_NEAR(ShowAge::Glide(90, 100, 30, 2 * kUnseenSpeed), 90.5, 1e-6);
  EXPECT_NEAR(ShowAge::Glide(90, 100, 30, 0), 90, 1e-6) << "it stands: no moment differs";
}

TEST(ShowAge, GlidesAtRatesThatTheMeasuresDoNotTakeForNoticed) {
  EXPECT_LT(kUnseenShare, kVelocityShareLong);
  EXPECT_LT(kUnseenSpeed, kVelocityFloor);
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
  // At 5 m/s a body moves by 8.3 cm in a tick: 4.5 cm in .54 ticks. Moments go by quarters.
  const std::vector<double> ages = Row({5, 5}).Ages({0, 8});
  EXPECT_EQ(ages[0], 0);
  EXPECT_NEAR(ages[1], 0.5, 0.01);
}

TEST(KeepApart, PassesOnFromEachMechanismToTheNext) {
  const std::vector<double> ages = Row({5, 5, 5}).Ages({0, 8, 8});
  EXPECT_NEAR(ages[1], 0.5, 0.01);
  EXPECT_NEAR(ages[2], 1, 0.01) << "4 cm in the one that is 4 cm in the first";
}

TEST(KeepApart, LeavesWhatComesNearerAndWhatStandsOrTurnsItsBack) {
  EXPECT_EQ(Row({0, -6}).Ages({0, 8}), (std::vector<double>{0, 8})) << "it was farther away";
  EXPECT_EQ(Row({6, 0}).Ages({0, 8}), (std::vector<double>{0, 8})) << "it stands where it stood";
  EXPECT_EQ(Row({6, 0.1f}).Ages({0, 8}), (std::vector<double>{0, 8})) << "1.3 cm";
  EXPECT_EQ(Row({6, 6}).Ages({8, 8}), (std::vector<double>{8, 8})) << "of the same moment";
}

}  // namespace show_age_test
}  // namespace seam
