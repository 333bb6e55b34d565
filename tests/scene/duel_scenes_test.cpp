/// Scenes in which players push each other, or one body together: each matches its title with
/// scripts in a single world, and with bots where required.

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "common/sync/inputs/input_source.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace duel_scenes_test {

/// Records which two bodies have touched at the end of a tick; call Note after each step.
class Meetings {
 public:
  void Note(const World& world) {
    for (const Touch& t : world.touches()) met_.insert({t.body_a, t.body_b});
  }
  bool Met(int a, int b) const { return met_.count({std::min(a, b), std::max(a, b)}) != 0; }

 private:
  std::set<std::pair<int, int>> met_;
};

float Closing(const ScriptedWorld& run) {
  return run.Read("car-a").velocity.x() - run.Read("car-b").velocity.x();
}

TEST(Headon, TheScriptsMeetOnTheSeamAtSpeedAndAreEachOthersMirrorImage) {
  ScriptedWorld run("headon");
  const int a = run.Body("car-a"), b = run.Body("car-b");
  Meetings meetings;
  float before = 0;
  while (!meetings.Met(a, b) && run.world.tick() < 240) {
    before = Closing(run);
    run.Step();
    meetings.Note(run.world);
  }
  ASSERT_TRUE(meetings.Met(a, b));
  EXPECT_GT(before, 25);
  EXPECT_LT(Closing(run), 1);
  const Vec2 middle = (run.Read("car-a").position + run.Read("car-b").position) / 2;
  EXPECT_NEAR(middle.x(), 0, 0.01);
  while (run.world.tick() < 360) {
    run.Step();
    const BodyState left = run.Read("car-a"), right = run.Read("car-b");
    ASSERT_NEAR(left.position.x(), -right.position.x(), 0.02) << run.world.tick();
    ASSERT_NEAR(left.velocity.x(), -right.velocity.x(), 0.1) << run.world.tick();
  }
  EXPECT_LT(run.Read("car-a").position.x(), -4) << "they back off";
}

TEST(Headon, BotsMeetUnderEverySeed) {
  for (int seed = 1; seed <= 60; ++seed) {
    ScriptedWorld run("headon");
    const int a = run.Body("car-a"), b = run.Body("car-b");
    Meetings meetings;
    float before = 0;
    for (std::int64_t tick = 1; tick <= 360 && !meetings.Met(a, b); ++tick) {
      for (int player = 0; player < 2; ++player) {
        run.world.SetInput(player, BotInput(seed, player, tick, 60));
      }
      before = Closing(run);
      run.world.Step();
      meetings.Note(run.world);
    }
    EXPECT_TRUE(meetings.Met(a, b)) << "seed " << seed;
    EXPECT_GT(before, 4) << "seed " << seed;
  }
}

/// The field's four quarters, by player.
int QuarterOf(const Vec2& at) {
  if (at.y() >= 0) return at.x() >= 0 ? 0 : 1;
  return at.x() < 0 ? 2 : 3;
}

TEST(Scrum, AllFourPressTheBallAtOnceAndItVisitsEveryQuarter) {
  ScriptedWorld run("scrum");
  const int ball = run.Body("ball");
  const std::array<const char*, 4> rams = {"ram-a", "ram-b", "ram-c", "ram-d"};
  for (int player = 0; player < 4; ++player) {
    EXPECT_EQ(QuarterOf(run.Read(rams[static_cast<std::size_t>(player)]).position), player);
  }
  std::set<int> quarters;
  int together = 0;
  while (run.world.tick() < 600) {
    run.Step();
    Meetings now;
    now.Note(run.world);
    int pressing = 0;
    for (const char* ram : rams) pressing += now.Met(ball, run.Body(ram)) ? 1 : 0;
    together += pressing == 4 ? 1 : 0;
    quarters.insert(QuarterOf(run.Read("ball").position));
    ASSERT_LT(run.Read("ball").position.norm(), 3);
  }
  EXPECT_GE(together, 20) << "ticks with all four blades on it";
  EXPECT_EQ(quarters.size(), 4u);
}

TEST(Rally, TheBallCrossesTheSeamAndBothBatsReturnIt) {
  ScriptedWorld run("rally");
  const int ball = run.Body("ball");
  int crossings = 0;
  std::array<int, 2> returns = {0, 0};
  std::set<int> touching;
  while (run.world.tick() < 840) {
    const float before = run.Read("ball").position.x();
    run.Step();
    crossings += before * run.Read("ball").position.x() < 0 ? 1 : 0;
    Meetings now;
    now.Note(run.world);
    for (const int player : {0, 1}) {
      const bool hit = now.Met(ball, run.Body(player == 0 ? "bat-a" : "bat-b"));
      if (hit && touching.insert(player).second) ++returns[static_cast<std::size_t>(player)];
      if (!hit) touching.erase(player);
    }
    ASSERT_GT(std::abs(run.Read("ball").velocity.x()), 4) << "it goes on";
    ASSERT_NEAR(run.Read("ball").position.y(), 0.51, 0.02);
  }
  EXPECT_GE(crossings, 5);
  EXPECT_GE(returns[0], 2);
  EXPECT_GE(returns[1], 2);
}

TEST(Seesaw, EachHopTipsThePlankUnderTheOther) {
  ScriptedWorld run("seesaw");
  std::array<float, 2> highest = {0, 0};
  float least = 0, most = 0;
  while (run.world.tick() < 720) {
    run.Step();
    const std::array<Vec2, 2> carts = {run.Read("cart-a").position, run.Read("cart-b").position};
    ASSERT_LT(carts[0].x(), -0.5) << "each stays on its player's side";
    ASSERT_GT(carts[1].x(), 0.5);
    for (const std::size_t i : {0u, 1u}) highest[i] = std::max(highest[i], carts[i].y());
    least = std::min(least, run.Read("plank").angle);
    most = std::max(most, run.Read("plank").angle);
  }
  EXPECT_GT(highest[0], 3);
  EXPECT_GT(highest[1], 3);
  EXPECT_LT(least, -0.15);
  EXPECT_GT(most, 0.15);
}

TEST(Seesaw, OnePlayersHopMovesTheOther) {
  ScriptedWorld run("seesaw"), without("seesaw");
  const int bob = run.Body("cart-b");
  float largest = 0;
  while (run.world.tick() < 390) {  // until bob hops himself
    run.Step();
    for (const int player : {0, 1}) {
      without.world.SetInput(
          player, player == 0 ? Input() : ScriptedInput(run.world.scene(), 1, run.world.tick()));
    }
    without.world.Step();
    largest =
        std::max(largest, (run.world.Read(bob).position - without.world.Read(bob).position).norm());
  }
  EXPECT_GT(largest, 0.3);
}

}  // namespace duel_scenes_test
}  // namespace seam
