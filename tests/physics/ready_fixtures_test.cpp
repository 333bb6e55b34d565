/// ReadyFixtures: a body that is given the fixtures of another has the same, bit for bit.

#include <gtest/gtest.h>

#include "common/physics/world_shapes.h"
#include "common/scene/scene.h"

namespace seam {
namespace ready_fixtures_test {

/// Parts of every kind that may move; a polygon of ten corners is two pieces, a capsule three.
const char* const kParts = R"(
[[part]]
name = "box"
box = [1.3, 0.7]
friction = 0.3
[[part]]
name = "disc"
circle = 0.4
restitution = 0.6
[[part]]
name = "capsule"
capsule = [1.5, 0.4]
[[part]]
name = "many"
polygon = [[1, 0], [0.8, 0.6], [0.3, 0.95], [-0.3, 0.95], [-0.8, 0.6], [-1, 0], [-0.8, -0.6],
  [-0.3, -0.95], [0.3, -0.95], [0.8, -0.6]]
group = -2
)";

void ExpectSame(b2Fixture& a, b2Fixture& b) {
  EXPECT_EQ(a.GetFriction(), b.GetFriction());
  EXPECT_EQ(a.GetRestitution(), b.GetRestitution());
  EXPECT_EQ(a.GetDensity(), b.GetDensity());
  EXPECT_EQ(a.GetUserData().pointer, b.GetUserData().pointer);
  EXPECT_EQ(a.GetFilterData().groupIndex, b.GetFilterData().groupIndex);
  ASSERT_EQ(a.GetType(), b.GetType());
  EXPECT_EQ(a.GetShape()->m_radius, b.GetShape()->m_radius);
  if (a.GetType() == b2Shape::e_circle) {
    EXPECT_EQ(static_cast<b2CircleShape*>(a.GetShape())->m_p,
              static_cast<b2CircleShape*>(b.GetShape())->m_p);
    return;
  }
  const auto& x = *static_cast<b2PolygonShape*>(a.GetShape());
  const auto& y = *static_cast<b2PolygonShape*>(b.GetShape());
  ASSERT_EQ(x.m_count, y.m_count);
  EXPECT_EQ(x.m_centroid, y.m_centroid);
  for (int32 i = 0; i < x.m_count; ++i) {
    EXPECT_EQ(x.m_vertices[i], y.m_vertices[i]);
    EXPECT_EQ(x.m_normals[i], y.m_normals[i]);
  }
}

b2Body* Body(b2World* world) {
  b2BodyDef def;
  def.type = b2_dynamicBody;
  return world->CreateBody(&def);
}

TEST(ReadyFixtures, ABodyThatIsGivenThemHasTheSameInTheSameOrder) {
  const Scene scene = ParseScene(kParts, "ready.toml");
  b2World world(b2Vec2(0, 0));
  b2Body* const first = Body(&world);
  for (const Part& part : scene.parts) AddFixture(part, scene.parts[0], 0.0025f, false, first);
  ReadyFixtures ready;
  EXPECT_FALSE(ready.has());
  ready.Take(first);
  ASSERT_TRUE(ready.has());
  b2Body* const second = Body(&world);
  ready.Give(second);
  int count = 0;
  b2Fixture *a = first->GetFixtureList(), *b = second->GetFixtureList();
  for (; a != nullptr && b != nullptr; a = a->GetNext(), b = b->GetNext(), ++count) {
    ExpectSame(*a, *b);
  }
  EXPECT_EQ(a, nullptr);
  EXPECT_EQ(b, nullptr);
  EXPECT_EQ(count, 1 + 1 + 3 + 2);
}

TEST(ReadyFixtures, ABodyWithAChainIsNotRemembered) {
  b2World world(b2Vec2(0, 0));
  b2Body* const body = Body(&world);
  const b2Vec2 points[] = {{0, 0}, {1, 0}, {2, 1}};
  b2ChainShape chain;
  chain.CreateChain(points, 3, {-1, 0}, {3, 2});
  b2CircleShape disc;
  disc.m_radius = 1;
  body->CreateFixture(&disc, 0);
  body->CreateFixture(&chain, 0);
  ReadyFixtures ready;
  ready.Take(body);
  EXPECT_FALSE(ready.has());
}

}  // namespace ready_fixtures_test
}  // namespace seam
