#pragma once
/// The note in a panel's corner about the displayed view.

#include <cstdint>
#include <optional>
#include <string>

#include "render/frame.h"

namespace seam {

/// Figures of a view and its network at a moment.
struct ViewNote {
  std::optional<double> age_ms;             ///< mean over the recording (Playback::ViewAgeMs)
  std::optional<double> jitter_ms;          ///< as last reported (PeerReport)
  std::optional<std::int64_t> corrections;  ///< visible ones so far; empty without an oracle
  std::optional<double> shown_ms;  ///< greatest age by the view itself; empty in the present
};

/// Finds each panel's visible corrections in its recording.
void FindCorrections(Page* page);

/// Returns the figures of a panel's view at a moment.
ViewNote NoteOf(const Panel& panel, double now_s);

/// Formats "view age 43 ms  ·  jitter 9 ms  ·  2 corrections"; leaves out unknown figures.
std::string TextOf(const ViewNote& note);

}  // namespace seam
