/// Authority by contact islands around the players, as a pure function: ann's car at -30, bob's at
/// 30, and crates between them.

#include "server/authority/plan_islands.h"

#include <gtest/gtest.h>

#include "server/authority/plan.h"

namespace seam {
namespace plan_islands_test {

constexpr int kServer = 0, kAnn = 1, kBob = 2;
constexpr std::int64_t kLong = 1000000;

/// Mechanisms 0 and 1 are ann's and bob's cars; crates follow from 2 on.
class PlanIslandsTest : public ::testing::Test {
 protected:
  PlanIslandsTest() {
    view_.islands = true;
    view_.buffer_m = 4;
    for (const int peer : {kAnn, kBob}) {
      PlayerView player;
      player.peer = peer;
      player.one_way_s = 0.05f;
      view_.players.push_back(player);
    }
    view_.mechanisms[Add(-30, 0)].driver = 0;
    view_.mechanisms[Add(30, 0)].driver = 1;
    view_.mechanisms[0].now.authority = kAnn;
    view_.mechanisms[1].now.authority = kBob;
  }

  /// A box of 1 m, awake, the server's for long.
  std::size_t Add(float x, float y = 0) {
    MechanismView mechanism;
    mechanism.position = {x, y};
    mechanism.held_ticks = kLong;
    MovingBox box;
    box.group = static_cast<int>(view_.mechanisms.size());
    view_.mechanisms.push_back(mechanism);
    view_.boxes.push_back(box);
    Move(view_.mechanisms.size() - 1, x, y);
    return view_.mechanisms.size() - 1;
  }
  void Move(std::size_t m, float x, float y = 0) {
    view_.boxes[m].min = Vec2(x, y) - Vec2(0.5f, 0.5f);
    view_.boxes[m].max = Vec2(x, y) + Vec2(0.5f, 0.5f);
  }
  void Give(std::size_t m, int peer, std::int64_t held_ticks = kLong) {
    view_.mechanisms[m].now.authority = peer;
    view_.mechanisms[m].held_ticks = held_ticks;
  }
  void Sleep(std::size_t m) {
    view_.mechanisms[m].asleep = true;
    view_.mechanisms[m].moves = false;
  }
  int Of(std::size_t m) const { return PlanAuthority(view_)[m].authority; }

  AuthorityView view_;
};

TEST_F(PlanIslandsTest, AnAwakeBodyGoesToTheNearestPlayerWithinAcquire) {
  const std::size_t near_ann = Add(-30 + 20), near_bob = Add(30 - 20), between = Add(0);
  EXPECT_EQ(Of(near_ann), kAnn);
  EXPECT_EQ(Of(near_bob), kBob);
  EXPECT_EQ(Of(between), kServer) << "29 m from both";
  view_.rules.acquire = 30;
  EXPECT_NE(Of(between), kServer);
}

TEST_F(PlanIslandsTest, ASleeperGoesToThePlayerWithABodyAboutToHitIt) {
  const std::size_t thrown = Add(-15), asleep = Add(-12);
  Give(thrown, kAnn);
  Sleep(asleep);
  EXPECT_EQ(Of(asleep), kServer);
  view_.mechanisms[thrown].moves = true;
  view_.boxes[thrown].velocity = {8, 0};  // 2 m between them: a quarter of a second
  EXPECT_EQ(Of(asleep), kAnn);
  view_.boxes[thrown].velocity = {2.5f, 0};
  EXPECT_EQ(Of(asleep), kServer) << "not yet";
  view_.boxes[thrown].velocity = {-8, 0};
  EXPECT_EQ(Of(asleep), kServer) << "it flies away";
  view_.boxes[thrown].velocity = {8, 0};
  Give(thrown, kServer);
  EXPECT_EQ(Of(asleep), kServer) << "nobody's thing";
}

TEST_F(PlanIslandsTest, TheHolderKeepsItUntilItIsFartherThanKeep) {
  const std::size_t crate = Add(0);
  Give(crate, kAnn);
  EXPECT_EQ(Of(crate), kAnn) << "29 m";
  Move(crate, 10);  // 19 m from bob
  view_.rules.keep = 40;
  EXPECT_EQ(Of(crate), kAnn) << "although bob is nearer now";
  view_.rules.keep = 36;
  EXPECT_EQ(Of(crate), kBob) << "39 m from ann";
}

TEST_F(PlanIslandsTest, AnAuthorityLastsForTheDwell) {
  const std::size_t crate = Add(10);
  const auto dwell = static_cast<std::int64_t>(view_.rules.dwell_s * view_.tick_hz);
  Give(crate, kAnn, dwell - 1);
  EXPECT_EQ(Of(crate), kAnn);
  Give(crate, kAnn, dwell);
  EXPECT_EQ(Of(crate), kBob);
}

TEST_F(PlanIslandsTest, ASleeperIsTheServers) {
  const std::size_t crate = Add(-25), other = Add(-24);
  Give(crate, kAnn);
  Give(other, kAnn);
  Sleep(crate);
  EXPECT_EQ(Of(crate), kAnn) << "its neighbour, which it touches, is awake";
  Sleep(other);
  EXPECT_EQ(Of(crate), kServer);
  EXPECT_EQ(Of(other), kServer);
}

TEST_F(PlanIslandsTest, ADriverGetsABodyBeforeItsVehicleTouchesIt) {
  const std::size_t crate = Add(-20);
  Sleep(crate);
  const float gap = 9 - kTouchGap;
  const float seconds = 2 * 0.05f + kPlanPeriod + kTouchAhead;
  view_.boxes[0].velocity = {gap / seconds - 1, 0};
  EXPECT_EQ(Of(crate), kServer);
  view_.boxes[0].velocity = {gap / seconds + 1, 0};
  EXPECT_EQ(Of(crate), kAnn);
  view_.boxes[0].velocity = {-gap / seconds - 1, 0};
  EXPECT_EQ(Of(crate), kServer) << "she drives away from it";
  view_.players[0].one_way_s = 0.1f;
  view_.boxes[0].velocity = {gap / (seconds + 0.1f) + 1, 0};
  EXPECT_EQ(Of(crate), kAnn) << "a longer way is looked ahead farther";
}

TEST_F(PlanIslandsTest, TouchingOneBodyGivesTheWholeIsland) {
  const std::size_t first = Add(-28.98f), second = Add(-27.96f), apart = Add(-20);
  for (const std::size_t m : {first, second, apart}) Sleep(m);
  EXPECT_EQ(Of(first), kAnn);
  EXPECT_EQ(Of(second), kAnn);
  EXPECT_EQ(Of(apart), kServer);
}

TEST_F(PlanIslandsTest, ASleeperBesideAParkedVehicleDoesNotAlternateWithTheRoundTrip) {
  view_.boxes[0].acceleration = kDrivenAcceleration;
  const std::size_t crate = Add(-28.4f);  // .6 m from her car
  Sleep(crate);
  ASSERT_EQ(Of(crate), kServer);
  view_.players[0].one_way_s = 0.08f;
  ASSERT_EQ(Of(crate), kAnn) << "she could touch it before a grant could tell";
  Give(crate, kAnn);
  view_.players[0].one_way_s = 0.05f;
  EXPECT_EQ(Of(crate), kAnn) << "she has it, and is near";
  Move(crate, -26);
  EXPECT_EQ(Of(crate), kServer) << "3 m";
  Move(crate, -28.4f);
  Give(crate, kBob);
  EXPECT_EQ(Of(crate), kServer) << "his vehicle is far away";
}

TEST_F(PlanIslandsTest, AnotherPlayersVehicleTakesABodyItTouches) {
  const std::size_t crate = Add(5);
  Give(crate, kAnn);
  Move(0, -20);
  ASSERT_EQ(Of(crate), kAnn) << "within keep";
  Move(1, 5.9f);
  EXPECT_EQ(Of(crate), kBob);
}

TEST_F(PlanIslandsTest, TheHolderKeepsABodyThatTwoWillTouch) {
  const std::size_t crate = Add(0);
  Move(0, -4);
  Move(1, 3);
  view_.boxes[0].velocity = {30, 0};
  view_.boxes[1].velocity = {-30, 0};
  EXPECT_EQ(Of(crate), kBob) << "he is there first";
  Give(crate, kAnn);
  EXPECT_EQ(Of(crate), kAnn);
}

TEST_F(PlanIslandsTest, BetweenTwoVehiclesEachIsItsDriversAndTheRestStaysUntilItSettles) {
  Move(0, -1.02f);
  Move(1, 2.04f);
  const std::size_t left = Add(0), right = Add(1.02f);
  Give(left, kAnn);
  Give(right, kBob);
  view_.boxes[left].velocity = {2, 0};
  EXPECT_EQ(Of(0), kAnn);
  EXPECT_EQ(Of(1), kBob);
  EXPECT_EQ(Of(left), kAnn);
  EXPECT_EQ(Of(right), kBob);
  view_.boxes[left].velocity = {kSettles / 2, 0};
  EXPECT_EQ(Of(left), Of(right)) << "it settles: one decides";
  EXPECT_EQ(Of(0), kAnn);
  EXPECT_EQ(Of(1), kBob) << "a vehicle stays its driver's";
}

TEST_F(PlanIslandsTest, ADensePileBetweenTwoGoesToThePlayerWithMostOfIt) {
  Move(0, -1.02f);
  Move(1, 3.06f);
  std::vector<std::size_t> pile;
  for (const float y : {0.0f, 1.02f}) {
    for (const float x : {0.0f, 1.02f, 2.04f}) pile.push_back(Add(x, y));
  }
  for (std::size_t i = 0; i < pile.size(); ++i) {
    Give(pile[i], i < 2 ? kAnn : kBob);
    view_.boxes[pile[i]].velocity = {0, 3};
  }
  for (const std::size_t m : pile) EXPECT_EQ(Of(m), kBob);
  EXPECT_EQ(Of(0), kAnn);
}

TEST_F(PlanIslandsTest, AVehicleWithoutADriverIsAnOrdinaryBody) {
  view_.players[0].peer = -1;
  EXPECT_EQ(Of(0), kServer);
  Move(0, 20);
  EXPECT_EQ(Of(0), kBob);
}

TEST_F(PlanIslandsTest, ASilentPlayerGetsNothingNew) {
  const std::size_t crate = Add(-20);
  view_.players[0].silent = true;
  EXPECT_EQ(Of(crate), kServer);
  EXPECT_EQ(Of(0), kAnn) << "what is its own it has until its lease ends";
}

TEST_F(PlanIslandsTest, ASleeperStaysWithASilentPlayerUntilAnotherWillTouchIt) {
  const std::size_t crate = Add(-28.98f);
  Sleep(crate);
  Give(crate, kAnn);
  ASSERT_EQ(Of(crate), kAnn) << "her car touches it";
  Move(crate, -28.4f);
  ASSERT_EQ(Of(crate), kServer) << "her car cannot";
  view_.players[0].silent = true;
  EXPECT_EQ(Of(crate), kAnn);
  Move(1, -27.4f);
  EXPECT_EQ(Of(crate), kBob);
}

TEST_F(PlanIslandsTest, AForbiddenBodyIsTheServers) {
  const std::size_t crate = Add(-20);
  PlayerMask only_bob;
  only_bob.Add(1);
  view_.mechanisms[crate].may_have = only_bob;
  EXPECT_EQ(Of(crate), kServer);
}

TEST_F(PlanIslandsTest, TheFarthestIslandsGoBackWhenAClientHasMoreThanItCanStep) {
  std::vector<std::size_t> crates;
  for (int n = 0; n < 9; ++n) crates.push_back(Add(-28 + 2 * static_cast<float>(n)));
  for (const std::size_t m : crates) Give(m, kAnn);
  view_.players[0].capacity = 6;  // her car, and five
  for (std::size_t n = 0; n < crates.size(); ++n) {
    EXPECT_EQ(Of(crates[n]), n < 5 ? kAnn : kServer) << n;
  }
  EXPECT_EQ(Of(0), kAnn);
}

TEST_F(PlanIslandsTest, NewIslandsAreOnlyGivenBelowTheCapacity) {
  std::vector<std::size_t> crates;
  for (int n = 0; n < 9; ++n) crates.push_back(Add(-28 + 2 * static_cast<float>(n)));
  view_.players[0].capacity = 5;  // of which four are given: her car, and three
  for (std::size_t n = 0; n < crates.size(); ++n) {
    EXPECT_EQ(Of(crates[n]), n < 3 ? kAnn : kServer) << n;
  }
}

TEST_F(PlanIslandsTest, AClientFollowsNoMoreThanItsCapacity) {
  for (int n = 0; n < 9; ++n) Add(-28 + 2 * static_cast<float>(n));
  view_.players[0].capacity = 5;
  int steps = 0;
  for (const PlannedAuthority& planned : PlanAuthority(view_)) {
    steps += planned.authority == kAnn || planned.secondaries.Has(kAnn) ? 1 : 0;
  }
  EXPECT_EQ(steps, 5);
}

TEST_F(PlanIslandsTest, AClientAtItsCapacityFollowsEverythingItMayMeet) {
  view_.players[0].capacity = 3;
  std::vector<std::size_t> coming;
  for (int n = 0; n < 6; ++n) {
    coming.push_back(Add(-28, static_cast<float>(n) - 2.5f));
    view_.boxes[coming.back()].velocity = {-20, 0};
  }
  const AuthorityPlan plan = PlanAuthority(view_);
  int held = 0;
  for (const std::size_t m : coming) {
    held += plan[m].authority == kAnn ? 1 : 0;
    EXPECT_TRUE(plan[m].authority == kAnn || plan[m].secondaries.Has(kAnn)) << m;
  }
  EXPECT_LE(held, 2);
}

}  // namespace plan_islands_test
}  // namespace seam
