/// Which impacts are plausible, given the known states of all bodies.

#include "server/rules/impact_check.h"

#include <gtest/gtest.h>

namespace seam {
namespace impact_check_test {

/// Bodies 0, 1 and 2 of 1 m in a row at x = 0, 1 and 2, the last of 4 kg, others of 1 kg; a wall
/// left of the first. They stand, until Move says otherwise.
class ImpactCheckTest : public ::testing::Test {
 protected:
  explicit ImpactCheckTest(float apart = 1)
      : world_(ParseScene(R"(
gravity = [0, 0]
[[part]]
name = "wall"
box = [1, 4]
position = [-10, 0]
anchored = true
[[part]]
name = "a"
box = [1, 1]
restitution = 0
[[part]]
name = "b"
box = [1, 1]
restitution = 0
position = [)" + std::to_string(apart) +
                              R"(, 0]
[[part]]
name = "c"
box = [1, 1]
density = 4
restitution = 0
position = [)" + std::to_string(2 * apart) +
                              R"(, 0]
)",
                          "test.toml")) {}
  /// Tells states of every second tick from 0 to 20, in which the body moves until tick 10 and has
  /// its place in the row then; `told`: the velocity that it says, if another.
  void Move(int body, const Vec2& velocity, const Vec2& after = {0, 0}, const Vec2* told = nullptr,
            std::int64_t last = 20) {
    for (std::int64_t tick = 0; tick <= last; tick += 2) {
      BodyState state = world_.Read(body);
      const Vec2 now = tick <= 10 ? velocity : after;
      state.position += static_cast<float>(tick - 10) * world_.dt() * now;
      state.velocity = told != nullptr ? *told : now;
      trail_.Add(body, tick, state);
    }
  }
  bool Can(int body, int by, float dv, const Vec2& point, std::int64_t tick = 11) const {
    return ImpactCheck(world_, trail_, tick).Possible({body, by, dv, point});
  }

  World world_;
  BodyTable bodies_{3, 0};
  StateTrail trail_{bodies_};
};

/// The bodies are 3 m apart, so that only the two of the impact touch.
class ApartTest : public ImpactCheckTest {
 protected:
  ApartTest() : ImpactCheckTest(3) {}
};

TEST_F(ImpactCheckTest, AnImpactComesThroughANeighbour) {
  Move(0, {0, 0});
  Move(1, {0, 0});
  Move(2, {-10, 0});
  EXPECT_TRUE(Can(0, 1, 9, {0.5f, 0})) << "the heavy one struck the row within the tick";
  EXPECT_TRUE(Can(1, 2, 9, {1.5f, 0}));
  EXPECT_TRUE(Can(1, 2, 35, {1.5f, 0})) << "held from behind, it takes all of the momentum";
  EXPECT_FALSE(Can(1, 2, 60, {1.5f, 0})) << "which is 40 N s";
}

TEST_F(ImpactCheckTest, NobodyIsStruckInARowThatStands) {
  for (int body = 0; body < 3; ++body) Move(body, {0, 0});
  EXPECT_FALSE(Can(0, 1, 3, {0.5f, 0}));
  EXPECT_TRUE(Can(0, 1, 0.9f, {0.5f, 0}));
}

TEST_F(ImpactCheckTest, AToldVelocityCountsOnlyIfThePlacesConfirmIt) {
  const Vec2 lie(-110, 0);
  Move(0, {0, 0});
  Move(1, {0, 0}, {0, 0}, &lie);
  Move(2, {0, 0}, {0, 0}, &lie);
  EXPECT_FALSE(Can(0, 1, 100, {0.5f, 0}));
  EXPECT_FALSE(Can(1, 2, 150, {1.5f, 0}));
  EXPECT_FALSE(Can(1, 2, 3, {1.5f, 0}));
}

TEST_F(ApartTest, AFreeBodyGainsNoMoreThanTheSpeedOfTheImpact) {
  Move(0, {0, 0});
  for (std::int64_t tick = 0; tick <= 20; tick += 2) {
    BodyState state = world_.Read(2);
    state.position = {1.0f + static_cast<float>(tick < 10 ? 10 - tick : 0) / 6, 0};
    state.velocity = {tick < 10 ? -10.0f : 0.0f, 0};
    trail_.Add(2, tick, state);
  }
  EXPECT_TRUE(Can(0, 2, 10, {0.5f, 0}));
  EXPECT_FALSE(Can(0, 2, 30, {0.5f, 0})) << "four times as heavy, but nothing is behind";
}

TEST_F(ApartTest, AMotionAfterTheImpactExplainsIt) {
  Move(0, {0, 0}, {-5, 0});
  for (std::int64_t tick = 0; tick <= 20; tick += 2) {
    BodyState state = world_.Read(1);
    state.position = {1, 0};
    trail_.Add(1, tick, state);
  }
  EXPECT_TRUE(Can(0, 1, 5, {0.5f, 0})) << "somebody's blast threw the other into it";
  EXPECT_FALSE(Can(0, 1, 12, {0.5f, 0}));
}

TEST_F(ApartTest, ThePointLiesOnBothBodies) {
  Move(0, {0, 0});
  Move(1, {-3, 0});
  EXPECT_FALSE(Can(0, 1, 3, {0.5f, 0})) << "the other is 3 m away";
  EXPECT_FALSE(Can(0, -1, 0.5f, {0.5f, 5}));
  EXPECT_TRUE(Can(0, -1, 0.5f, {0.5f, 0}));
}

TEST_F(ApartTest, StatesThatAreStillToComeMayExplainAnImpact) {
  EXPECT_FALSE(Can(0, 1, 3, {0.5f, 0}, 5)) << "nothing is known";
  Move(0, {0, 0}, {0, 0}, nullptr, 12);
  Move(1, {0, 0});
  ImpactCheck early(world_, trail_, 11);
  EXPECT_TRUE(early.MoreMayCome({0, 1, 3, {0.5f, 0}}));
  Move(0, {0, 0});
  EXPECT_FALSE(early.MoreMayCome({0, 1, 3, {0.5f, 0}}));
}

TEST_F(ApartTest, AStandingBodyDoesNotStrikeTheGround) {
  Move(0, {0, 0});
  EXPECT_FALSE(Can(0, -1, 3, {0.5f, 0}));
  Move(1, {0, -4});
  EXPECT_TRUE(Can(1, -1, 6, {3, -0.5f}));
  EXPECT_FALSE(Can(1, -1, 12, {3, -0.5f}));
}

/// A hammer turns about a post beside two boxes, 10 m/s at its tip.
TEST(ImpactCheckBesideAPath, AMoverExplainsWhatItPushesAndNothingFarAway) {
  World world(ParseScene(R"(
gravity = [0, 0]
[[part]]
name = "hammer"
box = [4, 0.4]
anchored = true
[[joint]]
name = "turn"
kind = "kinematic"
b = "hammer"
turning = 5
[[part]]
name = "near"
box = [1, 1]
position = [2.6, 0]
[[part]]
name = "beside"
box = [1, 1]
position = [3.6, 0]
[[part]]
name = "wall"
box = [1, 4]
position = [60, 0]
anchored = true
[[part]]
name = "far"
box = [1, 1]
position = [59, 0]
)",
                         "test.toml"));
  const BodyTable bodies(3, 0);
  StateTrail trail(bodies);
  for (std::int64_t tick = 0; tick <= 20; tick += 2) {
    for (int body = 0; body < 3; ++body) trail.Add(body, tick, world.Read(body));
  }
  ImpactCheck check(world, trail, 10);
  EXPECT_TRUE(check.Possible({1, 0, 18, {3.1f, 0}})) << "the hammer drives one into the other";
  EXPECT_TRUE(check.Possible({0, -1, 18, {2.1f, 0}})) << "and strikes itself";
  EXPECT_FALSE(check.Possible({0, -1, 90, {2.1f, 0}})) << "but not as fast as anyone likes";
  EXPECT_FALSE(check.Possible({2, -1, 9, {59.5f, 0}})) << "nothing moves there";
}

}  // namespace impact_check_test
}  // namespace seam
