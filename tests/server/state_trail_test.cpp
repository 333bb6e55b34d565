/// The states that the rules check: each once, in the order of ticks, no body going back.

#include "server/rules/state_trail.h"

#include <gtest/gtest.h>

#include "common/scene/part_rules.h"
#include "server/rules/triggers.h"

namespace seam {
namespace state_trail_test {

BodyState At(float x) {
  BodyState state;
  state.position = {x, 0};
  return state;
}

TEST(StateTrail, ReportsEachTickOnceAndInOrder) {
  BodyTable bodies(2, 0);
  StateTrail trail(bodies);
  trail.Add(1, 12, At(2));
  trail.Add(0, 10, At(0));
  trail.Add(0, 12, At(1));
  trail.Add(0, 14, At(2));
  EXPECT_EQ(trail.NewTicks(), (std::vector<std::int64_t>{10, 11, 12, 13, 14}));
  trail.MarkProcessed();
  EXPECT_TRUE(trail.NewTicks().empty());
  trail.Add(1, 13, At(3));
  EXPECT_EQ(trail.NewTicks(), (std::vector<std::int64_t>{13}));
}

TEST(StateTrail, ALateStateDoesNotReprocessBodiesAlreadyChecked) {
  BodyTable bodies(2, 0);
  StateTrail trail(bodies);
  trail.Add(0, 20, At(5));
  trail.Add(0, 21, At(6));
  trail.MarkProcessed();
  trail.Add(1, 11, At(1));
  trail.Add(1, 12, At(2));
  ASSERT_TRUE(trail.At(0, 11).has_value());
  EXPECT_EQ(trail.At(0, 11)->position.x(), 6);
  EXPECT_EQ(trail.TickOf(0, 11), 21);
  EXPECT_EQ(trail.At(1, 11)->position.x(), 1);
  EXPECT_EQ(trail.TickOf(1, 11), 11);
  EXPECT_FALSE(trail.At(1, 10).has_value()) << "nothing is known yet";
  EXPECT_EQ(trail.TickOf(1, 10), -1);
}

TEST(StateTrail, ARemapKeepsUnchangedBodiesProcessed) {
  BodyTable bodies(2, 0);
  StateTrail trail(bodies);
  trail.Add(0, 10, At(0));
  trail.Add(1, 10, At(0));
  trail.MarkProcessed();
  BodyOrigin stays;
  stays.body = 1;
  stays.same = true;
  BodyRemap change;
  change.bodies = {BodyOrigin(), stays};
  bodies.Renumber(change);
  EXPECT_TRUE(trail.NewTicks().empty());
  trail.Add(0, 9, At(1));
  EXPECT_EQ(trail.NewTicks(), (std::vector<std::int64_t>{9}));
}

TEST(StateTrail, ThePathBetweenTwoStatesIsCheckedTickByTick) {
  BodyTable bodies(1, 0);
  StateTrail trail(bodies);
  trail.Add(0, 10, At(1));
  trail.MarkProcessed();
  trail.Add(0, 14, At(3));
  EXPECT_EQ(trail.NewTicks(), (std::vector<std::int64_t>{11, 12, 13, 14}));
  EXPECT_FLOAT_EQ(trail.At(0, 11)->position.x(), 1.5f);
  EXPECT_FLOAT_EQ(trail.At(0, 13)->position.x(), 2.5f);
  EXPECT_EQ(trail.At(0, 99)->position.x(), 3);
  EXPECT_EQ(trail.TickOf(0, 13), 13);
  EXPECT_EQ(trail.TickOf(0, 99), 14);
}

TEST(StateTrail, AJumpOrALongSilenceHasNoPath) {
  BodyTable bodies(1, 0);
  StateTrail trail(bodies);
  trail.Add(0, 10, At(0));
  trail.MarkProcessed();
  trail.Add(0, 12, At(50));
  EXPECT_EQ(trail.NewTicks(), (std::vector<std::int64_t>{12}));
  trail.MarkProcessed();
  trail.Add(0, 13 + StateTrail::kMaxGapTicks, At(51));
  EXPECT_EQ(trail.NewTicks(), (std::vector<std::int64_t>{13 + StateTrail::kMaxGapTicks}));
}

/// Between two states a body runs against a wall and back. Somebody's world knows it, 0.1 m off.
TEST(StateTrail, AKnownWayBetweenTwoStatesIsFollowed) {
  BodyTable bodies(2, 0);
  StateTrail trail(bodies);
  BodyState world[11];
  for (int t = 0; t <= 10; ++t) {
    const auto way = static_cast<float>(t < 6 ? t : 12 - t);
    world[t] = At(way + 0.1f);
  }
  const auto knows = [&](std::int64_t tick) -> const BodyState* {
    return tick >= 20 && tick <= 30 ? &world[tick - 20] : nullptr;
  };
  trail.Add(0, 20, At(0));
  trail.MarkProcessed();
  trail.Add(0, 30, At(2), knows);
  EXPECT_EQ(trail.NewTicks().size(), 10u);
  EXPECT_FLOAT_EQ(trail.At(0, 25)->position.x(), 5);
  EXPECT_FLOAT_EQ(trail.At(0, 26)->position.x(), 6);
  EXPECT_FLOAT_EQ(trail.At(0, 30)->position.x(), 2);
  trail.MarkProcessed();
  EXPECT_FLOAT_EQ(trail.At(0, 26)->position.x(), 2) << "processed: no body goes back";
}

/// What is off by more than its way bends knows nothing of the body's way.
TEST(StateTrail, AWayThatEndsElsewhereIsNotFollowed) {
  BodyTable bodies(2, 0);
  StateTrail trail(bodies);
  BodyState world[11];
  for (int t = 0; t <= 10; ++t) world[t] = At(static_cast<float>(t < 6 ? t : 12 - t));
  const auto knows = [&](std::int64_t tick) { return &world[tick - 20]; };
  trail.Add(0, 20, At(0));
  trail.Add(0, 30, At(10), knows);
  EXPECT_FLOAT_EQ(trail.At(0, 27)->position.x(), 7);
  const auto unknown = [](std::int64_t) -> const BodyState* { return nullptr; };
  trail.Add(0, 32, At(12), unknown);
  EXPECT_FLOAT_EQ(trail.At(0, 31)->position.x(), 11);
}

/// Six states come at once; a coin lies between the first and the last.
TEST(StateTrail, ABurstOfStatesDoesNotCarryABodyPastATrigger) {
  Trigger coin;
  coin.size = {0.3f, 1};
  coin.parts = {0};
  Triggers triggers({coin});
  BodyTable bodies(1, 0);
  StateTrail trail(bodies);
  for (int i = 0; i < 6; ++i) trail.Add(0, 30 + i, At(-0.5f + 0.2f * static_cast<float>(i)));
  int entered = 0, left = 0;
  for (const std::int64_t tick : trail.NewTicks()) {
    const auto place = [&](PartId) -> std::optional<Vec2> { return trail.At(0, tick)->position; };
    for (const TriggerEvent& event : triggers.Update(place, [](PartId) { return 0; })) {
      ++(event.entered ? entered : left);
    }
  }
  EXPECT_EQ(entered, 1);
  EXPECT_EQ(left, 1);
}

}  // namespace state_trail_test
}  // namespace seam
