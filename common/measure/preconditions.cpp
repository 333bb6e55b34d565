#include "common/measure/preconditions.h"

#include <string>
#include <utility>

#include "common/measure/revisions.h"
#include "common/scene/expected.h"
#include "common/sync/method.h"

namespace seam {

std::string WhyNotValid(const Recording& recording, const Oracle& oracle,
                        const Measures& measures) {
  if (measures.compared == 0) return "no view was compared";
  const Room& room = recording.room;
  if (room.scene_text.empty()) return "";
  const Scene scene = RecordedScene(room);
  const Expected& expected = *scene.expected;
  if (expected.contact && !oracle.contact.value_or(true)) {
    return "no contact between two players' bodies";
  }
  if (expected.hand_over && PolicyOf(room).PlansAuthority() && measures.handovers == 0)
    return "no hand-over";
  if (expected.edit && oracle.edits.empty()) return "no edit";
  return "";
}

std::string LackOf(const Recording& recording) {
  const std::pair<std::int64_t, const char*> lacks[] = {
      {recording.bus_gaps, "messages missing"},
      {recording.undecodable, "undecodable messages"},
      {recording.skipped_bytes, "damaged bytes"}};
  std::string text;
  for (const auto& [count, what] : lacks) {
    if (count > 0) text += (text.empty() ? "" : " and ") + std::to_string(count) + " " + what;
  }
  return text;
}

}  // namespace seam
