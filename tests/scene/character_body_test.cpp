/// The parts of a [[character]], and passive characters.

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/scene/character.h"
#include "tests/support/character_world.h"

namespace seam {
namespace character_body_test {

std::string Complaint(const std::string& character) {
  try {
    ParseScene(
        std::string("[[player]]\nname = \"ann\"\n") + kFlatGround + "[[character]]\n" + character,
        "s.toml");
    return "";
  } catch (const OperatorError& e) {
    return e.what();
  }
}

TEST(Character, IsTwelvePartsAndElevenHingesOfOneMechanism) {
  const Scene scene = CharacterScene("position = [3, 0]\n");
  EXPECT_EQ(scene.parts.size(), 1u + kCharacterParts);
  EXPECT_EQ(scene.joints.size(), static_cast<std::size_t>(kCharacterJoints));
  EXPECT_EQ(Compose(scene).mechanisms.size(), 1u);
  EXPECT_EQ(JointsOf(scene, 0).size(), static_cast<std::size_t>(kCharacterJoints));
  EXPECT_EQ(scene.joints[static_cast<std::size_t>(JointsOf(scene, 0)[kNeck])].name, "hero.neck");
  float low = 10, high = 0;
  for (const Part& part : scene.parts) {
    if (part.kind == ShapeKind::kChain) continue;
    for (const Vec2& p : part.points) {
      low = std::min(low, part.position.y() + p.y());
      high = std::max(high, part.position.y() + p.y());
    }
    EXPECT_EQ(part.owner, 0);
  }
  EXPECT_NEAR(low, 0, 1e-5);
  EXPECT_NEAR(high, 1.8, 0.01);
}

TEST(Character, ItsPartsAreConvexOutlinesOfEightCornersWithFlatSoles) {
  for (const char* facing : {"right", "left"}) {
    for (const char* height : {"1", "1.8", "5"}) {
      const Scene scene = CharacterScene(std::string("position = [0, 0]\nfacing = \"") + facing +
                                         "\"\nheight = " + height + "\n");
      for (const PartId id : scene.characters[0].parts) {
        const Part& part = scene.parts[static_cast<std::size_t>(id)];
        ASSERT_EQ(part.points.size(), 8u) << part.name;
        for (std::size_t i = 0; i < 8; ++i) {
          const Vec2 edge = part.points[(i + 1) % 8] - part.points[i];
          const Vec2 next = part.points[(i + 2) % 8] - part.points[(i + 1) % 8];
          EXPECT_GT(edge.x() * next.y() - edge.y() * next.x(), 0) << part.name << " corner " << i;
          EXPECT_GT(edge.norm(), 0.005f) << part.name << " corner " << i;
        }
      }
      const Character& hero = scene.characters[0];
      for (const CharacterPart foot : {kFootLeft, kFootRight}) {
        const PartId id = hero.parts[static_cast<std::size_t>(foot)];
        const Part& part = scene.parts[static_cast<std::size_t>(id)];
        std::vector<float> sole;  // how far its corners are before the ankle
        for (const Vec2& p : part.points) {
          const Vec2 at = part.position + p;
          if (std::abs(at.y()) < 1e-4f * hero.height) sole.push_back(hero.facing * at.x());
        }
        std::sort(sole.begin(), sole.end());
        ASSERT_EQ(sole.size(), 2u) << facing;
        EXPECT_NEAR(sole[0], -CharacterShape().heel * hero.height / 1.8f, 1e-4f);
        EXPECT_NEAR(sole[1], CharacterShape().toe * hero.height / 1.8f, 1e-4f);
      }
    }
  }
}

TEST(Character, BoundsOfTorqueGrowWithTheThirdPowerOfItsHeight) {
  // In two dimensions mass grows with the square, so weight x height with the cube.
  const Scene one = CharacterScene("position = [0, 0]\n");
  const Scene two = CharacterScene("position = [0, 0]\nheight = 3.6\n");
  const Scene strong = CharacterScene("position = [0, 0]\nstrength = 2\ntorque = {hip = 3}\n");
  for (int j = 0; j < kCharacterJoints; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    const float bound = one.joints[joint].motor_torque;
    EXPECT_GT(bound, 0);
    EXPECT_NEAR(two.joints[joint].motor_torque / bound, 8, 1e-3);
    const bool hip = j == kHipLeft || j == kHipRight;
    EXPECT_NEAR(strong.joints[joint].motor_torque, hip ? 6 : 2 * bound, 1e-5);
  }
}

TEST(Character, AMirroredOneMovesLikeItsImage) {
  // m and rad: joints are solved in an order that the mirror turns round.
  constexpr float kMirror = 0.01f;
  ScriptedWorld right(
      CharacterScene("position = [0, 0.5]\nkind = \"passive\"\nvelocity = [2, 0]\n"));
  ScriptedWorld left(CharacterScene(
      "position = [0, 0.5]\nkind = \"passive\"\nfacing = \"left\"\nvelocity = [-2, 0]\n"));
  for (ScriptedWorld* run : {&right, &left}) run->StepTo(20);
  for (const char* part : {"hero.head", "hero.foot-l", "hero.lower-leg-r"}) {
    EXPECT_NEAR(right.Read(part).position.x(), -left.Read(part).position.x(), kMirror) << part;
    EXPECT_NEAR(right.Read(part).position.y(), left.Read(part).position.y(), kMirror) << part;
    EXPECT_NEAR(right.Read(part).angle, -left.Read(part).angle, kMirror) << part;
  }
}

TEST(Character, APassiveOneKeepsItsJointsLimitsAndComesToRest) {
  ScriptedWorld run(CharacterScene("position = [0, 3]\nangle = 0.7\nkind = \"passive\"\n"));
  double beyond = 0;
  for (int tick = 0; tick < 900; ++tick) {
    run.Step();
    beyond = std::max(beyond, BeyondLimits(run));
  }
  EXPECT_LT(beyond, 0.1) << "rad, in a fall of 3 m";
  for (int body = 0; body < run.world.body_count(); ++body) {
    EXPECT_FALSE(run.world.awake(body)) << body;
    EXPECT_LT(run.world.Read(body).position.y(), 0.5);
  }
}

TEST(Character, MistakesNameTheLine) {
  EXPECT_EQ(Complaint("name = \"a\"\nposition = [0, 0]\n"), "");
  const std::pair<const char*, const char*> mistakes[] = {
      {"name = \"a\"\n", "position"},
      {"name = \"ground\"\nposition = [0, 0]\n", "there is a part or character of this name"},
      {"name = \"a\"\nposition = [0, 0]\nkind = \"lazy\"\n", "'active' or 'passive'"},
      {"name = \"a\"\nposition = [0, 0]\nfacing = \"up\"\n", "'right' or 'left'"},
      {"name = \"a\"\nposition = [0, 0]\nheight = 0.5\n", "from 1 to 5"},
      {"name = \"a\"\nposition = [0, 0]\nplayer = \"eve\"\n", "there is no player 'eve'"},
      {"name = \"a\"\nposition = [0, 0]\nkind = \"passive\"\nplayer = \"ann\"\n", "no player"},
      {"name = \"a\"\nposition = [0, 0]\ntorque = {toe = 1}\n", "unknown key 'toe'"},
      {"name = \"a\"\nposition = [0, 0]\nvelocity = [119, 119]\n", "speed_limit"},
      {"name = \"a\"\nposition = [5000, 0]\n", "outside the bounds"},
  };
  for (const auto& [text, says] : mistakes) {
    const std::string complaint = Complaint(text);
    EXPECT_EQ(complaint.rfind("s.toml:", 0), 0u) << complaint;
    EXPECT_NE(complaint.find(says), std::string::npos) << complaint;
  }
  // A joint with copies that hangs on a character: it is no copy, so it stays.
  EXPECT_EQ(Complaint("name = \"a\"\nposition = [0, 3]\n[[part]]\nname = \"ball\"\ncircle = 0.2\n"
                      "position = [1, 6]\nrepeat = {count = 2, step = [1, 0]}\n"
                      "[[joint]]\nname = \"rope\"\nkind = \"distance\"\na = \"a.head\"\n"
                      "b = \"ball.0\"\nrepeat = {count = 2, step = [1, 0]}\n"),
            "");
}

}  // namespace character_body_test
}  // namespace seam
