#pragma once
/// The push of an explosion: pushes the first thing on each ray from its centre.

#include <box2d/box2d.h>

#include <vector>

#include "common/scene/scene.h"
#include "common/topology/edit.h"
#include "common/topology/feather_store.h"

namespace seam {

/// Effect of one ray of a blast on the shape that it hits.
struct BlastHit {
  b2Fixture* fixture = nullptr;  ///< of a part, anchored ones included
  b2Vec2 point{0, 0};            ///< m
  b2Vec2 impulse{0, 0};          ///< N s
};

/// Casts rays evenly all around, 128 to 1024, at most 6 cm apart at the radius. A ray stands for
/// its share of the circle: a metre of silhouette at the distance r receives impulse (1 - r/radius)
/// along the ray. A ray stops at the first body, anchored part or brick of `bricks`; a piece that
/// the blast has just freed from bricks counts with the space that its bricks filled. Shapes around
/// the centre, sensors and fixtures of stages are ignored. Equal poses give equal hits, in the
/// order of the rays. Requires a blast that topology accepts.
///
///      centre *----- ray ----->[crate] |wall|     nothing behind the crate is pushed
std::vector<BlastHit> HitsOf(const b2World& world, const Scene& scene, const FeatherStore& bricks,
                             const BlastEdit& blast);

/// Applies the impulses to the dynamic bodies that were hit and wakes them. Their speeds are
/// limited to `speed_limit`, m/s, and kSpinMax.
void PushAway(const std::vector<BlastHit>& hits, float speed_limit);

}  // namespace seam
