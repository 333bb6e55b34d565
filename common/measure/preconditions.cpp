#include "common/measure/preconditions.h"

#include "common/scene/expected.h"
#include "common/sync/method.h"

namespace seam {

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
  if (expected.hand_over && PolicyOf(room).PlansAuthority() && measures.handovers == 0)
    return "no hand-over";
  if (expected.edit && oracle.edits.empty()) return "no edit";
  return "";
}

}  // namespace seam
