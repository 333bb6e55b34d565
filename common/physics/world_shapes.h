#pragma once
/// A part as a Box2D shape, with the rim (skin) that its scene sets.

#include <box2d/box2d.h>

#include <cstdint>
#include <variant>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// Adds the part to the body of the assembly whose root is `root`. `skin`: of the scene's solver.
/// `guarded`: anchored or a bullet, whose rim stays 1 cm.
///
///   stock                          skin = 2.5 mm
///   moving     |  1 cm rim         moving     | 2.5 mm rim
///   - - - - - -|                   - - - - - -|
///   anchored   |  1 cm rim         anchored  |  1 cm rim, moved in by 7.5 mm
///
/// The engine lets rims overlap by its slop of 5 mm: stock boxes rest 1.5 cm apart, these touch.
/// Continuous collision needs a sum of rims of at least 1.25 cm and has it against every guarded
/// shape; with less, discs and boxes pass through thin floors.
///
/// Adds one fixture, or several pieces: a capsule's box and discs, a large polygon's cuts. Segments
/// keep their rim of 1 cm on both sides.
void AddFixture(const Part& part, const Part& root, float skin, bool guarded, b2Body* body);

/// Cached fixtures of a body: computing them again from the scene at each rebuild would cost about
/// as much as the engine needs to add them.
class ReadyFixtures {
 public:
  /// Copies the body's fixtures; none if one of its shapes is a chain.
  void Take(b2Body* from);
  /// Adds the same fixtures to another body, in their original order. Requires has().
  void Give(b2Body* to) const;
  bool has() const { return !fixtures_.empty(); }

 private:
  struct Fixture {
    b2FixtureDef def;  // without its shape
    std::variant<b2CircleShape, b2PolygonShape, b2EdgeShape> shape;
  };
  std::vector<Fixture> fixtures_;
};

/// User data of a fixture: the part's id in the low 32 bits, the number of its piece above.
inline std::uint32_t PartOf(const b2Fixture* fixture) {
  return static_cast<std::uint32_t>(const_cast<b2Fixture*>(fixture)->GetUserData().pointer &
                                    0xffffffffu);
}
inline std::uint32_t PieceOf(const b2Fixture* fixture) {
  return static_cast<std::uint32_t>(const_cast<b2Fixture*>(fixture)->GetUserData().pointer >> 32);
}

}  // namespace seam
