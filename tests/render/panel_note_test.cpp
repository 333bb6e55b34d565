/// The note in a panel's corner: the view's age, the network's jitter, the corrections so far.
#include "render/panel_note.h"

#include <gtest/gtest.h>

#include "render/playback/peer_report.h"
#include "tests/support/render_synthetic.h"

namespace seam {
namespace panel_note_test {

using namespace synthetic;

constexpr double kTick_s = 1.0 / 60;

Recording StepAtTick20() {
  Recording recording = MakeRecording(0);
  for (auto& [tick, view] : recording.views.at(2)) {
    for (std::size_t i = 0; i < view.id.size(); ++i)
      if (view.id[i] == 1 && tick >= 20) view.x[i] += 0.1f;
  }
  return recording;
}

TEST(PanelNote, CountsTheCorrectionsOfItsViewUpToItsMoment) {
  const Playback playback(StepAtTick20(), MakeScene(), MakeOracle());
  Page page = MakePage(playback, kViewAll);
  for (const Panel& panel : page.panels) EXPECT_FALSE(NoteOf(panel, 0).corrections);
  FindCorrections(&page);
  for (const Panel& panel : page.panels) {
    EXPECT_EQ(NoteOf(panel, 15 * kTick_s).corrections, 0);
    EXPECT_EQ(NoteOf(panel, 30 * kTick_s).corrections, panel.peer == 2 ? 1 : 0);
  }
}

TEST(PanelNote, HasNoCorrectionsWithoutAnOracle) {
  const Playback playback(StepAtTick20(), MakeScene(), std::nullopt);
  Page page = MakePage(playback, 2);
  FindCorrections(&page);
  EXPECT_FALSE(NoteOf(page.panels.front(), 1).corrections);
}

TEST(PanelNote, PrintsOnlyKnownValues) {
  EXPECT_EQ(TextOf({}), "");
  EXPECT_EQ(TextOf({std::nullopt, 9.2, std::nullopt, std::nullopt}), "jitter 9 ms");
  EXPECT_EQ(TextOf({43.4, 9.2, 1, std::nullopt}),
            "view age 43 ms  ·  jitter 9 ms  ·  1 correction");
  EXPECT_EQ(TextOf({43.4, 9.2, 1, 100.0}),
            "view age 43 ms  ·  others up to 100 ms ago  ·  jitter 9 ms  ·  1 correction");
  EXPECT_EQ(TextOf({0.0, std::nullopt, 2, std::nullopt}), "view age 0 ms  ·  2 corrections");
}

TEST(PeerReport, IsTheLatestByTheMomentAndTheWorstForTheServer) {
  Recording recording = MakeRecording(0);
  for (const auto& [peer, list] : recording.stats) ASSERT_EQ(list.size(), 1u) << peer;
  Stats later = recording.stats.at(1).front();
  later.tick = 60;
  later.rtt_us = 200000;
  later.jitter_us = 3000;
  later.loss_ppm = 25000;
  recording.stats.at(1).push_back(later);
  EXPECT_EQ(ReportOf(recording, 1, 59).rtt_us, 104000);
  EXPECT_EQ(ReportOf(recording, 1, 60).rtt_us, 200000);
  EXPECT_EQ(ReportOf(recording, 1, 60).jitter_us, 3000);
  EXPECT_DOUBLE_EQ(ReportOf(recording, 1, 60).loss_percent, 2.5);
  EXPECT_EQ(ReportOf(recording, 0, 60).rtt_us, 200000);
  EXPECT_EQ(ReportOf(recording, 0, 60).jitter_us, 9000) << "the other's";
  EXPECT_EQ(ReportOf(recording, 7, 60).rtt_us, -1);
  EXPECT_LT(ReportOf(recording, 7, 60).loss_percent, 0);
}

}  // namespace panel_note_test
}  // namespace seam
