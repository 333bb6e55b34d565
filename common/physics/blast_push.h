#pragma once
/// The push of an explosion: what its centre sees is pushed, the first thing on each ray takes all.

#include <box2d/box2d.h>

#include <vector>

#include "common/scene/scene.h"
#include "common/topology/edit.h"
#include "common/topology/feather_store.h"

namespace seam {

/// What one ray of a blast does to the shape that it hits.
struct BlastHit {
  b2Fixture* fixture = nullptr;  ///< of a part, anchored ones included
  b2Vec2 point{0, 0};            ///< m
  b2Vec2 impulse{0, 0};          ///< N s
};

/// As many rays as leave at most 6 cm between them at the radius, 128 to 1024, evenly all around.
/// A ray stands for its share of the circle: a metre of silhouette at the distance r takes
/// impulse (1 - r/radius) along the ray. Cover is what is hit first: bodies, anchored parts and
/// `bricks`, and of pieces that the blast has just freed from bricks the room of those; but not
/// what the centre lies in, sensors, and what stages made. Equal poses give equal hits, in the
/// order of the rays. Requires a blast that topology accepts.
///
///      centre *----- ray ----->[crate] |wall|     behind both nothing is pushed
std::vector<BlastHit> HitsOf(const b2World& world, const Scene& scene, const FeatherStore& bricks,
                             const BlastEdit& blast);

/// Pushes the dynamic bodies among what is hit, and wakes them. None becomes faster by it than
/// `speed_limit`, m/s, or than the engine turns (kSpinMax).
void PushAway(const std::vector<BlastHit>& hits, float speed_limit);

}  // namespace seam
