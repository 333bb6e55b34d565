#pragma once
/// Joints that couple movements: gears and pulleys in the engine, and their forces.
///
///   gear:    q1 + ratio q2 = 0, q the angle (hinge) or shift (prismatic) of a joint from its start
///   pulley:  |anchor_a - ground_a| + ratio |anchor_b - ground_b| = length
///
///       ground_a o-------o ground_b         Box2D treats both as equations: the rope of a pulley
///                |       |                  also pushes. With lambda the impulse along its row,
///       anchor_a #       # anchor_b         a pulley moves a by -lambda u_a and b by
///                                           -ratio lambda u_b, u from the ground to the anchor.

#include <box2d/box2d.h>

#include "common/scene/scene.h"

namespace seam {

/// Requires joints that are hinges or prismatic, made from `gear.coupled`. The gear must not
/// outlive them.
b2Joint* MakeGear(const Joint& gear, b2Joint* first, b2Joint* second, b2World* world);

b2Joint* MakePulley(const Joint& pulley, b2Body* a, b2Body* b, b2World* world);

/// The forces of a joint on its two bodies in the last step, N, without torques. `hz`: steps per
/// second.
struct JointForces {
  b2Vec2 on_a{0, 0}, on_b{0, 0};
};
JointForces ForcesOf(b2Joint* joint, float hz);

}  // namespace seam
