/// LiveFeed: what the room says, and what an operator changes in it.

#include "render/view/live_feed.h"

namespace seam {

/// Makes marks of what the room's server says: of scripts, scores, players, warnings, changes.
void LiveFeed::NoteSaid() {
  for (const Event& event : builder_.recording().events) {
    if (event.kind != static_cast<std::int8_t>(EventKind::kLine)) events_.push_back(NoteOf(event));
  }
}

void LiveFeed::ShowControl(const std::string& json) {
  if (json == control_) return;
  control_ = json;
  if (!control_.empty()) ring_.Add("control", control_);
}

}  // namespace seam
