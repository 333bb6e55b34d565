/// Planning as a pure function: ann's region is left of x = 0, bob's right of it.

#include "server/authority/plan.h"

#include <gtest/gtest.h>

namespace seam {
namespace {

constexpr int kAnn = 1, kBob = 2;
constexpr std::int64_t kLong = 1000000;

/// Mechanisms at these x, all the server's for long.
AuthorityView TwoSides(const std::vector<float>& xs) {
  AuthorityView view;
  view.buffer_m = 4;
  view.players.push_back({kAnn, true, {-100, -100}, {-0.001f, 100}});
  view.players.push_back({kBob, true, {0, -100}, {100, 100}});
  for (const float x : xs) {
    MechanismView mechanism;
    mechanism.position = {x, 0};
    mechanism.held_ticks = kLong;
    view.mechanisms.push_back(mechanism);
  }
  return view;
}

int HolderAt(float x, int now, std::int64_t held_ticks) {
  AuthorityView view = TwoSides({x});
  view.mechanisms[0].now.authority = now;
  view.mechanisms[0].held_ticks = held_ticks;
  return PlanAuthority(view)[0].authority;
}

TEST(PlanAuthority, ThePeerInWhoseRegionItIsGetsIt) {
  const AuthorityPlan plan = PlanAuthority(TwoSides({-50, 50, 500}));
  EXPECT_EQ(plan[0].authority, kAnn);
  EXPECT_EQ(plan[1].authority, kBob);
  EXPECT_EQ(plan[2].authority, 0) << "in nobody's region";
}

TEST(PlanAuthority, TheRegionOfAPlayerWhoIsNotHereIsTheServers) {
  AuthorityView view = TwoSides({-50});
  view.players[0].peer = -1;
  EXPECT_EQ(PlanAuthority(view)[0].authority, 0);
}

TEST(PlanAuthority, WhoHasItKeepsItALittleBeyondTheBorder) {
  EXPECT_EQ(HolderAt(kHysteresis - 0.1f, kAnn, kLong), kAnn);
  EXPECT_EQ(HolderAt(kHysteresis + 0.1f, kAnn, kLong), kBob);
  EXPECT_EQ(HolderAt(kHysteresis - 0.1f, 0, kLong), kBob) << "the server has no hysteresis";
}

TEST(PlanAuthority, APeerThatGotItKeepsItForTheDwell) {
  const auto dwell = static_cast<std::int64_t>(kDwell * 60);
  EXPECT_EQ(HolderAt(50, kAnn, dwell - 1), kAnn);
  EXPECT_EQ(HolderAt(50, kAnn, dwell), kBob);
  EXPECT_EQ(HolderAt(50, 0, 0), kBob) << "from the server at once";
}

TEST(PlanAuthority, TheOwnersPeerGetsItWhereverItIsWhileItIsHere) {
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

TEST(PlanAuthority, WhoFollowsGoesOnALittleFurther) {
  AuthorityView view = TwoSides({5});
  view.mechanisms[0].now.secondaries.Add(kAnn);
  EXPECT_TRUE(PlanAuthority(view)[0].secondaries.Has(kAnn));
  view.mechanisms[0].position.x() = view.buffer_m + kHysteresis + 0.1f;
  EXPECT_FALSE(PlanAuthority(view)[0].secondaries.Has(kAnn));
}

TEST(PlanAuthority, OnlyModeBufferHasFollowersAndOnlyBufferAndStrictHavePeers) {
  AuthorityView view = TwoSides({3});
  view.mode = Mode::kStrict;
  EXPECT_EQ(PlanAuthority(view)[0].authority, kBob);
  EXPECT_EQ(PlanAuthority(view)[0].secondaries.size(), 0);
  for (const Mode mode : {Mode::kOracle, Mode::kCentral}) {
    view.mode = mode;
    EXPECT_EQ(PlanAuthority(view)[0].authority, 0);
  }
}

TEST(PlanAuthority, WhatIsToBeJoinedGoesToTheFirstsAndTheOtherFollows) {
  AuthorityView view = TwoSides({-50, 50, 60});
  view.together = {{0, 1}};
  const AuthorityPlan plan = PlanAuthority(view);
  EXPECT_EQ(plan[0].authority, kAnn);
  EXPECT_EQ(plan[1].authority, kAnn);
  EXPECT_TRUE(plan[1].secondaries.Has(kBob));
  EXPECT_FALSE(plan[1].secondaries.Has(kAnn));
  EXPECT_EQ(plan[2].authority, kBob) << "not concerned";
}

TEST(PlanAuthority, WhatIsToBeJoinedToAVehicleGoesToItsOwner) {
  AuthorityView view = TwoSides({-50, 50});
  view.mechanisms[1].owner = 1;
  view.together = {{0, 1}};
  EXPECT_EQ(PlanAuthority(view)[0].authority, kBob);
}

TEST(PlanAuthority, WhatAPlayerMayNotHaveIsTheServers) {
  AuthorityView view = TwoSides({-50, 50});
  view.mechanisms[0].may_have = 0b10;  // bob only
  view.mechanisms[1].may_have = 0b10;
  const AuthorityPlan plan = PlanAuthority(view);
  EXPECT_EQ(plan[0].authority, 0);
  EXPECT_EQ(plan[1].authority, kBob);
}

TEST(PlanAuthority, ComingTogetherDoesNotGiveWhatIsForbidden) {
  AuthorityView view = TwoSides({-50, 50});
  view.mechanisms[1].may_have = 0b10;
  view.together = {{0, 1}};
  EXPECT_EQ(PlanAuthority(view)[1].authority, 0);
}

}  // namespace
}  // namespace seam
