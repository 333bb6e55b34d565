#pragma once
/// A cell's bricks as fixtures of one static body.

#include <box2d/box2d.h>

#include <vector>

#include "common/topology/feather_store.h"

namespace seam {

/// Shapes of a cell's body: one chain per outline. Kept, so that a rebuilt world need not trace the
/// outlines again.
struct Chunk {
  struct Chain {
    std::vector<b2Vec2> points;  ///< m, from the cell's corner
    bool closed = false;
    b2Vec2 before{0, 0}, after{0, 0};  ///< open chains: the outline's continuation beyond the ends
    float friction = 0, restitution = 0;
  };
  b2Vec2 corner{0, 0};  ///< m
  std::vector<Chain> chains;
};

/// Builds a cell's chains. `skin`: the scene's; the surface is moved in like that of other anchored
/// parts.
Chunk ChunkOf(const FeatherStore& store, int cell_x, int cell_y, float skin);

/// Creates a static body without user data. `first_id`: user data of the first fixture, ascending.
/// Returns nullptr for a chunk without chains.
b2Body* AddChunk(const Chunk& chunk, std::uintptr_t first_id, b2World* world);

}  // namespace seam
