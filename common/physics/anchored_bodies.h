#pragma once
/// Anchored assemblies that share a body: a body each would cost the engine time in every step, and
/// nobody needs to know of whom a body is that never moves. Shapes say which part they are.

#include <box2d/box2d.h>

#include <map>
#include <utility>
#include <vector>

#include "common/physics/faces.h"
#include "common/scene/assembly.h"

namespace seam {

/// By assembly: whether it may share a body. It is anchored and stands still, and nothing takes
/// hold of its own body: no joint that is not rigid, no glue that can break, no connector, belt,
/// seat or thrust. False for all of them where they are fewer than kShareFrom.
std::vector<bool> ShareBodies(const Scene& scene, const Composition& composition);

/// The shapes of those that share (see ShareBodies), by the assembly of the lowest part of each: on
/// one body, boxes of any of them that make a rectangle are one shape, as bricks have no inner
/// sides. Each list ascends.
std::vector<std::vector<Face>> SharedFaces(const Scene& scene, const Composition& composition,
                                           const std::vector<bool>& share);

/// Lets the engine's next step drop what is a contact no longer (see AnchoredBodies).
void DropFarContacts(b2World* world);

/// As many as a scene may have before they share bodies.
constexpr int kShareFrom = 32;

/// What a world has that is anchored. They share a body in each square of the plane in which there
/// is one of their roots, so that no shape is far from its body's origin. Where there are
/// kShareFrom parts, a pair of which only the engine's boxes meet is no contact: a long wall at an
/// angle has a box as large as a city.
class AnchoredBodies {
 public:
  explicit AnchoredBodies(b2World* world) : world_(world) {}

  struct Body {
    b2Body* body = nullptr;
    Part frame;  ///< lies as it does
  };
  /// There is one more, with a body of its own or not.
  void Count(const Assembly& assembly);
  /// The body for an assembly whose root is `root`.
  const Body& For(const Part& root);

 private:
  b2World* world_;
  std::size_t parts_ = 0;
  using Square = std::pair<int, int>;  // column and row
  std::map<Square, Body> bodies_;
  const std::pair<const Square, Body>* last_ = nullptr;  // of these: neighbours follow each other
};

}  // namespace seam
