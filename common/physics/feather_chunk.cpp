#include "common/physics/feather_chunk.h"

#include "common/physics/feather_outline.h"

namespace seam {
namespace {

b2Vec2 Unit(Heading d) {
  constexpr float kX[] = {1, 0, -1, 0}, kY[] = {0, 1, 0, -1};
  return b2Vec2(kX[d], kY[d]);
}

/// Into the solid: left of the way.
b2Vec2 Inward(Heading d) { return Unit(static_cast<Heading>((d + 1) % 4)); }

/// In the cell's frame, m, moved in by `depth`.
b2Vec2 Place(const OutlinePath::Corner& c, int x0, int y0, float depth) {
  b2Vec2 point(static_cast<float>(c.x - x0), static_cast<float>(c.y - y0));
  point *= kBrickUnit;
  point += depth * Inward(c.before);
  if (c.after != c.before) point += depth * Inward(c.after);
  return point;
}

}  // namespace

b2Body* AddChunk(const FeatherStore& store, int cell_x, int cell_y, float skin,
                 std::uintptr_t first_id, b2World* world) {
  const std::vector<OutlinePath> paths = OutlinesOf(store, cell_x, cell_y);
  if (paths.empty()) return nullptr;
  const int x0 = cell_x * FeatherStore::kCell, y0 = cell_y * FeatherStore::kCell;
  const float depth = skin > 0 ? b2_polygonRadius - skin : 0;
  b2BodyDef def;
  def.position.Set(static_cast<float>(x0) * kBrickUnit, static_cast<float>(y0) * kBrickUnit);
  b2Body* body = world->CreateBody(&def);
  std::vector<b2Vec2> points;
  std::uintptr_t id = first_id;
  for (const OutlinePath& path : paths) {
    points.clear();
    for (const OutlinePath::Corner& c : path.corners) points.push_back(Place(c, x0, y0, depth));
    b2ChainShape chain;
    const auto count = static_cast<int32>(points.size());
    if (path.closed) {
      chain.CreateLoop(points.data(), count);
    } else {
      // How the outline goes on in the next cell: a metre of it, only its direction matters.
      chain.CreateChain(points.data(), count, points.front() - Unit(path.corners.front().before),
                        points.back() + Unit(path.corners.back().after));
    }
    b2FixtureDef fixture;
    fixture.shape = &chain;
    fixture.userData.pointer = id++;
    for (const BrickKind& kind : store.kinds()) {
      if (kind.surface != path.surface) continue;
      fixture.friction = kind.friction;
      fixture.restitution = kind.restitution;
      break;
    }
    body->CreateFixture(&fixture);
  }
  return body;
}

}  // namespace seam
