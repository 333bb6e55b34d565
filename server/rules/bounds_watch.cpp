#include "server/rules/bounds_watch.h"

#include <algorithm>
#include <set>

#include "common/physics/part_places.h"
#include "common/scene/saved/persist_state.h"

namespace seam {
namespace {

/// In a room of more than kAtOnce bodies, one check of all absent bodies takes kTurnTicks ticks.
constexpr int kAtOnce = 256, kTurnTicks = 30;

}  // namespace

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
  const auto look = [&](int b) {
    if (!IsOurs(b) || !OutsideBounds(scene, world.Read(b).position)) return;
    leaving.insert(world.mechanism(b));
  };
  for (const int b : world.present()) look(b);
  // Absent bodies do not get far by themselves.
  const int count = world.body_count(), each = count <= kAtOnce ? count : 1 + count / kTurnTicks;
  const int first = each == count ? 0 : static_cast<int>(world.tick() % kTurnTicks) * each;
  for (int b = first; b < std::min(count, first + each); ++b) {
    if (!IsPresent(world.activity(b))) look(b);
  }
  std::vector<Edit> edits;
  if (leaving.empty()) return edits;
  const std::int64_t again = static_cast<std::int64_t>(kAgainSeconds) * scene.solver.tick_hz;
  for (const Part& part : scene.parts) {
    if (edits.size() == kRemovalsMax) break;
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

void BoundsWatch::Persist(StateArchive& a) {
  a.Section("bounds");
  const std::size_t parts = replica_.world().scene().parts.size();
  a.Entries(
      &asked_, parts, [&](PartId* part) { PersistPart(a, part, parts); },
      [&](std::int64_t* tick) { a.Tick(tick); });
  a.Int(&left_, 0, StateArchive::kCountMost);
}

}  // namespace seam
