#pragma once
/// What the corner of a panel says of the view that it shows.

#include <cstdint>
#include <optional>
#include <string>

#include "render/frame.h"

namespace seam {

/// A view and its network at a moment.
struct ViewNote {
  std::optional<double> age_ms;             ///< over the recording (Playback::ViewAgeMs)
  std::optional<double> jitter_ms;          ///< as last reported (PeerReport)
  std::optional<std::int64_t> corrections;  ///< so far that a person sees; empty without an oracle
};

/// Finds each panel's corrections in its recording.
void FindCorrections(Page* page);

ViewNote NoteOf(const Panel& panel, double now_s);

/// "view age 43 ms  ·  jitter 9 ms  ·  2 corrections"; what is not known is left out.
std::string TextOf(const ViewNote& note);

}  // namespace seam
