/// One sweep finds the same contacts as the engine's tree.

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "common/base/random.h"
#include "common/physics/contact_order.h"
#include "common/physics/world_shapes.h"

namespace seam {
namespace contact_find_test {

/// Part and segment of the first shape and of the second.
using Contact = std::tuple<std::uint32_t, int, std::uint32_t, int>;

/// Newest first.
std::vector<Contact> ContactsOf(b2World& world) {
  std::vector<Contact> all;
  for (b2Contact* c = world.GetContactList(); c != nullptr; c = c->GetNext()) {
    all.emplace_back(PartOf(c->GetFixtureA()), c->GetChildIndexA(), PartOf(c->GetFixtureB()),
                     c->GetChildIndexB());
  }
  return all;
}

std::vector<Contact> Sorted(std::vector<Contact> all) {
  std::sort(all.begin(), all.end());
  return all;
}

std::pair<std::pair<std::uint32_t, int>, std::pair<std::uint32_t, int>> KeyOf(const Contact& c) {
  const std::pair<std::uint32_t, int> a{std::get<0>(c), std::get<1>(c)};
  const std::pair<std::uint32_t, int> b{std::get<2>(c), std::get<3>(c)};
  return {std::min(a, b), std::max(a, b)};
}

void Attach(const b2Shape& shape, std::uint32_t part, b2Body* body) {
  b2FixtureDef def;
  def.shape = &shape;
  def.density = 1;
  def.userData.pointer = part;
  body->CreateFixture(&def);
}

/// Discs and boxes, some of two shapes, of all three types, on a ground of many segments; in a room
/// so wide and so high.
void Fill(b2World* world, std::uint64_t seed, float width, float height) {
  Random random(seed);
  b2BodyDef ground;
  b2ChainShape chain;
  std::vector<b2Vec2> points;
  for (int i = 0; i <= 40; ++i) {
    points.push_back(
        {width * static_cast<float>(i) / 40, static_cast<float>(random.Uniform(0, 0.5))});
  }
  chain.CreateChain(points.data(), 41, points.front() - b2Vec2(1, 0), points.back() + b2Vec2(1, 0));
  Attach(chain, 1, world->CreateBody(&ground));
  for (std::uint32_t part = 2; part < 300; part += 2) {
    b2BodyDef def;
    const double kind = random.Uniform(0, 1);
    def.type = kind < 0.2 ? b2_staticBody : kind < 0.3 ? b2_kinematicBody : b2_dynamicBody;
    def.enabled = random.Chance(0.95);
    def.position = {static_cast<float>(random.Uniform(0, width)),
                    static_cast<float>(random.Uniform(0, height))};
    def.angle = static_cast<float>(random.Uniform(-3, 3));
    b2Body* body = world->CreateBody(&def);
    b2PolygonShape box;
    box.SetAsBox(static_cast<float>(random.Uniform(0.2, 1.5)), 0.4f);
    Attach(box, part, body);
    if (random.Chance(0.7)) continue;
    b2CircleShape disc;
    disc.m_radius = 0.5f;
    disc.m_p = {0.6f, 0};
    Attach(disc, part + 1, body);
  }
}

TEST(ContactFind, TheSweepFindsTheEnginesContactsInOrder) {
  for (const auto& [width, height] : {std::pair(120.0f, 8.0f), {8.0f, 120.0f}, {25.0f, 25.0f}}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      b2World swept({0, -10}), engine({0, -10});
      Fill(&swept, seed, width, height);
      Fill(&engine, seed, width, height);
      FindContactsInOrder(&swept);
      engine.Step(0, 1, 1);
      const std::vector<Contact> found = ContactsOf(swept);
      ASSERT_GT(found.size(), 60u);
      ASSERT_EQ(Sorted(found), Sorted(ContactsOf(engine))) << seed;
      for (std::size_t i = 1; i < found.size(); ++i) {
        ASSERT_GT(KeyOf(found[i - 1]), KeyOf(found[i])) << "newest first";
      }
    }
  }
}

TEST(ContactFind, TheEngineFindsContactsOfBodiesThatMoveAfterwards) {
  b2World swept({0, -10}), engine({0, -10});
  for (b2World* world : {&swept, &engine}) Fill(world, 7, 60, 60);
  FindContactsInOrder(&swept);
  engine.Step(0, 1, 1);
  const std::size_t before = ContactsOf(swept).size();
  for (b2World* world : {&swept, &engine}) {
    int moved = 0;
    for (b2Body* b = world->GetBodyList(); b != nullptr && moved < 40; b = b->GetNext()) {
      if (b->GetType() != b2_dynamicBody) continue;
      b->SetTransform({30.0f + 0.1f * static_cast<float>(moved++), 30}, 0);
    }
    world->Step(0, 1, 1);
  }
  EXPECT_GT(ContactsOf(swept).size(), before + 100);
  EXPECT_EQ(Sorted(ContactsOf(swept)), Sorted(ContactsOf(engine)));
}

/// Nobody reads the engine's profile: it does not read the clock for it (world.cpp).
TEST(Engine, ReadsNoClock) {
  b2World engine(b2Vec2(0, -10));
  b2CircleShape circle;
  circle.m_radius = 0.5f;
  for (int i = 0; i < 300; ++i) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position.Set(static_cast<float>(i % 20), static_cast<float>(i / 20));
    engine.CreateBody(&def)->CreateFixture(&circle, 1);
  }
  for (int step = 0; step < 20; ++step) {
    engine.Step(1.0f / 60, 8, 3);
    EXPECT_EQ(engine.GetProfile().step, 0) << "ms; else it takes some";
  }
}

}  // namespace contact_find_test
}  // namespace seam
