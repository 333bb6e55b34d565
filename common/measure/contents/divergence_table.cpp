#include "common/measure/contents/divergence_table.h"

#include <fmt/format.h>

namespace seam {
namespace {

std::string BodyOf(const Scene& scene, std::int32_t id) {
  const auto part = static_cast<std::size_t>(id);
  return part < scene.parts.size() ? scene.parts[part].name : fmt::format("{}", id);
}

std::string PeerOf(int peer) { return peer == 0 ? "server" : fmt::format("peer {}", peer); }

}  // namespace

std::string FormatDivergences(const Recording& recording, const Scene& scene) {
  if (recording.divergences.empty()) return "none\n";
  std::string text = "    tick  at       told by  body            off m  off m/s  inputs missing\n";
  std::int64_t more = 0;
  for (const Divergence& d : recording.divergences) {
    for (std::size_t i = 0; i < d.body.size(); ++i) {
      text += fmt::format("{:>8}  {:<8} {:<8} {:<14} {:>6.3g}  {:>7.3g}  {:>14}\n", d.at[i],
                          PeerOf(d.peer), PeerOf(d.holder[i]), BodyOf(scene, d.body[i]), d.apart[i],
                          d.kick[i], d.missing[i]);
    }
    more += d.more;
  }
  if (more > 0) text += fmt::format("and {} more that found no room\n", more);
  return text;
}

}  // namespace seam
