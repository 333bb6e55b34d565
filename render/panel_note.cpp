#include "render/panel_note.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/page/jumps.h"
#include "render/playback/peer_report.h"

namespace seam {

void FindCorrections(Page* page) {
  for (Panel& panel : page->panels) {
    if (!panel.playback->has_oracle()) continue;
    std::vector<std::int64_t>& ticks = panel.corrections.emplace();
    for (const PageEvent& jump : FindJumpsOf(*panel.playback, panel.peer))
      ticks.push_back(jump.tick);
    std::sort(ticks.begin(), ticks.end());
  }
}

namespace {

/// Returns the greatest age that the peer's view of the tick gives for a body, ms; nullopt without
/// a view, or where all is shown in the present.
std::optional<double> OldestShownMs(const Recording& recording, int peer, double tick) {
  const auto views = recording.views.find(peer);
  if (views == recording.views.end()) return std::nullopt;
  const auto view = views->second.find(static_cast<std::int64_t>(std::floor(tick)));
  if (view == views->second.end() || view->second.age.empty()) return std::nullopt;
  const std::vector<float>& ages = view->second.age;
  const double oldest = double{*std::max_element(ages.begin(), ages.end())};
  if (oldest <= 0) return std::nullopt;
  return 1000 * oldest / std::max(1, recording.room.tick_hz);
}

}  // namespace

ViewNote NoteOf(const Panel& panel, double now_s) {
  ViewNote note;
  const double tick = panel.playback->TickAt(now_s);
  note.age_ms = panel.playback->ViewAgeMs(panel.peer);
  note.shown_ms = OldestShownMs(panel.playback->recording(), panel.peer, tick);
  const PeerReport report = ReportOf(panel.playback->recording(), panel.peer, tick);
  if (report.jitter_us >= 0) note.jitter_ms = report.jitter_us / 1e3;
  if (!panel.corrections) return note;
  const std::vector<std::int64_t>& ticks = *panel.corrections;
  note.corrections = std::upper_bound(ticks.begin(), ticks.end(),
                                      static_cast<std::int64_t>(std::floor(tick))) -
                     ticks.begin();
  return note;
}

std::string TextOf(const ViewNote& note) {
  std::string text;
  const auto add = [&text](const std::string& part) {
    text += (text.empty() ? "" : "  ·  ") + part;
  };
  if (note.age_ms) add(fmt::format("view age {:.0f} ms", *note.age_ms));
  if (note.shown_ms) add(fmt::format("others up to {:.0f} ms ago", *note.shown_ms));
  if (note.jitter_ms) add(fmt::format("jitter {:.0f} ms", *note.jitter_ms));
  if (note.corrections)
    add(fmt::format("{} correction{}", *note.corrections, *note.corrections == 1 ? "" : "s"));
  return text;
}

}  // namespace seam
