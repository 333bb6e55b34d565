/// Which impacts are plausible, given the known states of the two bodies.

#include "server/rules/impact_check.h"

#include <gtest/gtest.h>

namespace seam {
namespace impact_check_test {

/// Body 0 at x = 0 and body 1, four times as heavy, at x = 1, both of 1 m; their known states are
/// of tick 10.
class ImpactCheckTest : public ::testing::Test {
 protected:
  ImpactCheckTest()
      : world_(ParseScene(R"(
gravity = [0, 0]
[[part]]
name = "a"
box = [1, 1]
restitution = 0
[[part]]
name = "b"
box = [1, 1]
density = 4
restitution = 0
position = [1, 0]
)",
                          "test.toml")) {
    Know(0, {0, 0});
    Know(1, {-3, 0});
  }
  void Know(int body, const Vec2& velocity) {
    BodyState state = world_.Read(body);
    state.velocity = velocity;
    trail_.Add(body, 10, state);
  }
  bool Can(float dv, const Vec2& point = {0.5f, 0}, std::int64_t tick = 11, int by = 1) const {
    return Possible(world_, trail_, {0, by, dv, point}, tick);
  }

  World world_;
  BodyTable bodies_{2, 0};
  StateTrail trail_{bodies_};
};

TEST_F(ImpactCheckTest, AnImpactIsBoundedByTheIncomingMomentum) {
  EXPECT_TRUE(Can(3));
  EXPECT_TRUE(Can(12)) << "held from behind, the lighter takes all of the heavier's momentum";
  EXPECT_FALSE(Can(13.5f));
}

TEST_F(ImpactCheckTest, ASlowBodyCannotStrikeHard) {
  Know(0, {0, 0});
  StateTrail slow(bodies_);
  BodyState state = world_.Read(0);
  slow.Add(0, 10, state);
  state = world_.Read(1);
  state.velocity = {-0.3f, 0};
  slow.Add(1, 10, state);
  EXPECT_FALSE(Possible(world_, slow, {0, 1, 3, {0.5f, 0}}, 11));
  EXPECT_TRUE(Possible(world_, slow, {0, 1, 2, {0.5f, 0}}, 11));
}

TEST_F(ImpactCheckTest, ThePointLiesOnBothBodies) {
  EXPECT_TRUE(Can(3, {0.5f, 0.3f}));
  EXPECT_FALSE(Can(3, {0.5f, 5}));
  EXPECT_FALSE(Can(3, {-3, 0}));
}

TEST_F(ImpactCheckTest, OnlyStatesUpToThatTickExplainAnImpact) {
  EXPECT_FALSE(Can(3, {0.5f, 0}, 5)) << "of tick 5 nothing is known";
  EXPECT_TRUE(Can(3, {0.5f, 0}, 60)) << "what rests is told seldom: the last before it counts";
}

TEST_F(ImpactCheckTest, AnOldStateExplainsAnImpactOnItsPath) {
  StateTrail old(bodies_);
  old.Add(0, 10, world_.Read(0));
  BodyState far = world_.Read(1);
  far.position = {6, 0};
  far.velocity = {-12, 0};
  old.Add(1, 10, far);
  EXPECT_TRUE(Possible(world_, old, {0, 1, 3, {0.5f, 0}}, 35)) << "5 m in 25 ticks";
  EXPECT_FALSE(Possible(world_, old, {0, 1, 3, {0.5f, 0}}, 12)) << "too soon";
  EXPECT_FALSE(Possible(world_, old, {0, 1, 3, {0.5f, 0}}, 90)) << "long past";
}

TEST_F(ImpactCheckTest, AStandingBodyDoesNotStrikeTheGround) {
  EXPECT_FALSE(Can(3, {0.5f, 0}, 11, -1));
  StateTrail falling(bodies_);
  BodyState state = world_.Read(0);
  state.velocity = {0, -4};
  falling.Add(0, 10, state);
  EXPECT_TRUE(Possible(world_, falling, {0, -1, 6, {0, -0.5f}}, 11));
  EXPECT_FALSE(Possible(world_, falling, {0, -1, 12, {0, -0.5f}}, 11));
}

}  // namespace impact_check_test
}  // namespace seam
