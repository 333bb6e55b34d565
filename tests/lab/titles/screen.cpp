#include "tests/lab/titles/screen.h"

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "common/base/check.h"
#include "common/sync/edits/edit_order.h"

namespace seam {
namespace {

const Part& PartNamed(const Scene& scene, std::string_view name) {
  for (const Part& part : scene.parts) {
    if (part.name == name) return part;
  }
  throw OperatorError("the scene has no part '" + std::string(name) + "'");
}

}  // namespace

Played::Played(Recording made)
    : recording(std::move(made)),
      scene(ParseScene(recording.room.scene_text, "recorded scene")),
      edits(EditsOf(recording)),
      edit_s(edits.size(), -1),
      history(scene, edits) {
  for (const auto& [number, order] : recording.edits) {
    const auto i = static_cast<std::size_t>(number);
    if (number >= 0 && i < edit_s.size()) {
      edit_s[i] = static_cast<double>(order.tick) / scene.solver.tick_hz;
    }
  }
}

double Screen::end_s() const {
  const auto views = recording().views.find(peer_);
  if (views == recording().views.end() || views->second.empty()) {
    throw OperatorError("peer " + std::to_string(peer_) + " showed nothing");
  }
  return static_cast<double>(views->second.rbegin()->first) / scene().solver.tick_hz;
}

std::optional<BodyState> Screen::Find(const std::string& part, double time_s) const {
  const PartId id = PartNamed(scene(), part).id;
  const auto views = recording().views.find(peer_);
  if (views == recording().views.end()) return std::nullopt;
  const View* view = FindView(views->second, std::llround(time_s * scene().solver.tick_hz));
  std::size_t index = 0;
  return view != nullptr ? played_.history.InView(*view, id, &index) : std::nullopt;
}

BodyState Screen::At(const std::string& part, double time_s) const {
  const std::optional<BodyState> state = Find(part, time_s);
  if (state) return *state;
  throw OperatorError("'" + part + "' was not shown at " + std::to_string(time_s) + " s");
}

BodyState Screen::AtStart(const std::string& part) const {
  const Part& made = PartNamed(scene(), part);
  return {made.position, made.angle, made.velocity, made.spin};
}

double Screen::Score(int player) const {
  double score = 0;
  for (const Meta& meta : recording().meta) {
    for (std::size_t i = 0; i < meta.kind.size(); ++i) {
      const bool own = meta.kind[i] == kMetaPlayer && meta.id[i] == player;
      if (own && meta.key[i] == kMetaScore) score = meta.value[i];
    }
  }
  return score;
}

std::vector<std::string> Screen::All(const std::string& prefix) const {
  std::vector<std::string> names;
  for (const Part& part : scene().parts) {
    if (part.name.rfind(prefix, 0) == 0) names.push_back(part.name);
  }
  return names;
}

}  // namespace seam
