/// LocalSession: server and clients in one process, driven by inputs, repeated bit for bit.

#include "client/embed/local_session.h"

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/measure/measure.h"

namespace seam {
namespace local_session_test {

Scene Crossing() { return LoadScene("scenes/crossing.toml"); }

/// Returns the last views of a session that is driven for a second and a half.
std::vector<View> Played(const LocalSessionConfig& config) {
  LocalSession session(Crossing(), config);
  session.RunToTick(30);
  session.SetInput(0, {127, 0, 0});
  session.RunToTick(90);
  std::vector<View> views;
  for (int peer = 0; peer <= session.client_count(); ++peer) {
    views.push_back(session.ViewOf(peer));
  }
  return views;
}

TEST(LocalSession, EqualCallsGiveEqualViewsAndOtherSeedsOthers) {
  LocalSessionConfig config;
  config.impair = "terrible";
  const std::vector<View> one = Played(config), again = Played(config);
  ASSERT_EQ(one.size(), 3u);
  config.seed = 2;
  const std::vector<View> other = Played(config);
  for (std::size_t peer = 0; peer < one.size(); ++peer) {
    ASSERT_FALSE(one[peer].id.empty());
    EXPECT_EQ(one[peer].x, again[peer].x);
    EXPECT_EQ(one[peer].angle, again[peer].angle);
  }
  EXPECT_TRUE(one[2].x != other[2].x || one[2].age != other[2].age);
}

TEST(LocalSession, AnInputReachesTheServerAndTheOtherPlayer) {
  const auto car_x = [](bool driven, int peer) {
    LocalSession session(Crossing(), {});
    session.RunToTick(1);
    if (driven) session.SetInput(0, {127, 0, 0});
    session.RunToTick(90);
    return session.ViewOf(peer).x;
  };
  for (int peer = 0; peer <= 2; ++peer) EXPECT_NE(car_x(true, peer), car_x(false, peer)) << peer;
}

TEST(LocalSession, KeepsARecordingThatCanBeMeasured) {
  LocalSessionConfig config;
  config.drive = "script";
  config.keep = true;
  LocalSession session(Crossing(), config);
  session.RunToTick(180);
  const Recording& recording = session.recording();
  EXPECT_GE(recording.last_tick, 150);
  EXPECT_EQ(recording.views.size(), 3u);
  const Measures m = Measure(recording, ComputeOracle(recording, JudgeOf(recording.room)));
  EXPECT_GT(m.compared, 1000);
  EXPECT_LT(m.error_rms_m, 5);
}

TEST(LocalSession, NamesTheMistakeOfEachSetting) {
  const auto why = [](const LocalSessionConfig& config) {
    try {
      LocalSession session(Crossing(), config);
    } catch (const OperatorError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  LocalSessionConfig config;
  config.mode = "bufer";
  EXPECT_NE(why(config).find("bufer"), std::string::npos);
  config = {};
  config.impair = "5g";
  EXPECT_NE(why(config).find("5g"), std::string::npos);
  config = {};
  config.drive = "keyboard";
  EXPECT_NE(why(config).find("inputs, script and bot"), std::string::npos);
  config = {};
  config.seed = -1;
  EXPECT_NE(why(config).find("seed"), std::string::npos);
  config = {};
  config.send_hz = 0;
  EXPECT_NE(why(config).find("send_hz"), std::string::npos);
  config = {};
  config.record = "/nowhere/x.lcm";
  EXPECT_NE(why(config).find("/nowhere/x.lcm"), std::string::npos);
  LocalSession good(Crossing(), {});
  EXPECT_THROW(good.SetInput(2, {}), OperatorError);
  EXPECT_THROW(good.ViewOf(3), OperatorError);
  EXPECT_THROW(good.ViewOf(-1), OperatorError);
}

TEST(LocalSession, SaysThatNobodyCanJoinOverANetworkThatLosesAll) {
  LocalSessionConfig config;
  config.impair = "loss=100%";
  LocalSession session(Crossing(), config);
  EXPECT_THROW(session.RunToTick(1), OperatorError);
}

}  // namespace local_session_test
}  // namespace seam
