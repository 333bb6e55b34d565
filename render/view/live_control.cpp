/// LiveFeed: what an operator changes in the room.

#include "render/view/live_feed.h"

namespace seam {

/// Makes marks of what an operator has changed.
void LiveFeed::NoteControl() {
  for (const Event& event : builder_.recording().events) {
    if (event.kind == static_cast<std::int8_t>(EventKind::kControl)) {
      events_.push_back(NoteOf(event));
    }
  }
}

void LiveFeed::ShowControl(const std::string& json) {
  if (json == control_) return;
  control_ = json;
  if (!control_.empty()) ring_.Add("control", control_);
}

}  // namespace seam
