#include "common/measure/preconditions.h"

#include "common/scene/expected.h"
#include "common/sync/mode.h"

namespace seam {
namespace {

/// True if authority changes hands in the room's mode.
bool HandsOver(const Room& room) {
  const std::optional<Mode> mode = FindMode(room.mode);
  return mode == Mode::kBuffer || mode == Mode::kStrict;
}

}  // namespace

std::string WhyNotValid(const Recording& recording, const Oracle& oracle,
                        const Measures& measures) {
  if (measures.compared == 0) return "no view was compared";
  const Room& room = recording.room;
  if (room.scene_text.empty()) return "";
  const Scene scene = ParseScene(room.scene_text, room.scene_name + ".toml");
  const Expected& expected = *scene.expected;
  if (expected.contact && !oracle.contact.value_or(true)) {
    return "no contact between two players' bodies";
  }
  if (expected.hand_over && HandsOver(room) && measures.handovers == 0) return "no hand-over";
  if (expected.edit && oracle.edits.empty()) return "no edit";
  return "";
}

}  // namespace seam
