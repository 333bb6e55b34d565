#include "server/rules/bounds_watch.h"

#include <set>

#include "common/physics/part_places.h"

namespace seam {

bool OutsideBounds(const Scene& scene, const Vec2& position) {
  return (position.array() < scene.bounds_min.array()).any() ||
         (position.array() > scene.bounds_max.array()).any();
}

bool BoundsWatch::IsOurs(int body) const {
  const World& world = replica_.world();
  return replica_.authority().at(world.mechanism(body)).authority <= 0;
}

std::vector<Edit> BoundsWatch::Next(const std::vector<int>& told) {
  const World& world = replica_.world();
  const Scene& scene = world.scene();
  std::set<int> leaving;
  for (const int body : told) leaving.insert(world.mechanism(body));
  for (int b = 0; b < world.body_count(); ++b) {
    if (!IsOurs(b) || !OutsideBounds(scene, world.Read(b).position)) continue;
    leaving.insert(world.mechanism(b));
  }
  std::vector<Edit> edits;
  if (leaving.empty()) return edits;
  const std::int64_t again = static_cast<std::int64_t>(kAgainSeconds) * scene.solver.tick_hz;
  for (const Part& part : scene.parts) {
    if (edits.size() == kPartsMax) break;
    if (part.gone || part.anchored) continue;
    if (leaving.count(MechanismOf(world, part.id)) == 0) continue;
    const auto asked = asked_.find(part.id);
    if (asked != asked_.end() && world.tick() - asked->second < again) continue;
    asked_[part.id] = world.tick();
    edits.emplace_back(RemoveEdit{part.id, true}, EditCause::kOutside);
  }
  return edits;
}

void BoundsWatch::NoteApplied(const Edit& edit) {
  const RemoveEdit* removed = edit.As<RemoveEdit>();
  if (removed == nullptr || !removed->left_bounds) return;
  asked_.erase(removed->part);
  ++left_;
}

}  // namespace seam
