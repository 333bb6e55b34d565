#include "common/sync/show/strand_view.h"

#include <algorithm>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"

namespace seam {
namespace {

/// Limit of ticks between two views that are simulated.
constexpr std::int64_t kTicksMax = 10;

/// Finds the displayed position of a strand's upper end; false if its part has left.
bool Upper(const World& world, const View& view, const Strand& strand, Vec2* at) {
  const auto shown = [&view](int body) {
    const auto i = static_cast<std::size_t>(body);
    return BodyState{{view.x[i], view.y[i]}, view.angle[i], {0, 0}, 0};
  };
  BodyState part;
  if (!ReadPart(world, strand.part, shown, &part)) return false;
  *at = part.position + Rotation<float>(part.angle)(strand.at);
  return at->allFinite();
}

}  // namespace

Strands StrandView::Next(const View& view) {
  Strands strands;
  strands.peer = view.peer;
  strands.tick = view.tick;
  const Scene& scene = world_.scene();
  const float h = 1.0f / static_cast<float>(scene.solver.tick_hz);
  const std::int64_t ticks = std::clamp<std::int64_t>(view.tick - tick_, 0, kTicksMax);
  tick_ = view.tick;
  for (std::size_t i = 0; i < scene.strands.size(); ++i) {
    const Strand& strand = scene.strands[i];
    const int index = static_cast<int>(i);
    Vec2 at{0, 0};
    if (!Upper(world_, view, strand, &at)) {
      ropes_.erase(index);
      continue;
    }
    const auto rope = ropes_.try_emplace(index, strand, scene.gravity, at).first;
    for (std::int64_t t = 0; t < ticks; ++t) rope->second.Step(h, at);
    for (const Vec2& point : rope->second.Points()) {
      if (!point.allFinite()) continue;
      strands.strand.push_back(static_cast<std::int16_t>(index));
      strands.x.push_back(point.x());
      strands.y.push_back(point.y());
    }
  }
  return strands;
}

}  // namespace seam
