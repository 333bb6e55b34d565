#pragma once
/// A cell's bricks as fixtures of one static body.

#include <box2d/box2d.h>

#include <vector>

#include "common/topology/feather_store.h"

namespace seam {

/// What a cell's body is made of: one chain per outline. Kept, so that a world that is built anew
/// need not trace the outlines again.
struct Chunk {
  struct Chain {
    std::vector<b2Vec2> points;  ///< m, from the cell's corner
    bool closed = false;
    b2Vec2 before{0, 0}, after{0, 0};  ///< of open ones: how the outline goes on beyond the ends
    float friction = 0, restitution = 0;
  };
  b2Vec2 corner{0, 0};  ///< m
  std::vector<Chain> chains;
};

/// `skin`: of the scene's solver; the surface is moved in as that of other anchored things.
Chunk ChunkOf(const FeatherStore& store, int cell_x, int cell_y, float skin);

/// A static body without user data. `first_id`: user data of the first fixture, ascending. nullptr
/// for a chunk without chains.
b2Body* AddChunk(const Chunk& chunk, std::uintptr_t first_id, b2World* world);

}  // namespace seam
