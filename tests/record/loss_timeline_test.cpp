/// Time and place of losses in a recording: each kind of loss is found at its channel and moment.

#include "common/record/loss_timeline.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "tests/support/made_recording.h"
#include "tests/support/program.h"
#include "tests/support/render_synthetic.h"

namespace seam {
namespace loss_timeline_test {

std::vector<Loss> OfKind(const std::vector<Loss>& losses, Loss::Kind kind) {
  std::vector<Loss> some;
  for (const Loss& loss : losses) {
    if (loss.kind == kind) some.push_back(loss);
  }
  return some;
}

TEST(LossTimeline, ACompleteRecordingHasNoLosses) {
  const std::vector<Loss> losses = FindLosses(MakeRecording(2, 64, Moving(1)));
  EXPECT_TRUE(losses.empty());
  EXPECT_EQ(FormatLosses(losses), "no losses\n");
}

TEST(LossTimeline, TicksWithoutAViewAreOneLossWithItsSpan) {
  Recording recording = MakeRecording(2, 128, Moving(1));
  recording.room.room = "r";
  for (const int tick : {32, 33, 34, 96}) recording.views[1].erase(tick);
  const std::vector<Loss> losses = FindLosses(recording);
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(losses[0].channel, "SEAM.r.view.1");
  EXPECT_EQ(losses[0].lost, 3);
  EXPECT_EQ(losses[0].from_s, 0.5);
  EXPECT_EQ(losses[0].to_s, 34 * kH);
  EXPECT_EQ(losses[1].lost, 1);
  EXPECT_EQ(losses[1].from_s, 1.5);
}

TEST(LossTimeline, StripsShowEachChannelFromTheSessionsStartToItsEnd) {
  const Loss early{Loss::Kind::kView, "SEAM.r.view.1", 0, 0.01, 3};
  const Loss late{Loss::Kind::kView, "SEAM.r.view.1", 9.9, 10, 40};
  const Loss spread{Loss::Kind::kNetwork, "to peer 2", 4, 6, 22};
  const std::string strips = FormatLossStrips({early, spread, late}, 10);
  const std::string dots(20, '.');
  // 10 s in 50 slices of 0.2 s: from 4 to 6 s are 11 slices, with 2 datagrams each.
  EXPECT_NE(strips.find("network  to peer 2      |" + dots + std::string(11, '2') +
                        std::string(19, '.') + "|\n"),
            std::string::npos)
      << strips;
  EXPECT_NE(strips.find("view     SEAM.r.view.1  |3" + std::string(48, '.') + "#|\n"),
            std::string::npos)
      << strips;
  EXPECT_EQ(strips.find("\n"), strips.find("10.0 s|\n") + 7) << strips;
  EXPECT_EQ(FormatLossStrips({}, 10), "");
  EXPECT_NE(FormatLossStrips({late}, 0), "") << "a session without a tick";
}

TEST(LossTimeline, InputsThatNeverCameAndDatagramsThatWereLostAreFound) {
  Recording recording = MakeRecording(1, 128, Moving(1));
  recording.room.room = "r";
  for (const std::int64_t first : {0, 4, 16}) {
    Inputs inputs;
    inputs.first_tick = first;
    inputs.drive = inputs.lift = {0, 0, 0, 0, 0, 0};
    inputs.buttons = {0, 0, 0, 0, 0, 0};
    recording.inputs[1][first] = inputs;
  }
  for (const int second : {0, 1, 2}) {
    Stats stats;
    stats.peer = 1;
    stats.tick = second * kHz;
    stats.datagrams_in = second * 90;
    stats.loss_ppm = second == 2 ? 100000 : 0;
    recording.stats[1].push_back(stats);
  }
  const std::vector<Loss> losses = FindLosses(recording);
  const std::vector<Loss> inputs = OfKind(losses, Loss::Kind::kInput);
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].channel, "SEAM.r.inputs.1");
  EXPECT_EQ(inputs[0].lost, 6) << "ticks 10 to 15";
  EXPECT_EQ(inputs[0].from_s, 10 * kH);
  const std::vector<Loss> network = OfKind(losses, Loss::Kind::kNetwork);
  ASSERT_EQ(network.size(), 1u);
  EXPECT_EQ(network[0].channel, "to peer 1");
  EXPECT_EQ(network[0].lost, 10) << "90 came, of a hundred";
  EXPECT_EQ(network[0].from_s, 1);
  EXPECT_EQ(network[0].to_s, 2);
}

TEST(LossTimeline, FindsMessagesThatTheLoggerMissedByTheirSequenceNumbers) {
  const Workspace folder;
  const std::string whole = folder / "whole.lcm", torn = folder / "torn.lcm";
  synthetic::WriteLog(whole, synthetic::MakeRecording(0));
  {
    LogReader reader(whole);
    LogWriter writer(torn);
    int view = 0;
    for (LogEvent event; reader.Next(&event);) {
      const bool of_client = event.channel == "SEAM.test.view.2";
      view += of_client ? 1 : 0;
      if (of_client && view >= 61 && view <= 65) continue;  // ticks 60 to 64
      writer.Publish(event.channel, event.timestamp_us, event.data);
    }
  }
  EXPECT_TRUE(OfKind(FindLosses(whole, ReadRecording(whole)), Loss::Kind::kBus).empty());
  const std::vector<Loss> losses = FindLosses(torn, ReadRecording(torn));
  const std::vector<Loss> bus = OfKind(losses, Loss::Kind::kBus);
  ASSERT_EQ(bus.size(), 1u);
  EXPECT_EQ(bus[0].channel, "SEAM.test.view.2");
  EXPECT_EQ(bus[0].lost, 5);
  EXPECT_NEAR(bus[0].from_s, 59 / 60.0, 1e-9);
  EXPECT_NEAR(bus[0].to_s, 65 / 60.0, 1e-9);
  ASSERT_EQ(OfKind(losses, Loss::Kind::kView).size(), 1u) << "the same, as ticks";
  EXPECT_NE(LossesCsv(losses).find("bus,SEAM.test.view.2,0.98"), std::string::npos);
  EXPECT_TRUE(Within(losses, {1.5, 2}).empty());
  EXPECT_EQ(Within(losses, {1, 1.01}).size(), 2u);
}

}  // namespace loss_timeline_test
}  // namespace seam
