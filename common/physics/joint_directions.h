#pragma once
/// The directions that the engine's joints use to compute their reactions. The engine sets them
/// when it solves a joint; another solver in its place has to set them.

#include <box2d/box2d.h>

namespace seam {

/// Sets the directions for the bodies' current poses. Requires a joint that MakeJoint has made.
void SetDirections(b2Joint* joint);

}  // namespace seam
