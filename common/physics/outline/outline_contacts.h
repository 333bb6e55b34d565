#pragma once
/// Contacts of shapes that are part of something larger: tiles of a floor, planks of a deck. The
/// engine lets two polygons collide by any of their sides, inner ones included: a box that lands
/// between two tiles is stopped by the wall between them. So does the end of a segment. Here such a
/// contact is found again, by the sides of the outline alone and with the next sides known (as in a
/// chain of the engine). Shapes keep their own friction and restitution, and stay solid.

#include <box2d/box2d.h>

#include <cstdint>
#include <vector>

#include "common/physics/world_build.h"
#include "common/scene/scene.h"

namespace seam {

class OutlineContacts {
 public:
  /// Finds the outlines of the anchored shapes, together, and of each moving or kinematic body. The
  /// result holds until bodies or shapes change; it does not depend on poses of moving bodies.
  void Find(const Scene& scene, const Composition& composition, const BuiltScene& built);

  /// False if every shape stands alone: then there is nothing to correct.
  bool any() const { return !shapes_.empty(); }

  /// Call it in the engine's PreSolve: replaces the contact's points. If the outlines do not touch,
  /// disables the contact until the engine's next look.
  void Correct(b2Contact* contact, const b2Manifold& old) const;

 private:
  struct Shape {
    bool alone = true;
    std::vector<b2EdgeShape> edges;  // in the body's frame
  };
  /// Returns nullptr for a shape that stands alone.
  const Shape* ShapeOf(const b2Fixture* fixture) const;
  void FindGroup(const std::vector<b2Body*>& bodies, double gap);
  void FindSegments(const std::vector<const b2Fixture*>& segments, double gap);
  static bool Best(const Shape& shape, const b2Fixture& own, const Shape* other_shape,
                   const b2Fixture& other, b2Manifold* best);
  static bool Reachable(const Shape& shape, const b2Manifold& manifold, const b2Transform& own,
                        const b2Transform& other);

  std::vector<int> first_;     // by part: index of its first piece in shapes_; -1: all stand alone
  std::vector<Shape> shapes_;  // pieces of a part follow each other
};

}  // namespace seam
