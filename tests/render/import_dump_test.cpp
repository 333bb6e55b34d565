/// seam-import against Box2D itself: a world is dumped by the engine, read back, and moves alike.

#include <box2d/box2d.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/physics/world.h"
#include "common/scene/assembly.h"
#include "common/scene/mass.h"
#include "render/import/imported.h"
#include "tests/support/program.h"

namespace seam {
namespace import_dump_test {

/// A ground of chain and edge, and bodies with every kind of shape and joint.
struct Original {
  b2World world{b2Vec2(0.5f, -9)};
  std::vector<b2Body*> moving;

  b2Body* Body(b2BodyType type, float x, float y) {
    b2BodyDef def;
    def.type = type;
    def.position.Set(x, y);
    b2Body* body = world.CreateBody(&def);
    if (type == b2_dynamicBody) moving.push_back(body);
    return body;
  }
  static void Box(b2Body* body, float width, float height, float density,
                  const b2Vec2& at = b2Vec2(0, 0), float angle = 0) {
    b2PolygonShape shape;
    shape.SetAsBox(width / 2, height / 2, at, angle);
    body->CreateFixture(&shape, density);
  }

  Original() {
    b2Body* ground = Body(b2_staticBody, 0, 0);
    // Open on the right of its direction: the ground below is written from right to left.
    const b2Vec2 points[] = {{40, 1}, {20, 0}, {-20, 0}, {-40, 1}};
    b2ChainShape chain;
    chain.CreateChain(points, 4, b2Vec2(60, 2), b2Vec2(-60, 2));
    ground->CreateFixture(&chain, 0);
    b2EdgeShape edge;
    edge.SetTwoSided({-3, 4}, {3, 4});
    ground->CreateFixture(&edge, 0);

    b2Body* odd = Body(b2_dynamicBody, 0, 6);
    odd->SetTransform(odd->GetPosition(), 0.3f);
    Box(odd, 1, 0.5f, 2);
    Box(odd, 0.4f, 1, 1, b2Vec2(0.6f, 0.2f), 0.5f);
    b2CircleShape circle;
    circle.m_p.Set(-0.7f, 0.1f);
    circle.m_radius = 0.3f;
    odd->CreateFixture(&circle, 1);
    odd->SetLinearVelocity({1, 0});
    odd->SetAngularVelocity(-1);

    b2Body* car = Body(b2_dynamicBody, -10, 1);
    Box(car, 3, 0.6f, 1);
    for (const float x : {-1.0f, 1.0f}) {
      b2Body* wheel = Body(b2_dynamicBody, -10 + x, 0.5f);
      b2CircleShape round;
      round.m_radius = 0.4f;
      wheel->CreateFixture(&round, 1)->SetFriction(0.9f);
      b2WheelJointDef def;
      def.Initialize(car, wheel, wheel->GetPosition(), b2Vec2(0, 1));
      b2LinearStiffness(def.stiffness, def.damping, 4, 0.7f, car, wheel);
      def.enableMotor = true;
      def.motorSpeed = -10;
      def.maxMotorTorque = 4;
      world.CreateJoint(&def);
    }

    b2Body* arm = Body(b2_dynamicBody, 9, 8);
    Box(arm, 2, 0.3f, 1);
    b2RevoluteJointDef hinge;
    hinge.Initialize(ground, arm, {8, 8});
    hinge.enableLimit = true;
    hinge.lowerAngle = -1;
    hinge.upperAngle = 1;
    b2Joint* first = world.CreateJoint(&hinge);
    b2Body* slide = Body(b2_dynamicBody, 14, 8);
    Box(slide, 0.5f, 0.5f, 1);
    b2PrismaticJointDef rail;
    rail.Initialize(ground, slide, {14, 8}, {1, 0});
    b2Joint* second = world.CreateJoint(&rail);
    b2GearJointDef gear;
    gear.bodyA = arm;
    gear.bodyB = slide;
    gear.joint1 = first;
    gear.joint2 = second;
    gear.ratio = 0.5f;
    world.CreateJoint(&gear);

    b2Body* floats = Body(b2_dynamicBody, -20, 8);
    Box(floats, 1, 1, 1);
    floats->SetGravityScale(0);
    floats->SetLinearDamping(0.5f);
    floats->SetFixedRotation(true);
    floats->SetLinearVelocity({3, 1});
    b2Body* bob = Body(b2_dynamicBody, -20, 5);
    Box(bob, 0.6f, 0.6f, 1);
    b2DistanceJointDef rod;
    rod.Initialize(floats, bob, floats->GetPosition(), bob->GetPosition());
    world.CreateJoint(&rod);

    b2Body* pulled = Body(b2_dynamicBody, -28, 9);
    Box(pulled, 1, 0.5f, 1);
    b2MotorJointDef motor;
    motor.Initialize(ground, pulled);
    motor.linearOffset += b2Vec2(1, 2);
    motor.angularOffset = 0.4f;
    motor.maxForce = 100;
    motor.maxTorque = 50;
    world.CreateJoint(&motor);
    // Slack between its limits, and rigid in spite of its spring.
    for (const bool slack : {true, false}) {
      b2Body* hangs = Body(b2_dynamicBody, slack ? -32 : -36, 8);
      Box(hangs, 0.5f, 0.5f, 1);
      b2DistanceJointDef def;
      def.Initialize(ground, hangs, hangs->GetPosition() + b2Vec2(0, 2), hangs->GetPosition());
      if (slack) {
        def.minLength = 1;
        def.maxLength = 3;
      } else {
        b2LinearStiffness(def.stiffness, def.damping, 1, 0.5f, ground, hangs);
      }
      world.CreateJoint(&def);
    }
  }
};

std::string DumpOf(b2World* world) {
  const Workspace folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / ".");
  world->Dump();
  std::filesystem::current_path(before);
  std::ifstream file(folder / "box2d_dump.inl");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns the centres of mass of the moving bodies, m.
std::vector<Vec2> CentresOf(const World& world) {
  const Composition composition = Compose(world.scene());
  std::vector<Vec2> centres;
  for (const Assembly& assembly : composition.assemblies) {
    if (assembly.anchored) continue;
    const BodyState now = world.Read(static_cast<int>(centres.size()));
    const Transform2 pose{now.position.cast<double>(), static_cast<double>(now.angle)};
    centres.push_back(pose(AssemblyProperties(world.scene(), assembly).centre).cast<float>());
  }
  return centres;
}

TEST(ImportDump, TheSceneMovesAsTheDumpedWorld) {
  Original original;
  const std::string dump = DumpOf(&original.world);
  ASSERT_FALSE(dump.empty());
  Imported imported = ReadDump(dump, "box2d_dump.inl");
  const std::string text = SceneText(&imported, "dump");
  EXPECT_TRUE(imported.dropped.empty()) << imported.dropped.front();
  World world(ParseScene(text + "\n[solver]\njoints = \"iterative\"\nsleep = false\n", "d.toml"));
  ASSERT_EQ(world.body_count(), static_cast<int>(original.moving.size())) << text;
  original.world.SetAllowSleeping(false);
  for (int tick = 0; tick < 60; ++tick) {
    original.world.Step(1.0f / 60, 8, 3);
    world.Step();
  }
  const std::vector<Vec2> centres = CentresOf(world);
  for (std::size_t i = 0; i < original.moving.size(); ++i) {
    const b2Body& body = *original.moving[i];
    const Vec2 centre(body.GetWorldCenter().x, body.GetWorldCenter().y);
    int nearest = 0;
    for (int b = 1; b < world.body_count(); ++b) {
      const auto off = [&](int which) {
        return (centres[static_cast<std::size_t>(which)] - centre).norm();
      };
      if (off(b) < off(nearest)) nearest = b;
    }
    EXPECT_LT((centres[static_cast<std::size_t>(nearest)] - centre).norm(), 0.02f) << "body " << i;
    EXPECT_NEAR(world.mass(nearest), body.GetMass(), 1e-3f);
  }
}

TEST(ImportDump, AMissingCounterpartIsListed) {
  b2World world(b2Vec2(0, -10));
  b2BodyDef def;
  b2Body* const ground = world.CreateBody(&def);
  Original::Box(ground, 20, 1, 0);
  def.type = b2_dynamicBody;
  def.position.Set(0, 5);
  b2Body* const box = world.CreateBody(&def);
  Original::Box(box, 1, 1, 1);
  def.position.Set(3, 5);
  def.enabled = false;
  Original::Box(world.CreateBody(&def), 1, 1, 1);
  def.enabled = true;
  def.type = b2_kinematicBody;
  def.position.Set(6, 5);
  def.linearVelocity.Set(1, 0);
  def.angularVelocity = 1;
  Original::Box(world.CreateBody(&def), 1, 1, 1);
  b2DistanceJointDef slack;  // Box2D's own limits, 0 and infinity
  slack.bodyA = ground;
  slack.bodyB = box;
  world.CreateJoint(&slack);
  b2MouseJointDef mouse;
  mouse.bodyA = ground;
  mouse.bodyB = box;
  mouse.target = box->GetPosition();
  mouse.maxForce = 10;
  world.CreateJoint(&mouse);

  Imported imported = ReadDump(DumpOf(&world), "d.inl");
  const Scene scene = ParseScene(SceneText(&imported, "d"), "d.toml");
  EXPECT_EQ(scene.parts.size(), 3u);
  std::string all;
  for (const std::string& line : imported.dropped) all += line + "\n";
  for (const char* what : {"is not active", "joint 0: has no values", "slack distance",
                           "moves on without end, here it turns alone"}) {
    EXPECT_NE(all.find(what), std::string::npos) << what << " in\n" << all;
  }
}

TEST(ImportDump, AMouseJointOfBox2d23IsListed) {
  const std::string dump =
      "b2Joint** joints = (b2Joint**)b2Alloc(0 * sizeof(b2Joint*));\n{\n  b2BodyDef bd;\n"
      "  bodies[0] = m_world->CreateBody(&bd);\n}\n{\nMouse joint dumping is not supported.\n}\n";
  EXPECT_EQ(ReadDump(dump, "d.inl").dropped.size(), 1u);
}

TEST(ImportDump, MistakesAreNamedByLine) {
  for (const char* text : {"hello", "b2Vec2 g(1, x);", "bodies[3] = m_world->CreateBody(&bd);",
                           "{\n  b2BodyDef bd;\n  bd.angle = oops;\n"
                           "  bodies[0] = m_world->CreateBody(&bd);\n}"}) {
    try {
      ReadDump(text, "d.inl");
      ADD_FAILURE() << text;
    } catch (const OperatorError& e) {
      EXPECT_EQ(std::string(e.what()).rfind("d.inl", 0), 0u) << e.what();
    }
  }
}

}  // namespace import_dump_test
}  // namespace seam
