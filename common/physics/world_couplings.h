#pragma once
/// Joints that couple movements: gears and pulleys in the engine, and what they pull at.
///
///   gear:    q1 + ratio q2 = 0, q the angle (hinge) or shift (prismatic) of a joint since the
///   start pulley:  |anchor_a - ground_a| + ratio |anchor_b - ground_b| = length
///
///       ground_a o-------o ground_b         Box2D takes both for equations: the rope of a pulley
///                |       |                  pushes, too. With lambda the impulse along its rows,
///       anchor_a #       # anchor_b         a pulley moves a by -lambda u_a and b by
///                                           -ratio lambda u_b, u from the ground to the anchor.

#include <box2d/box2d.h>

#include "common/scene/scene.h"

namespace seam {

/// Requires joints that are hinges or prismatic, made from `gear.coupled`. It must not outlive
/// them.
b2Joint* MakeGear(const Joint& gear, b2Joint* first, b2Joint* second, b2World* world);

b2Joint* MakePulley(const Joint& pulley, b2Body* a, b2Body* b, b2World* world);

/// The forces of any joint on its two bodies in the last step, N, not the torques. `hz`: steps per
/// second.
struct JointForces {
  b2Vec2 on_a{0, 0}, on_b{0, 0};
};
JointForces ForcesOf(b2Joint* joint, float hz);

}  // namespace seam
