#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "common/codec/codec.h"
#include "render/live_renderer.h"
#include "tests/support/child_process.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_live_test {

/// A renderer that is fed by hand, ten small frames a second.
class RenderLive : public ::testing::Test {
 protected:
  RenderLive() {
    options_.out = folder_ / "out";
    options_.fps = 10;
    options_.width_px = 480;
    options_.height_px = 270;
    options_.peer = 1;
    options_.fonts = kFontFolder;
    recording_.room.scene_text = synthetic::SceneText();
  }
  void SendRoom(LiveRenderer* live) {
    recording_.room.session = session_;
    live->Add(ChannelName("test", "room"), Encode(recording_.room));
  }
  /// Peer 1's view after a tick, as if it were after `claimed`.
  void SendView(LiveRenderer* live, int tick, std::int64_t claimed) {
    View view = recording_.views[1][tick];
    view.tick = claimed;
    view.session = session_;
    view.sequence = ++sequence_;
    live->Add(ChannelName("test", "view", 1), Encode(view));
  }
  void SendViews(LiveRenderer* live, int from, int to) {
    for (int tick = from; tick <= to; ++tick) {
      SendView(live, tick, tick);
      live->DrawDue();
    }
  }

  Folder folder_;
  RenderOptions options_;
  Recording recording_ = synthetic::MakeRecording(6);
  std::int32_t sequence_ = 0;
  std::int64_t session_ = 0;
};

TEST_F(RenderLive, GoesOnWithTheNextSessionWhenAServerIsStartedAnew) {
  LiveRenderer live(options_);
  session_ = 11;
  SendRoom(&live);
  SendViews(&live, 0, 30);
  EXPECT_EQ(live.frames(), 6);
  session_ = 22;
  SendRoom(&live);
  SendViews(&live, 0, 30);
  EXPECT_EQ(live.frames(), 12) << "of its own beginning, although its ticks are near";
  session_ = 11;
  SendViews(&live, 31, 60);
  EXPECT_EQ(live.frames(), 12) << "the session before is not shown again";
}

TEST_F(RenderLive, DrawsEachFrameAsSoonAsItsViewArrives) {
  LiveRenderer live(options_);
  live.DrawDue();
  EXPECT_FALSE(std::filesystem::exists(options_.out));  // nothing heard, nothing written
  SendRoom(&live);
  SendViews(&live, 0, 5);
  EXPECT_EQ(live.frames(), 1);
  SendViews(&live, 6, 6);
  EXPECT_EQ(live.frames(), 2);
  SendViews(&live, 7, 60);
  EXPECT_EQ(live.frames(), 11);
  EXPECT_EQ(live.skipped(), 0);
  EXPECT_EQ(ReadPng(options_.out + "/frame_00010.png").width_px, 480);
}

TEST_F(RenderLive, MeasuresErrorsTickByTickWhenItIsGivenAnOracle) {
  synthetic::WriteLog(folder_ / "oracle.lcm", synthetic::MakeOracleRecording());
  LiveRenderer blind(options_);
  options_.out = folder_ / "seeing";
  options_.oracle = folder_ / "oracle.lcm";
  LiveRenderer seeing(options_);
  for (LiveRenderer* live : {&blind, &seeing}) {
    SendRoom(live);
    SendViews(live, 0, 60);
  }
  const Image without = ReadPng(folder_ / "out/frame_00010.png");
  const Image with = ReadPng(folder_ / "seeing/frame_00010.png");
  EXPECT_GT(Differences(without, with, 20, 235, 460, 262), 40);  // the strip has a curve
}

TEST_F(RenderLive, SkipsFramesTooFarBehindAndCountsThem) {
  LiveRenderer live(options_);
  SendRoom(&live);
  SendView(&live, 0, 0);
  live.DrawDue();
  for (int tick = 1; tick <= 120; ++tick) SendView(&live, tick, tick);
  live.DrawDue();  // two seconds late: only the last half is drawn
  EXPECT_EQ(live.frames() + live.skipped(), 21);
  EXPECT_GE(live.skipped(), 13);
  EXPECT_GE(live.frames(), 5);
}

TEST_F(RenderLive, DropsAViewFromTheEndOfTime) {
  LiveRenderer live(options_);
  SendRoom(&live);
  SendViews(&live, 0, 30);
  SendView(&live, 31, kTickMax - 1);
  live.DrawDue();
  SendViews(&live, 31, 60);
  EXPECT_EQ(live.dropped(), 1);
  EXPECT_EQ(live.frames(), 11);
  EXPECT_EQ(live.skipped(), 0);
}

TEST_F(RenderLive, FollowsASessionThatBeginsAnew) {
  LiveRenderer live(options_);
  SendRoom(&live);
  for (int tick = 0; tick <= 60; ++tick) {
    SendView(&live, tick, 100000 + tick);
    live.DrawDue();
  }
  const int before = live.frames();
  EXPECT_EQ(before, 11);
  SendViews(&live, 0, 40);  // enough to be believed
  SendRoom(&live);
  SendViews(&live, 41, 100);
  EXPECT_GE(live.frames(), before + 10);  // at least the second from tick 41 on
  EXPECT_LE(live.frames(), before + 17);
}

TEST_F(RenderLog, LiveDrawsTheMessagesOfTheStockPlayer) {
  const char* const bin = std::getenv("SEAM_BIN");
  ChildProcess probe({"sh", "-c", "unshare -rn true && command -v lcm-logplayer"});
  if (bin == nullptr || !probe.Wait(10) || probe.exit_status() != 0)
    GTEST_SKIP() << "needs SEAM_BIN, a network namespace and lcm-logplayer";
  const std::string out = folder_ / "out";
  // A namespace of its own has multicast and disturbs nobody.
  const std::string commands =
      "ip link set lo up; ip route add 224.0.0.0/4 dev lo; \"$0\" --live "
      "-o \"$1\" --size 480x270 --fps 10 --seconds 60 & "
      "sleep 1; lcm-logplayer \"$2\"; wait $!";
  ChildProcess session({"unshare", "-rn", "env", "LCM_DEFAULT_URL=", "sh", "-c", commands,
                        std::string(bin) + "/seam-render", out, log_});
  ASSERT_TRUE(session.Wait(90)) << "hangs";
  ASSERT_EQ(session.exit_status(), 0) << session.output();
  EXPECT_NE(session.output().find(" frames in " + out), std::string::npos) << session.output();
  const std::vector<std::string> frames = Frames(out);
  EXPECT_GT(frames.size(), 5u);  // a busy machine may skip some
  EXPECT_LE(frames.size(), 31u);
  EXPECT_FALSE(frames.front() == frames.back()) << "nothing moved";
}

}  // namespace render_live_test
}  // namespace seam
