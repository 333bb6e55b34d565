#pragma once
/// The directions along which the engine's joints read their reactions. The engine finds them when
/// it solves a joint; whoever solves in its place has to set them.

#include <box2d/box2d.h>

namespace seam {

/// For the bodies as they lie now. Requires a joint that MakeJoint has made.
void SetDirections(b2Joint* joint);

}  // namespace seam
