#include "common/physics/rest/edit_wake.h"

#include <algorithm>
#include <utility>

#include "common/physics/faces.h"
#include "common/physics/stage.h"
#include "common/physics/world_shapes.h"

namespace seam {
namespace {

/// Returns nullptr for a part that is gone or not there yet.
const Assembly* AssemblyWith(const Composition& composition, PartId part) {
  const auto p = static_cast<std::size_t>(part);
  if (p >= composition.assembly_of_part.size()) return nullptr;
  const int index = composition.assembly_of_part[p];
  return index < 0 ? nullptr : &composition.assemblies[static_cast<std::size_t>(index)];
}

/// Returns the part of a shape at a contact's point: anchored parts may be one shape together.
PartId PartAt(const b2Fixture& fixture, const b2Vec2& point, const Scene& scene,
              const BuiltScene& built) {
  const auto lowest = static_cast<PartId>(PartOf(&fixture));
  const auto merged = built.merged.find(lowest);
  const bool anchored = fixture.GetBody()->GetType() == b2_staticBody;
  if (merged == built.merged.end() || !anchored) return lowest;
  return NearestPart(scene, merged->second, FromB2(point).cast<double>());
}

/// Unlike FindPartTouches, finds the parts at all points of a contact.
std::vector<PartTouch> TouchesIn(const b2World& world, const Scene& scene,
                                 const BuiltScene& built) {
  std::vector<PartTouch> touches;
  for (const b2Contact* c = world.GetContactList(); c != nullptr; c = c->GetNext()) {
    const b2Fixture &a = *c->GetFixtureA(), &b = *c->GetFixtureB();
    if (!c->IsTouching() || PartOf(&a) >= kStageFixture || PartOf(&b) >= kStageFixture) continue;
    b2WorldManifold manifold;
    c->GetWorldManifold(&manifold);
    for (int32 i = 0; i < c->GetManifold()->pointCount; ++i) {
      const b2Vec2& point = manifold.points[i];
      touches.push_back({PartAt(a, point, scene, built), PartAt(b, point, scene, built)});
    }
  }
  return touches;
}

/// True if the part came or left, or belongs to another body or another motion than before. What
/// lies on an anchored part does not notice that another part of its assembly left.
bool IsChanged(const EditWake::Edited& edited, PartId part) {
  const Assembly* then = AssemblyWith(edited.before, part);
  const Assembly* now = AssemblyWith(edited.now, part);
  if (then == nullptr || now == nullptr) return then != now;
  if (then->anchored != now->anchored) return true;
  if (now->anchored) return then->kinematic != now->kinematic;
  return then->id != now->id || then->parts != now->parts;
}

/// Returns -1 for a part that is gone or anchored.
int BodyOf(const EditWake::Edited& edited, PartId part) {
  const Assembly* now = AssemblyWith(edited.now, part);
  if (now == nullptr) return -1;
  return IndexOf(edited.built.bodies[static_cast<std::size_t>(now - edited.now.assemblies.data())]);
}

/// Sorts and drops doubles and negative numbers.
void Sort(std::vector<int>* bodies) {
  std::sort(bodies->begin(), bodies->end());
  bodies->erase(std::unique(bodies->begin(), bodies->end()), bodies->end());
  bodies->erase(bodies->begin(), std::lower_bound(bodies->begin(), bodies->end(), 0));
}

}  // namespace

EditWake::EditWake(const b2World& world, const Scene& scene, const BuiltScene& built,
                   std::vector<bool> held)
    : held_(std::move(held)), touches_(TouchesIn(world, scene, built)) {}

std::vector<int> EditWake::Bodies(const Edited& edited, const std::vector<bool>& held) const {
  std::vector<int> bodies;
  std::vector<PartTouch> touches = TouchesIn(edited.world, edited.scene, edited.built);
  touches.insert(touches.end(), touches_.begin(), touches_.end());
  for (const PartTouch& touch : touches) {
    if (IsChanged(edited, touch.a)) bodies.push_back(BodyOf(edited, touch.b));
    if (IsChanged(edited, touch.b)) bodies.push_back(BodyOf(edited, touch.a));
  }
  for (std::size_t j = 0; j < held.size(); ++j) {
    const bool was_held = j < held_.size() && held_[j];
    if (held[j] == was_held) continue;
    bodies.push_back(BodyOf(edited, edited.scene.joints[j].a));
    bodies.push_back(BodyOf(edited, edited.scene.joints[j].b));
  }
  Sort(&bodies);
  AddBehindDisplayed(edited, touches, held, &bodies);
  return bodies;
}

void EditWake::AddBehindDisplayed(const Edited& edited, const std::vector<PartTouch>& touches,
                                  const std::vector<bool>& held, std::vector<int>* bodies) const {
  const auto simulated = [&](int body) {
    return edited.activities[static_cast<std::size_t>(body)] == Activity::kSimulated;
  };
  const bool all = std::all_of(edited.activities.begin(), edited.activities.end(),
                               [](Activity a) { return a == Activity::kSimulated; });
  if (bodies->empty() || all) return;
  std::vector<std::vector<int>> neighbours(edited.activities.size());
  const auto link = [&](PartId part_a, PartId part_b) {
    const int a = BodyOf(edited, part_a), b = BodyOf(edited, part_b);
    if (a < 0 || b < 0) return;
    neighbours[static_cast<std::size_t>(a)].push_back(b);
    neighbours[static_cast<std::size_t>(b)].push_back(a);
  };
  for (const PartTouch& touch : touches) link(touch.a, touch.b);
  for (std::size_t j = 0; j < held.size(); ++j) {
    if (held[j]) link(edited.scene.joints[j].a, edited.scene.joints[j].b);
  }
  std::vector<char> woken(edited.activities.size(), 0);
  std::vector<int> open = *bodies;
  for (const int body : open) woken[static_cast<std::size_t>(body)] = 1;
  while (!open.empty()) {
    const int body = open.back();
    open.pop_back();
    for (const int other : neighbours[static_cast<std::size_t>(body)]) {
      char& is_woken = woken[static_cast<std::size_t>(other)];
      if (is_woken != 0) continue;
      is_woken = 1;
      open.push_back(other);
      if (!simulated(body) || !simulated(other)) bodies->push_back(other);
    }
  }
  Sort(bodies);
}

}  // namespace seam
