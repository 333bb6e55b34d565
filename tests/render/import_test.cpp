/// seam-import: R.U.B.E. JSON and Tiled maps as scenes that load, and what is dropped.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "common/base/check.h"
#include "common/physics/world.h"
#include "common/scene/mass.h"
#include "common/scene/motion/part_motion.h"
#include "common/scene/scene.h"
#include "render/import/imported.h"

namespace seam {
namespace import_test {

const char* kRube = R"({
"gravity": {"x": 0, "y": -9.5},
"body": [
 {"name": "ground", "type": 0, "position": 0, "angle": 0, "fixture": [
   {"name": "terrain", "friction": 0.4,
    "chain": {"vertices": {"x": [-10, 0, 10], "y": [1, 0, 1]}}}]},
 {"name": "cart body", "type": 2, "position": {"x": 1, "y": 3}, "angle": 0.25,
  "linearVelocity": {"x": 2, "y": 0}, "linearDamping": 0.5, "gravityScale": 0.5, "fixture": [
   {"density": 2, "filter-categoryBits": 2, "filter-maskBits": 65533, "filter-groupIndex": -3,
    "polygon": {"vertices": {"x": [-1, 1, 1, -1], "y": [-0.5, -0.5, 0.5, 0.5]}}},
   {"density": 1, "circle": {"center": {"x": 1, "y": 0}, "radius": "3F000000"}},
   {"name": "feeler", "sensor": true, "circle": {"center": 0, "radius": 3}}]},
 {"name": "bob", "type": 2, "position": {"x": 1, "y": 1}, "angle": 0, "fixture": [
   {"density": 0.001, "friction": 1.5, "polygon": {"vertices": {"x": [0, 1, 0.2, 0],
     "y": [0, 0, 0.2, 1]}}}]}],
"joint": [
 {"type": "revolute", "name": "pin", "bodyA": 1, "bodyB": 2, "anchorA": {"x": 0.5, "y": -0.5},
  "anchorB": {"x": 0, "y": 0}, "refAngle": 0.1, "enableLimit": true, "lowerLimit": -1,
  "upperLimit": 1, "enableMotor": true, "motorSpeed": 3, "maxMotorTorque": 20},
 {"type": "friction", "name": "rub", "bodyA": 0, "bodyB": 1}],
"image": [{"name": "sky"}]
})";

std::string ErrorOf(const std::function<void()>& run) {
  try {
    run();
  } catch (const OperatorError& e) {
    return e.what();
  }
  return "";
}

const Part& Named(const Scene& scene, const std::string& name) {
  for (const Part& part : scene.parts) {
    if (part.name == name) return part;
  }
  throw std::runtime_error("no part " + name);
}

TEST(Import, RubeBodiesFixturesAndJointsAreThere) {
  Imported world = ReadRube(kRube, "r.json");
  const Scene scene = ParseScene(SceneText(&world, "r.json"), "r.toml");
  EXPECT_EQ(scene.gravity, Vec2(0, -9.5f));
  const Part& cart = Named(scene, "cart-body");
  EXPECT_EQ(cart.kind, ShapeKind::kBox);
  EXPECT_EQ(cart.size, Vec2(2, 1));
  EXPECT_NEAR(cart.angle, 0.25, 1e-6);
  EXPECT_EQ(cart.filter.category, 2);
  EXPECT_EQ(cart.filter.mask, 65533);
  EXPECT_EQ(cart.filter.group, -3);
  EXPECT_EQ(cart.motion->linear_damping, 0.5f);
  EXPECT_EQ(cart.motion->gravity_scale, 0.5f);
  EXPECT_EQ(cart.velocity, Vec2(2, 0));
  EXPECT_EQ(Named(scene, "cart-body-2").radius, 0.5f) << "a float in hexadecimal digits";
  EXPECT_EQ(Named(scene, "ground").kind, ShapeKind::kChain);
  EXPECT_EQ(Named(scene, "ground-2").points.front(), Named(scene, "ground").points.back());
  const auto pin = std::find_if(scene.joints.begin(), scene.joints.end(),
                                [](const Joint& j) { return j.name == "pin"; });
  ASSERT_NE(pin, scene.joints.end());
  EXPECT_EQ(pin->kind, JointKind::kRevolute);
  EXPECT_EQ(pin->motor_speed, 3);
  EXPECT_EQ(pin->lower, -1);
  // The concave outline became triangles of the same area.
  double area = 0;
  for (const Part& part : scene.parts) {
    if (part.name.rfind("bob", 0) == 0) area += PartProperties(part).mass / 0.01;
  }
  EXPECT_NEAR(area, 0.2, 1e-4);
}

TEST(Import, DroppedThingsAreListed) {
  Imported world = ReadRube(kRube, "r.json");
  SceneText(&world, "r.json");
  std::string all;
  for (const std::string& line : world.dropped) all += line + "\n";
  for (const char* what : {"sky", "feeler: a sensor", "rub", "density", "friction of 1.5"}) {
    EXPECT_NE(all.find(what), std::string::npos) << what << " in\n" << all;
  }
}

TEST(Import, RubeStatesMassesAndEdgesAreKeptOrListed) {
  const char* const square = R"("fixture": [
   {"density": 1, "polygon": {"vertices": {"x": [0, 1, 1, 0], "y": [0, 0, 1, 1]}}}])";
  const std::string text = std::string(R"({"gravity": {"x": 0, "y": -10}, "body": [
 {"name": "ground", "type": 0, "fixture": [
   {"edge": {"vertex1": {"x": -9, "y": 0}, "vertex2": {"x": 9, "y": 0}}},
   {"polygon": {"vertices": {"x": [9, 20], "y": [0, 5]}}},
   {"name": "wide", "polygon": {"vertices": {"x": [-3000, 3000, 3000, -3000],
    "y": [-9, -9, -8, -8]}}}]},
 {"name": "off", "type": 2, "active": false, )") +
                           square + R"(},
 {"name": "sleeper", "type": 2, "awake": false, )" +
                           square +
                           R"(},
 {"name": "heavy", "type": 2, "massData-mass": 50, "position": {"x": 5, "y": 3}, )" +
                           square + R"(}],
"joint": [{"type": "motor", "name": "m", "bodyA": 0, "bodyB": 3, "anchorA": {"x": 5, "y": 7},
  "refAngle": 0.5, "maxForce": 100, "maxTorque": 90}]})";
  Imported world = ReadRube(text, "r.json");
  const Scene scene = ParseScene(SceneText(&world, "r.json"), "r.toml");
  EXPECT_NEAR(PartProperties(Named(scene, "heavy")).mass, 50, 0.01);
  EXPECT_EQ(Named(scene, "ground").kind, ShapeKind::kChain);
  EXPECT_EQ(Named(scene, "ground-3").points.size(), 2u);
  EXPECT_EQ(Named(scene, "ground-5").kind, ShapeKind::kChain);
  EXPECT_THROW(Named(scene, "off"), std::runtime_error);
  ASSERT_EQ(scene.joints.size(), 1u);
  EXPECT_NEAR(scene.joints[0].turn, -0.5, 1e-6);
  std::string all;
  for (const std::string& line : world.dropped) all += line + "\n";
  for (const char* what : {"'off': is not active", "'sleeper': sleeps", "50 kg", "wide: wider"}) {
    EXPECT_NE(all.find(what), std::string::npos) << what << " in\n" << all;
  }
}

TEST(Import, RubeMistakesAreOneLine) {
  for (const char* text :
       {"{", "{\"body\": 3}", "{}", "[]", "{\"body\": [{\"type\": 7}]}",
        "{\"body\": [{\"fixture\": [{}]}]}", "{\"body\": [{\"angle\": \"zz\"}]}"}) {
    const std::string error = ErrorOf([&] { ReadRube(text, "r.json"); });
    EXPECT_EQ(error.rfind("r.json", 0), 0u) << text << ": " << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

const char* kTiled = R"(<?xml version="1.0"?>
<map width="10" height="10" tilewidth="16" tileheight="16">
 <layer id="1" name="pictures" width="10" height="10"><data encoding="csv">0</data></layer>
 <objectgroup name="solid">
  <object id="1" name="floor" x="0" y="144" width="160" height="16"/>
  <object id="2" name="hill" x="32" y="144"><polygon points="0,0 16,-16 32,-8 48,0"/></object>
  <object id="3" name="start" x="1" y="1"><point/></object>
 </objectgroup>
 <objectgroup name="things" offsetx="16">
  <properties><property name="body" value="dynamic"/></properties>
  <object id="4" x="16" y="16" width="32" height="16" rotation="90">
   <properties><property name="density" type="float" value="2"/></properties></object>
  <object id="5" name="ball" x="80" y="32" width="16" height="16"><ellipse/></object>
 </objectgroup>
</map>)";

TEST(Import, TiledObjectsStandWhereTheMapShowsThem) {
  Imported world = ReadTiled(kTiled, "m.tmx", 16);
  const Scene scene = ParseScene(SceneText(&world, "m.tmx"), "m.toml");
  const Part& floor = Named(scene, "floor");
  EXPECT_TRUE(floor.anchored);
  EXPECT_LT((floor.position - Vec2(5, 0.5f)).norm(), 1e-5);
  // Turned clockwise about its upper left corner at (2, 9): it hangs to the left and below.
  const Part& box = Named(scene, "object-4");
  EXPECT_FALSE(box.anchored);
  EXPECT_LT((box.position - Vec2(1.5f, 8)).norm(), 1e-5) << box.position.transpose();
  EXPECT_EQ(box.material.density, 2);
  const Part& ball = Named(scene, "ball");
  EXPECT_EQ(ball.radius, 0.5f);
  EXPECT_LT((ball.position - Vec2(6.5f, 7.5f)).norm(), 1e-5);
  EXPECT_EQ(world.dropped.size(), 2u) << "the layer of tiles and the point";
}

TEST(Import, TiledMapsThatPlaceObjectsOtherwiseAreListed) {
  std::string text = kTiled;
  const std::size_t at = text.find("<map ");
  text.insert(at + 5, "orientation=\"isometric\" ");
  text.insert(text.find('>', at) + 1, "<tileset name=\"t\" objectalignment=\"center\"/>");
  const Imported world = ReadTiled(text, "m.tmx", 16);
  const auto listed = [&](const std::string& line) {
    return std::count(world.dropped.begin(), world.dropped.end(), line) == 1;
  };
  EXPECT_TRUE(listed("map: is isometric; objects stand as on an orthogonal one"));
  EXPECT_TRUE(listed("tileset 't': objects aligned center; here by their lower left corner"));
}

TEST(Import, TiledMistakesAreOneLine) {
  for (const char* text :
       {"<map", "<html/>", "<map/>", "<map><objectgroup><object x=\"a\"/></objectgroup></map>"}) {
    const std::string error = ErrorOf([&] { ReadTiled(text, "m.tmx", 16); });
    EXPECT_EQ(error.rfind("m.tmx", 0), 0u) << text << ": " << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(Import, RubeLinesThatMoveAreSolidFromBothSides) {
  Imported world = ReadRube(R"({"gravity": {"x": 0, "y": -10}, "body": [
 {"name": "edge", "type": 2, "position": {"x": 0, "y": 3}, "fixture": [
   {"density": 1, "edge": {"vertex1": {"x": -1, "y": 0}, "vertex2": {"x": 1, "y": 0}}}]},
 {"name": "still", "type": 0, "fixture": [
   {"edge": {"vertex1": {"x": -9, "y": 0}, "vertex2": {"x": 9, "y": 0}}}]}]})",
                            "r.json");
  const Scene scene = ParseScene(SceneText(&world, "r.json"), "r.toml");
  EXPECT_EQ(Named(scene, "edge").kind, ShapeKind::kSegment);
  EXPECT_FALSE(Named(scene, "edge").anchored);
  EXPECT_EQ(Named(scene, "still").kind, ShapeKind::kChain);
}

TEST(Import, AWheelWithoutASpringIsFreeAlongItsAxis) {
  const std::string bodies = R"({"gravity": {"x": 0, "y": -10}, "body": [
 {"name": "hub", "type": 0, "position": {"x": 0, "y": 9}, "fixture": [
   {"polygon": {"vertices": {"x": [-1, 1, 1, -1], "y": [1, 1, 2, 2]}}}]},
 {"name": "wheel", "type": 2, "position": {"x": 0, "y": 9}, "massData-mass": 3.14159,
  "massData-center": {"x": 0.4, "y": 0}, "fixture": [
   {"density": 1, "circle": {"center": 0, "radius": 1}}]}],
"joint": [{"type": "wheel", "name": "j", "bodyA": 0, "bodyB": 1, "anchorA": 0, "anchorB": 0,
  "localAxisA": {"x": 0, "y": 1}, "springFrequency": FREQUENCY}]})";
  for (const char* frequency : {"0", "4"}) {
    std::string text = bodies;
    text.replace(text.find("FREQUENCY"), 9, frequency);
    Imported imported = ReadRube(text, "r.json");
    const Scene scene = ParseScene(SceneText(&imported, "r.json"), "r.toml");
    World world(scene);
    for (int tick = 0; tick < 30; ++tick) world.Step();
    const double fallen = 9 - static_cast<double>(world.Read(0).position.y());
    const bool free = std::string(frequency) == "0";
    EXPECT_NEAR(fallen, free ? 1.25 : 0.03, free ? 0.1 : 0.03) << frequency;
    const auto listed =
        std::find_if(imported.dropped.begin(), imported.dropped.end(), [](const std::string& line) {
          return line.find("a centre of mass at [0.4, 0] set by hand") != std::string::npos;
        });
    EXPECT_NE(listed, imported.dropped.end());
  }
}

}  // namespace import_test
}  // namespace seam
