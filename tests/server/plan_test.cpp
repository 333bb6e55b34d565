/// Planning as a pure function: ann's region is left of x = 0, bob's right of it.

#include "server/authority/plan.h"

#include <gtest/gtest.h>

namespace seam {
namespace plan_test {

constexpr int kAnn = 1, kBob = 2;
constexpr std::int64_t kLong = 1000000;

/// A box of half a metre around `at`, at rest.
MovingBox BoxAt(const Vec2& at, std::size_t mechanism) {
  MovingBox box;
  box.min = at - Vec2(0.25f, 0.25f);
  box.max = at + Vec2(0.25f, 0.25f);
  box.group = static_cast<int>(mechanism);
  return box;
}

/// Mechanisms of one box each at these x, at rest, all the server's for long.
AuthorityView TwoSides(const std::vector<float>& xs) {
  AuthorityView view;
  view.buffer_m = 4;
  view.players.push_back({kAnn, 0.05f, true, {-100, -100}, {-0.001f, 100}});
  view.players.push_back({kBob, 0.05f, true, {0, -100}, {100, 100}});
  for (const float x : xs) {
    MechanismView mechanism;
    mechanism.position = {x, 0};
    mechanism.held_ticks = kLong;
    view.boxes.push_back(BoxAt(mechanism.position, view.mechanisms.size()));
    view.mechanisms.push_back(mechanism);
  }
  return view;
}

void Move(AuthorityView* view, std::size_t mechanism, float x) {
  view->mechanisms[mechanism].position.x() = x;
  view->boxes[mechanism] = BoxAt({x, 0}, mechanism);
}

bool Follows(const AuthorityView& view, std::size_t mechanism, int peer) {
  return PlanAuthority(view)[mechanism].secondaries.Has(peer);
}

int HolderAt(float x, int now, std::int64_t held_ticks) {
  AuthorityView view = TwoSides({x});
  view.mechanisms[0].now.authority = now;
  view.mechanisms[0].held_ticks = held_ticks;
  return PlanAuthority(view)[0].authority;
}

TEST(PlanAuthority, ThePeerOfItsRegionGetsIt) {
  const AuthorityPlan plan = PlanAuthority(TwoSides({-50, 50, 500}));
  EXPECT_EQ(plan[0].authority, kAnn);
  EXPECT_EQ(plan[1].authority, kBob);
  EXPECT_EQ(plan[2].authority, 0) << "in nobody's region";
}

TEST(PlanAuthority, TheRegionOfAnAbsentPlayerIsTheServers) {
  AuthorityView view = TwoSides({-50});
  view.players[0].peer = -1;
  EXPECT_EQ(PlanAuthority(view)[0].authority, 0);
}

TEST(PlanAuthority, TheHolderKeepsItALittleBeyondTheBorder) {
  EXPECT_EQ(HolderAt(kHysteresis - 0.1f, kAnn, kLong), kAnn);
  EXPECT_EQ(HolderAt(kHysteresis + 0.1f, kAnn, kLong), kBob);
  EXPECT_EQ(HolderAt(kHysteresis - 0.1f, 0, kLong), kBob) << "the server has no hysteresis";
}

TEST(PlanAuthority, ANewHolderKeepsItForTheDwell) {
  const auto dwell = static_cast<std::int64_t>(PlannerRules{}.dwell_s * 60);
  EXPECT_EQ(HolderAt(50, kAnn, dwell - 1), kAnn);
  EXPECT_EQ(HolderAt(50, kAnn, dwell), kBob);
  EXPECT_EQ(HolderAt(50, 0, 0), kBob) << "from the server at once";
}

TEST(PlanAuthority, AnOwnedMechanismGoesToItsPresentOwnersPeer) {
  AuthorityView view = TwoSides({50});
  view.mechanisms[0].owner = 0;
  EXPECT_EQ(PlanAuthority(view)[0].authority, kAnn);
  view.players[0].peer = -1;
  EXPECT_EQ(PlanAuthority(view)[0].authority, kBob);
}

TEST(PlanAuthority, PeersNearARegionOrAMechanismFollow) {
  AuthorityView view = TwoSides({3, 5, 50, 53});
  view.mechanisms[2].owner = 0;  // ann's, deep in bob's region
  const AuthorityPlan plan = PlanAuthority(view);
  EXPECT_TRUE(plan[0].secondaries.Has(kAnn)) << "3 m from her region";
  EXPECT_FALSE(plan[1].secondaries.Has(kAnn)) << "5 m from her region";
  EXPECT_TRUE(plan[2].secondaries.Has(kBob));
  EXPECT_TRUE(plan[3].secondaries.Has(kAnn)) << "3 m from what is hers";
  EXPECT_FALSE(plan[3].secondaries.Has(kBob)) << "he has it";
}

TEST(PlanAuthority, AFollowerKeepsFollowingALittleFurther) {
  AuthorityView view = TwoSides({5});
  EXPECT_FALSE(Follows(view, 0, kAnn));
  view.mechanisms[0].now.secondaries.Add(kAnn);
  EXPECT_TRUE(Follows(view, 0, kAnn));
  Move(&view, 0, view.buffer_m + kHysteresis + 0.35f);
  EXPECT_FALSE(Follows(view, 0, kAnn));
}

TEST(PlanAuthority, TheBufferReachesToTheNearestBoxAndNotToTheRoot) {
  AuthorityView view = TwoSides({30});
  MovingBox nose = BoxAt({3, 0}, 0);  // a long train whose engine is 27 m behind its nose
  view.boxes.push_back(nose);
  EXPECT_TRUE(Follows(view, 0, kAnn));
  view.boxes.back() = BoxAt({6, 0}, 0);
  EXPECT_FALSE(Follows(view, 0, kAnn));
}

/// Ann's body at -30 and bob's at 30, approaching at `speed` m/s.
AuthorityView Approach(float speed, float one_way_s) {
  AuthorityView view = TwoSides({-30, 30});
  view.boxes[0].velocity = {speed / 2, 0};
  view.boxes[1].velocity = {-speed / 2, 0};
  for (PlayerView& player : view.players) player.one_way_s = one_way_s;
  return view;
}

TEST(PlanAuthority, AZoneIsAsWideAsTheApproachWithinTheLatency) {
  const float gap = 59.5f - kZoneSlack;
  const float meets = gap / ZoneSeconds(0.1f, 0.1f);
  EXPECT_TRUE(Follows(Approach(meets + 1, 0.1f), 0, kBob));
  EXPECT_TRUE(Follows(Approach(meets + 1, 0.1f), 1, kAnn));
  EXPECT_FALSE(Follows(Approach(meets - 1, 0.1f), 0, kBob));
  EXPECT_FALSE(Follows(Approach(meets + 1, 0.05f), 0, kBob)) << "heard of sooner";
  EXPECT_TRUE(Follows(Approach(meets - 1, 0.15f), 0, kBob)) << "heard of later";
}

TEST(PlanAuthority, BodiesOfEqualVelocityDoNotMeetAtAnySpeed) {
  AuthorityView view = Approach(0, 0.1f);
  for (MovingBox& box : view.boxes) box.velocity = {200, 0};
  EXPECT_FALSE(Follows(view, 0, kBob));
}

TEST(PlanAuthority, AFollowerOfAnApproachingBodyKeepsFollowingForAWhile) {
  const float gap = 59.5f - kZoneSlack;
  AuthorityView view = Approach(gap / (ZoneSeconds(0.1f, 0.1f) + kZoneKeep / 2), 0.1f);
  EXPECT_FALSE(Follows(view, 0, kBob));
  view.mechanisms[0].now.secondaries.Add(kBob);
  EXPECT_TRUE(Follows(view, 0, kBob));
}

/// 300 boxes in a row from 0 m on, so far from each other's middle, each 0.5 m wide, of so many
/// players: each has as much of the row. Those that do not touch go to and fro at 2 m/s.
AuthorityView Row(int players, float step) {
  AuthorityView view = TwoSides({});
  view.players.clear();
  const float length = 300 * step, each = length / static_cast<float>(players);
  for (int p = 0; p < players; ++p) {
    const float from = each * static_cast<float>(p);
    view.players.push_back({p + 1, 0.05f, true, {from, -100}, {from + each - 0.001f, 100}});
  }
  for (std::size_t i = 0; i < 300; ++i) {
    MechanismView mechanism;
    mechanism.position = {step * static_cast<float>(i), 0};
    mechanism.held_ticks = kLong;
    view.boxes.push_back(BoxAt(mechanism.position, i));
    if (step > 0.5f) view.boxes.back().velocity = {i % 2 == 0 ? 2.0f : -2.0f, 0};
    view.mechanisms.push_back(mechanism);
  }
  return view;
}

TEST(PlanAuthority, InACrowdOnlyNearbyBodiesAreMetThroughOthers) {
  EXPECT_TRUE(Follows(Row(6, 1), 299, 1)) << "of six players' things everything";
  AuthorityView crowd = Row(10, 1);  // the first has those before 30
  EXPECT_FALSE(Follows(crowd, 299, 1));
  EXPECT_TRUE(Follows(crowd, 29 + 23, 1)) << "22.5 m away";
  EXPECT_FALSE(Follows(crowd, 29 + 26, 1)) << "25.5 m away";
  crowd.mechanisms[29 + 26].now.secondaries.Add(1);
  EXPECT_TRUE(Follows(crowd, 29 + 26, 1)) << "until it is two more";
  crowd.boxes[299].velocity = {-900, 0};
  EXPECT_TRUE(Follows(crowd, 299, 1)) << "it may come itself";
  crowd.follow_bodies = 300;
  crowd.boxes[299].velocity = {2, 0};
  EXPECT_TRUE(Follows(crowd, 299, 1)) << "a room that is followed whole";
  EXPECT_TRUE(Follows(Row(10, 0.5f), 299, 1)) << "a push goes through all of a heap";
}

/// Bouncing balls in a row, .2 m apart, were taken for a heap, and every peer followed all of them.
TEST(PlanAuthority, BodiesSideBySideAreNoHeap) {
  EXPECT_FALSE(Follows(Row(10, 0.5f + 0.2f), 299, 1));
  EXPECT_TRUE(Follows(Row(10, 0.5f + 0.2f), 29 + 20, 1)) << "14 m away";
  EXPECT_TRUE(Follows(Row(10, 0.5f + 0.02f), 299, 1)) << "stacks have gaps";
}

/// Balls that bounce beside each other fall and rise, but do not come nearer.
TEST(PlanAuthority, InALargeRoomAFallingBodyIsFollowedIfItsPathMayBeMet) {
  AuthorityView view = TwoSides({-50, 20, 21.2f, 22.4f});
  for (std::size_t m = 1; m < 4; ++m) {
    view.boxes[m].velocity = {0, m % 2 == 0 ? 8.0f : -8.0f};
    view.mechanisms[m].falls = true;
  }
  view.mechanisms[1].owner = 0;  // ann's, in a row of bob's
  view.buffer_m = 0;
  view.follow_bodies = 3;
  EXPECT_TRUE(Follows(view, 2, kAnn)) << "no way down is known: they may turn anywhere";
  view.gravity = {0, -10};
  EXPECT_FALSE(Follows(view, 2, kAnn));
  view.mechanisms[2].falls = false;
  EXPECT_FALSE(Follows(view, 2, kAnn)) << "of two one falls";
  view.mechanisms[1].falls = false;
  EXPECT_TRUE(Follows(view, 2, kAnn)) << "what touches something may turn";
  view.mechanisms[1].falls = view.mechanisms[2].falls = true;
  view.boxes[2].velocity.x() = -2;
  EXPECT_TRUE(Follows(view, 2, kAnn)) << "it comes";
  EXPECT_FALSE(Follows(view, 3, kAnn));
  view.boxes[3].velocity.x() = -4;
  EXPECT_TRUE(Follows(view, 3, kAnn)) << "it comes through the other";
  view.follow_bodies = 4;
  view.boxes[2].velocity.x() = view.boxes[3].velocity.x() = 0;
  EXPECT_TRUE(Follows(view, 2, kAnn)) << "a room that is followed whole";
}

TEST(PlanAuthority, ABodyMetThroughOthersIsFollowedToo) {
  AuthorityView view = TwoSides({-50, 20, 20.6f, 21.2f, 30});
  view.mechanisms[1].owner = 0;  // ann's, among a row of bob's that touch
  view.buffer_m = 0;
  EXPECT_TRUE(Follows(view, 2, kAnn));
  EXPECT_TRUE(Follows(view, 3, kAnn)) << "through the one between";
  EXPECT_FALSE(Follows(view, 4, kAnn));
}

TEST(PlanAuthority, ARoomOfAtMostFollowBodiesIsFollowedWholeAndALargerOneNearby) {
  AuthorityView view = TwoSides({-50, 23, 7, 20, 16});
  view.buffer_m = 10;
  view.follow_bodies = 5;
  for (std::size_t m = 1; m < 5; ++m) EXPECT_TRUE(Follows(view, m, kAnn)) << m;
  view.follow_bodies = 4;
  for (std::size_t m = 1; m < 5; ++m) {
    EXPECT_EQ(Follows(view, m, kAnn), m == 2) << m << ": of those only one is in the buffer zone";
  }
}

TEST(PlanAuthority, TheServerFollowsASmallRoomAndInALargeOneItsSurroundings) {
  AuthorityView view = TwoSides({-50, 50, 200.6f, 201.2f});
  view.mechanisms[3].owner = 1;  // bob's, beside one in nobody's region
  constexpr int kServer = 0;
  ASSERT_EQ(PlanAuthority(view)[2].authority, kServer);
  view.server_follow = 4;
  for (const std::size_t m : {0u, 1u, 3u}) EXPECT_TRUE(Follows(view, m, kServer)) << m;
  view.server_follow = 3;
  EXPECT_FALSE(Follows(view, 0, kServer));
  EXPECT_FALSE(Follows(view, 1, kServer));
  EXPECT_TRUE(Follows(view, 3, kServer)) << "it lies beside one of the server's";
  view.physics_edits = true;
  EXPECT_TRUE(Follows(view, 0, kServer)) << "it orders what physics finds";
}

TEST(PlanAuthority, FollowBodiesCountsTheBodiesOfAMechanism) {
  AuthorityView view = TwoSides({-50, 20, 30});
  view.buffer_m = 0;
  for (int more = 0; more < 3; ++more)
    view.boxes.push_back(BoxAt({20, static_cast<float>(more)}, 1));
  view.follow_bodies = 5;
  EXPECT_FALSE(Follows(view, 1, kAnn)) << "six bodies";
  view.follow_bodies = 6;
  EXPECT_TRUE(Follows(view, 1, kAnn));
}

TEST(PlanAuthority, OnlyModeBufferHasFollowersAndOnlyBufferAndStrictHavePeers) {
  AuthorityView view = TwoSides({3});
  view.policy = &StrictPolicy();
  EXPECT_EQ(PlanAuthority(view)[0].authority, kBob);
  EXPECT_EQ(PlanAuthority(view)[0].secondaries.size(), 0);
  for (const Policy* policy : {&OraclePolicy(), &CentralPolicy(false), &CentralPolicy(true)}) {
    view.policy = policy;
    EXPECT_EQ(PlanAuthority(view)[0].authority, 0);
  }
}

TEST(PlanAuthority, MechanismsToBeJoinedGoToTheFirstsHolderAndTheOtherFollows) {
  AuthorityView view = TwoSides({-50, 50, 60});
  view.together = {{0, 1}};
  const AuthorityPlan plan = PlanAuthority(view);
  EXPECT_EQ(plan[0].authority, kAnn);
  EXPECT_EQ(plan[1].authority, kAnn);
  EXPECT_TRUE(plan[1].secondaries.Has(kBob));
  EXPECT_FALSE(plan[1].secondaries.Has(kAnn));
  EXPECT_EQ(plan[2].authority, kBob) << "not concerned";
}

TEST(PlanAuthority, AMechanismToBeJoinedToAVehicleGoesToItsOwner) {
  AuthorityView view = TwoSides({-50, 50});
  view.mechanisms[1].owner = 1;
  view.together = {{0, 1}};
  EXPECT_EQ(PlanAuthority(view)[0].authority, kBob);
}

PlayerMask OnlyBob() {
  PlayerMask mask;
  mask.Add(1);
  return mask;
}

TEST(PlanAuthority, AForbiddenBodyIsTheServers) {
  AuthorityView view = TwoSides({-50, 50});
  view.mechanisms[0].may_have = OnlyBob();
  view.mechanisms[1].may_have = OnlyBob();
  const AuthorityPlan plan = PlanAuthority(view);
  EXPECT_EQ(plan[0].authority, 0);
  EXPECT_EQ(plan[1].authority, kBob);
}

TEST(PlanAuthority, JoiningDoesNotGrantAForbiddenBody) {
  AuthorityView view = TwoSides({-50, 50});
  view.mechanisms[1].may_have = OnlyBob();
  view.together = {{0, 1}};
  EXPECT_EQ(PlanAuthority(view)[1].authority, 0);
}

}  // namespace plan_test
}  // namespace seam
