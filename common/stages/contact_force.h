#pragma once
/// Finds the parts that a contact pushes, and the impulses.

#include <map>

#include "common/base/geometry.h"
#include "common/physics/faces.h"
#include "common/physics/stage.h"
#include "common/physics/world_shapes.h"

namespace seam {

/// An impulse on a fixture; resolved to a single part only on demand.
struct PartPush {
  PartId fixture = -1;            ///< the part that numbers the fixture
  b2Vec2 point{0, 0};             ///< in the body's frame, m
  Eigen::Vector2d impulse{0, 0};  ///< N s, in world directions
};

/// Finds the part that a fixture has at a point of its body's frame, m; efficient for many points
/// of the same fixtures.
class PartFinder {
 public:
  explicit PartFinder(const StageWorld& world) : w_(world) {}

  PartId At(PartId fixture, const b2Vec2& point) {
    const auto merged = w_.built.merged.find(fixture);
    if (merged == w_.built.merged.end()) return fixture;
    auto found = seen_.find(fixture);
    if (found == seen_.end()) {
      found = seen_.emplace(fixture, NearestOf(w_.scene, merged->second)).first;
    }
    const int assembly = w_.composition.assembly_of_part[static_cast<std::size_t>(fixture)];
    const Assembly& whole = w_.composition.assemblies[static_cast<std::size_t>(assembly)];
    if (whole.anchored && whole.kinematic < 0) {  // the body may be shared with other parts
      const b2Vec2 at = w_.built.bodies[static_cast<std::size_t>(assembly)]->GetWorldPoint(point);
      return found->second.At(FromB2(at).cast<double>());
    }
    const Part& root = w_.scene.parts[static_cast<std::size_t>(whole.id)];
    const Transform2 placed{root.position.cast<double>(), static_cast<double>(root.angle)};
    return found->second.At(placed(FromB2(point).cast<double>()));
  }

 private:
  const StageWorld& w_;
  std::map<PartId, NearestOf> seen_;  // by fixture
};

/// Returns the part at the point.
inline PartId PartAt(const StageWorld& w, PartId fixture, const b2Vec2& point) {
  return PartFinder(w).At(fixture, point);
}

/// Calls visit(push) for both sides of each point of a solved contact, but not for fixtures made by
/// stages.
template <typename Visit>
void EachContactPush(b2Contact* contact, const b2ContactImpulse& impulse, const Visit& visit) {
  b2WorldManifold manifold;
  contact->GetWorldManifold(&manifold);
  const Eigen::Vector2d normal = FromB2(manifold.normal).cast<double>();
  const Eigen::Vector2d tangent(normal.y(), -normal.x());
  for (int i = 0; i < impulse.count; ++i) {
    const Eigen::Vector2d on_b = static_cast<double>(impulse.normalImpulses[i]) * normal +
                                 static_cast<double>(impulse.tangentImpulses[i]) * tangent;
    for (const bool b : {false, true}) {
      b2Fixture* fixture = b ? contact->GetFixtureB() : contact->GetFixtureA();
      const std::uint32_t id = PartOf(fixture);
      if (id >= kStageFixture) continue;
      visit(PartPush{static_cast<PartId>(id), fixture->GetBody()->GetLocalPoint(manifold.points[i]),
                     b ? on_b : -on_b});
    }
  }
}

}  // namespace seam
