#include "common/measure/contents/doubts.h"

#include <fmt/format.h>

#include <cmath>

#include "common/record/events/event_text.h"

namespace seam {
namespace {

std::string PlayerOf(const Scene& scene, const Audit& audit) {
  const auto player = static_cast<std::size_t>(audit.player);
  return audit.player >= 0 && player < scene.players.size() ? scene.players[player].name : "?";
}

std::string BodyOf(const Scene& scene, const Audit& audit) {
  const auto part = static_cast<std::size_t>(audit.body);
  return part < scene.parts.size() ? scene.parts[part].name : fmt::format("{}", audit.body);
}

}  // namespace

std::string FormatDoubts(const Recording& recording, const Scene& scene) {
  if (recording.audits.empty()) return "none\n";
  std::string text =
      "    tick  player       body            off m  off m/s  refused  score  step\n";
  for (const Audit& a : recording.audits) {
    if (a.body < 0) {
      text +=
          fmt::format("{:>8}  {:<12} -> {}\n", a.tick, PlayerOf(scene, a), TrustStepName(a.step));
      continue;
    }
    const auto apart = [&a](std::size_t i) { return a.told[i] - a.expected[i]; };
    const float off = std::hypot(apart(0), apart(1)), kick = std::hypot(apart(2), apart(3));
    text += fmt::format("{:>8}  {:<12} {:<14} {:>6.3g}  {:>7.3g}  {:>7}  {:>5.2f}  {}\n", a.tick,
                        PlayerOf(scene, a), BodyOf(scene, a), off, kick,
                        a.refused != 0 ? "yes" : "no", 1e-3 * a.score_milli, TrustStepName(a.step));
  }
  return text;
}

}  // namespace seam
