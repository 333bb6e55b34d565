#include "common/physics/saved/world_saved.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#include "common/base/state_archive.h"
#include "common/physics/joint_impulses.h"
#include "common/physics/stage.h"
#include "common/physics/world_impl.h"
#include "common/scene/saved/persist_state.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

/// Most contact points of a world, and numbers that its stages save: far more than bodies have.
constexpr std::size_t kPointsMost = 1 << 24, kStageNumbersMost = 1 << 24;
/// Most rows of a joint's impulses.
constexpr std::size_t kImpulsesMost = 5;
/// s: longer than any body may be slow before it sleeps.
constexpr float kQuietMost = 1e6f;

bool PointsAscend(const WorldSnapshot::Point& x, const WorldSnapshot::Point& y) {
  return std::tie(x.pair, x.feature) < std::tie(y.pair, y.feature);
}

bool SameBody(const WorldSnapshot::Body& x, const WorldSnapshot::Body& y) {
  return std::memcmp(&x.state, &y.state, sizeof x.state) == 0 && x.awake == y.awake &&
         x.quiet_s == y.quiet_s && x.going_s == y.going_s;
}

bool SamePoint(const WorldSnapshot::Point& x, const WorldSnapshot::Point& y) {
  static_assert(sizeof x == 24);
  return std::memcmp(&x, &y, sizeof x) == 0;
}

void PersistPoint(StateArchive& a, WorldSnapshot::Point* point) {
  a.Word(&point->pair);
  a.Word(&point->feature);
  a.Real(&point->normal, kImpulseMax);
  if (a.reading()) a.Require(point->normal >= 0, "a contact pulls");  // the engine asserts it
  a.Real(&point->tangent, kImpulseMax);
}

/// Points that the snapshot before has are named by their place there. Both ascend, so one pass
/// finds them.
void PersistPoints(StateArchive& a, const std::vector<WorldSnapshot::Point>& before,
                   std::vector<WorldSnapshot::Point>* points) {
  std::size_t next = 0;  // the first of `before` that may be equal to the next point
  const auto first_not_before = [&](const WorldSnapshot::Point& point) {
    std::size_t at = next;
    while (at < before.size() && PointsAscend(before[at], point)) ++at;
    return at;
  };
  a.List(points, kPointsMost, [&](WorldSnapshot::Point* point) {
    std::size_t at = a.reading() ? 0 : first_not_before(*point);
    bool known = !a.reading() && at < before.size() && SamePoint(before[at], *point);
    a.Flag(&known);
    if (!known) {
      PersistPoint(a, point);
      next = first_not_before(*point);
      return;
    }
    auto skipped = static_cast<std::uint32_t>(at - next);
    a.Int(&skipped, 0, static_cast<std::int64_t>(kPointsMost));
    at = next + skipped;
    a.Require(at < before.size(), "there is no such point before");
    if (!a.ok()) return;
    *point = before[at];
    next = at + 1;
  });
}

}  // namespace

void Persist(StateArchive& a, WorldSnapshot* snapshot) {
  PersistAfter(a, WorldSnapshot(), snapshot);
}

void PersistAfter(StateArchive& a, const WorldSnapshot& before, WorldSnapshot* snapshot) {
  a.Section("world");
  a.Int(&snapshot->tick, 0, StateArchive::kTickMost);
  a.Word(&snapshot->composition);
  a.Word(&snapshot->joints_there);
  std::vector<WorldSnapshot::Body> bodies(snapshot->bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i] = snapshot->bodies[i];
  std::size_t next = 0;
  a.List(&bodies, kPartsMax, [&](WorldSnapshot::Body* body) {
    const std::size_t i = next++;
    bool same = !a.reading() && i < before.bodies.size() && SameBody(*body, before.bodies[i]);
    a.Flag(&same);
    a.Require(!same || i < before.bodies.size(), "there is no such body before");
    if (!a.ok()) return;
    if (same) {
      *body = before.bodies[i];
      return;
    }
    Persist(a, &body->state);
    a.Flag(&body->awake);
    a.Real(&body->quiet_s, kQuietMost);
    a.Real(&body->going_s, kQuietMost);
  });
  if (a.reading()) snapshot->bodies.Take(bodies);
  PersistPoints(a, before.points, &snapshot->points);
  a.List(&snapshot->joints, kPointsMost, [&](std::vector<float>* impulses) {
    a.List(impulses, kImpulsesMost, [&](float* impulse) { a.Real(impulse, kImpulseMax); });
  });
  a.List(&snapshot->left, kPartsMax, [&](WorldSnapshot::Left* left) {
    a.Int(&left->body, 0, static_cast<std::int64_t>(kPartsMax));
    a.Int(&left->steps, 0, kStageNumberMax);
  });
  a.List(&snapshot->speeds, kPointsMost, [&](float* speed) { a.Real(speed, kSavedSpeedMost); });
  a.List(&snapshot->stages, kStageNumbersMost, [&](float* number) { a.Real(number); });
  a.List(&snapshot->touching, kPointsMost, [&](PartTouch* touch) {
    a.Int(&touch->a, 0, static_cast<std::int64_t>(kPartsMax) - 1);
    a.Int(&touch->b, 0, static_cast<std::int64_t>(kPartsMax) - 1);
  });
}

Status World::Load(const WorldSnapshot& snapshot) {
  Impl& w = *impl_;
  const Status good = w.ValidateSnapshot(snapshot);
  if (!good.ok()) return Status::Error("its bodies or joints are not those of its edits");
  bool joints = snapshot.joints.size() == w.built.joints.size() &&
                snapshot.speeds.size() == w.scene.joints.size();
  for (std::size_t j = 0; joints && j < snapshot.joints.size(); ++j) {
    if (snapshot.joints[j].empty()) continue;
    b2Joint* const made = w.built.joints[j];
    joints = made != nullptr &&
             snapshot.joints[j].size() == static_cast<std::size_t>(ImpulsesOf(made).count);
  }
  if (!joints) return Status::Error("its joints have other impulses or speeds");
  const auto count = static_cast<int>(w.built.moving.size());
  const bool left = std::all_of(snapshot.left.begin(), snapshot.left.end(),
                                [count](const auto& each) { return each.body < count; });
  if (!left) return Status::Error("it names bodies that it has not");
  if (!std::is_sorted(snapshot.points.begin(), snapshot.points.end(), PointsAscend)) {
    return Status::Error("its contact points are not in order");
  }
  const bool push = std::all_of(snapshot.points.begin(), snapshot.points.end(),
                                [](const auto& point) { return point.normal >= 0; });
  if (!push) return Status::Error("a contact pulls");
  if (!std::is_sorted(snapshot.touching.begin(), snapshot.touching.end())) {
    return Status::Error("its touches are not in order");
  }
  StageMemory memory(snapshot.stages);
  if (!snapshot.stages.empty()) {
    for (const auto& stage : w.stages) stage->Load(&memory);
  }
  if (!memory.good() || !memory.done()) return Status::Error("a stage's memory is wrong");
  SetTick(snapshot.tick);
  return Restore(snapshot);
}

}  // namespace seam
