#include <fmt/format.h>

#include <cstdio>

#include "common/base/check.h"
#include "common/record/damage.h"
#include "common/scene/scene.h"
#include "tests/lab/commands.h"
#include "tests/lab/divergence.h"

namespace seam {
namespace {

Recording ReadWhole(const std::string& path) {
  Recording recording = ReadRecording(path);
  const std::string sessions = ChosenSession(recording);
  if (!sessions.empty()) {
    std::fprintf(stderr, "seam-lab: note: %s: %s\n", path.c_str(), sessions.c_str());
  }
  ReportDamage("seam-lab", path, recording);
  return recording;
}

/// "body 3 (brick)"; without a name when the recorded scene does not parse.
std::string BodyText(const Recording& recording, int body) {
  std::string text = "body " + std::to_string(body);
  try {
    const Scene scene = ParseScene(recording.room.scene_text, recording.room.scene_name);
    const auto index = static_cast<std::size_t>(body);
    if (index < scene.parts.size()) text += " (" + scene.parts[index].name + ")";
  } catch (const OperatorError&) {  // made by hand: the number must do
  }
  return text;
}

std::string DivergenceText(const Recording& recording, const RunDifference& d, const std::string& a,
                           const std::string& b) {
  std::string text = fmt::format("tick {}, peer {}", d.tick, d.peer);
  if (d.body >= 0) text += ", " + BodyText(recording, d.body);
  if (d.field.empty()) return text + ": only in " + (d.only_in_a ? a : b);
  if (*d.unit == '\0') return text + fmt::format(", {}: {} and {}", d.field, d.a, d.b);
  return text + fmt::format(", {}: {:.9g} and {:.9g} {}, which differ by {:.3g}", d.field, d.a, d.b,
                            d.unit, d.b - d.a);
}

}  // namespace

int FirstDivergence(const DivergenceCommand& command) {
  const Recording a = ReadWhole(command.log_a);
  const Recording b = ReadWhole(command.log_b);
  if (a.room.scene_text != b.room.scene_text || a.room.tick_hz != b.room.tick_hz) {
    throw OperatorError(command.log_b + ": another scene or tick rate than " + command.log_a);
  }
  const Comparison result = CompareViews(a, b, command.peer, command.common);
  if (result.first) {
    std::printf("%s (after %lld equal views)\n",
                DivergenceText(a, *result.first, command.log_a, command.log_b).c_str(),
                static_cast<long long>(result.equal_views));
    return 1;
  }
  if (result.equal_views == 0) {
    throw OperatorError("no views to compare" + (command.peer < 0
                                                     ? std::string()
                                                     : " of peer " + std::to_string(command.peer)));
  }
  std::printf("equal: %lld views\n", static_cast<long long>(result.equal_views));
  return 0;
}

}  // namespace seam
