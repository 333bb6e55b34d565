#pragma once
/// Shared Box2D bodies for anchored assemblies: a body each would cost the engine time in every
/// step, and nobody asks which body an immovable shape belongs to. Each shape still says which part
/// it is.

#include <box2d/box2d.h>

#include <map>
#include <utility>
#include <vector>

#include "common/physics/anchored/dense_anchored.h"
#include "common/physics/faces.h"
#include "common/scene/assembly.h"

namespace seam {

/// Returns, by assembly, true if it may share a body: it is dense (see DenseAnchored), and nothing
/// is attached to its body (no non-rigid joint, breakable glue, connector, belt, seat or thrust).
std::vector<bool> ShareBodies(const Scene& scene, const Composition& composition,
                              const std::vector<bool>& dense);

/// Returns the shapes of the sharing assemblies (see ShareBodies), by the assembly of each shape's
/// lowest part. Boxes that lie on one body and form a rectangle become one shape, whichever
/// assemblies they belong to, so that bricks have no inner sides. Each list ascends.
std::vector<std::vector<Face>> SharedFaces(const Scene& scene, const Composition& composition,
                                           const std::vector<bool>& share);

/// Makes the engine's next step drop contacts that are no longer contacts (see AnchoredBodies).
void DropFarContacts(b2World* world);

/// Makes the shared bodies of a world's dense anchored assemblies. Those whose roots lie in the
/// same square of the plane share a body, so that no shape is far from its body's origin. With a
/// shape of a dense assembly, a pair of which only the bounding boxes meet is not made a contact: a
/// long wall at an angle has a box as large as a city.
class AnchoredBodies {
 public:
  explicit AnchoredBodies(b2World* world) : world_(world) {}

  struct Body {
    b2Body* body = nullptr;
    Part frame;  ///< has the body's pose
  };
  /// Notes that a dense assembly has this body to itself.
  void MarkDense(b2Body* body);
  /// Returns the shared body for the assembly with this root.
  const Body& For(const Part& root);

 private:
  b2World* world_;
  std::map<AnchoredSquare, Body> bodies_;
  const std::pair<const AnchoredSquare, Body>* last_ =
      nullptr;  // last found: neighbours follow each other
};

}  // namespace seam
