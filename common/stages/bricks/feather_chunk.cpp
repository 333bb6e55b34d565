#include "common/stages/bricks/feather_chunk.h"

#include "common/stages/bricks/feather_outline.h"

namespace seam {
namespace {

b2Vec2 Unit(Heading d) {
  constexpr float kX[] = {1, 0, -1, 0}, kY[] = {0, 1, 0, -1};
  return b2Vec2(kX[d], kY[d]);
}

/// Returns the direction into the solid: left of the path.
b2Vec2 Inward(Heading d) { return Unit(static_cast<Heading>((d + 1) % 4)); }

/// Converts to the cell's frame, m, moved in by `depth`.
b2Vec2 Place(const OutlinePath::Corner& c, int x0, int y0, float depth) {
  b2Vec2 point(static_cast<float>(c.x - x0), static_cast<float>(c.y - y0));
  point *= kBrickUnit;
  point += depth * Inward(c.before);
  if (c.after != c.before) point += depth * Inward(c.after);
  return point;
}

}  // namespace

Chunk ChunkOf(const FeatherStore& store, int cell_x, int cell_y, float skin) {
  const int x0 = cell_x * FeatherStore::kCell, y0 = cell_y * FeatherStore::kCell;
  const float depth = skin > 0 ? b2_polygonRadius - skin : 0;
  Chunk chunk;
  chunk.corner.Set(static_cast<float>(x0) * kBrickUnit, static_cast<float>(y0) * kBrickUnit);
  for (const OutlinePath& path : OutlinesOf(store, cell_x, cell_y)) {
    Chunk::Chain chain;
    for (const auto& corner : path.corners) chain.points.push_back(Place(corner, x0, y0, depth));
    chain.closed = path.closed;
    // Continuation of the outline in the next cell: one metre; only its direction matters.
    chain.before = chain.points.front() - Unit(path.corners.front().before);
    chain.after = chain.points.back() + Unit(path.corners.back().after);
    for (const BrickKind& kind : store.kinds()) {
      if (kind.surface != path.surface) continue;
      chain.friction = kind.friction;
      chain.restitution = kind.restitution;
      break;
    }
    chunk.chains.push_back(std::move(chain));
  }
  return chunk;
}

b2Body* AddChunk(const Chunk& chunk, std::uintptr_t first_id, b2World* world) {
  if (chunk.chains.empty()) return nullptr;
  b2BodyDef def;
  def.position = chunk.corner;
  b2Body* body = world->CreateBody(&def);
  for (const Chunk::Chain& chain : chunk.chains) {
    b2ChainShape shape;
    const auto count = static_cast<int32>(chain.points.size());
    if (chain.closed) {
      shape.CreateLoop(chain.points.data(), count);
    } else {
      shape.CreateChain(chain.points.data(), count, chain.before, chain.after);
    }
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.userData.pointer = first_id++;
    fixture.friction = chain.friction;
    fixture.restitution = chain.restitution;
    body->CreateFixture(&fixture);
  }
  return body;
}

}  // namespace seam
