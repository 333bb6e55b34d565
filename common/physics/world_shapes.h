#pragma once
/// A part as Box2D's shape, with the rim (skin) that its scene asks for.

#include <box2d/box2d.h>

#include "common/physics/scene.h"

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
/// Continuous collision wants a sum of rims of 1.25 cm or more, and has it against all that is
/// guarded; with less, discs and boxes pass through thin floors.
void AddFixture(const Part& part, const Part& root, float skin, bool guarded, b2Body* body);

}  // namespace seam
