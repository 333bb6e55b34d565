/// A spare world against motions that are known: a mechanism gains what no force explains.

#include "common/sync/audit/spare_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/random.h"
#include "common/sync/audit/steady_gain.h"

namespace seam {
namespace spare_world_test {

/// Two balls in empty space, and two that touch. Mechanisms in the order of the parts.
const char* const kBalls = R"(
gravity = [0, 0]
[[part]]
name = "ball"
circle = 0.5
repeat = {count = 2, step = [50, 0]}
[[part]]
name = "pair"
circle = 0.5
position = [200, 0]
repeat = {count = 2, step = [0.99, 0]}
)";

BodyState Moving(float x, float speed) {
  BodyState state;
  state.position = Vec2(x, 0);
  state.velocity = Vec2(speed, 0);
  return state;
}

void StepBy(int ticks, SpareWorld* spare) {
  for (int i = 0; i < ticks; ++i) spare->Step([](World*) {});
}

TEST(SpareWorld, ComparesWithTheTimeSinceItWasPut) {
  SpareWorld spare(Topology(ParseScene(kBalls, "balls")), SpareWorld::Present::kNone);
  EXPECT_TRUE(spare.world().present().empty());
  spare.SetTick(100);
  spare.Put(0, 1, {Moving(0, 3)});
  StepBy(12, &spare);
  // It flew .6 m; told is .61 m, and .05 m/s more.
  const std::optional<Gain> gain = spare.Compare(0, {Moving(0.61f, 3.05f)});
  ASSERT_TRUE(gain);
  EXPECT_NEAR(gain->seconds, 0.2, 1e-6);
  EXPECT_NEAR(gain->position.x(), 0.01, 1e-5);
  EXPECT_NEAR(gain->velocity.x(), 0.05, 1e-5);
  EXPECT_NEAR(gain->stepped.x(), 3, 1e-5);
  EXPECT_NEAR(gain->apart, 0, 1e-5);
  spare.Take(0);
  StepBy(1, &spare);
  EXPECT_TRUE(spare.world().present().empty());
  EXPECT_FALSE(spare.Compare(0, {Moving(0.61f, 3.05f)}));
}

TEST(SpareWorld, DoesNotCompareWhatTouchesAnotherHolders) {
  for (const int other : {1, 2}) {
    SpareWorld spare(Topology(ParseScene(kBalls, "balls")), SpareWorld::Present::kNone);
    spare.Put(2, 1, {Moving(200, 0)});
    spare.Put(3, other, {Moving(200.99f, 0)});
    StepBy(1, &spare);
    EXPECT_EQ(spare.Compare(2, {Moving(200, 0)}).has_value(), other == 1);
  }
}

Gain Pushed(double along, double noise, Random* random) {
  Gain gain;
  gain.seconds = 0.2;
  gain.stepped = Vec2(5, 0);
  const double push = along + random->Uniform(-noise, noise);
  gain.velocity = Vec2(static_cast<float>(push * gain.seconds), 0);
  return gain;
}

TEST(SteadyGain, ChaosWithoutADirectionIsNoLie) {
  Random random(1);
  for (const double noise : {0.1, 1.0, 10.0}) {
    SteadyGain sums;
    for (int i = 0; i < 20000; ++i) {
      sums.Add(Pushed(0, noise, &random));
      ASSERT_FALSE(sums.lies()) << noise << " m/s2, comparison " << i;
    }
  }
}

TEST(SteadyGain, AGainThatIsTwiceAnHonestOneIsFound) {
  Random random(1);
  int comparisons = 0;
  for (SteadyGain sums; !sums.lies() && comparisons < 1000; ++comparisons) {
    sums.Add(Pushed(2 * SteadyGain::kPush, 0.02, &random));
  }
  // Each adds about 1 to a sum that counts from kLie on.
  EXPECT_NEAR(comparisons, SteadyGain::kLie, 10);
  SteadyGain honest;
  for (int i = 0; i < 20000; ++i) honest.Add(Pushed(0.9 * SteadyGain::kPush, 0.02, &random));
  EXPECT_FALSE(honest.lies());
}

/// `along`: m in each second, beside chance; one in 20 is a great one.
Gain Slipped(double along, Random* random) {
  Gain gain;
  gain.seconds = 0.2;
  gain.summed = true;
  gain.stepped = Vec2(1, 0);
  const bool great = random->Uniform(0, 20) < 1;
  const double slip = along + (great ? random->Uniform(-1, 1) : random->Uniform(-0.01, 0.01));
  gain.position = Vec2(static_cast<float>(slip * gain.seconds), 0);
  return gain;
}

TEST(SteadyGain, ASmallSlipThatGreatOnesHideIsFound) {
  Random random(1);
  SteadyGain liar, honest;
  int comparisons = 0;
  for (; !liar.lies() && comparisons < 1000; ++comparisons) liar.Add(Slipped(0.05, &random));
  EXPECT_LT(comparisons, 40);
  for (int i = 0; i < 20000; ++i) {
    honest.Add(Slipped(0, &random));
    ASSERT_FALSE(honest.lies()) << "comparison " << i;
  }
}

}  // namespace spare_world_test
}  // namespace seam
