/// The plan by grid and sweep is the same, entry by entry, as the plan that compares everything
/// with everything.

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <map>
#include <utility>
#include <vector>

#include "server/authority/plan.h"
#include "server/authority/plan_islands.h"
#include "server/authority/swept_boxes.h"
#include "tests/lab/world/plan_worlds.h"
#include "tests/support/plan/plan_reference.h"

namespace seam {
namespace plan_equal_test {

/// Entries that differ.
int Differences(const AuthorityView& view) {
  const AuthorityPlan fast = PlanAuthority(view);
  const ReferencePlan slow = PlanSlowly(view);
  int differ = 0;
  for (std::size_t m = 0; m < slow.size(); ++m) {
    const bool same =
        fast[m].authority == slow[m].authority && fast[m].secondaries == slow[m].secondaries;
    differ += same ? 0 : 1;
  }
  return differ;
}

/// Differences of the plans with gravity downwards, to the right and zero, in turn; two of three
/// mechanisms fall freely.
int DifferencesOver(PlanWorld world, int seeds) {
  int differ = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    AuthorityView view = RandomView(world, static_cast<std::uint64_t>(seed));
    view.gravity = seed % 3 == 0 ? Vec2(0, 0) : seed % 3 == 1 ? Vec2(0, -10) : Vec2(10, 0);
    for (std::size_t m = 0; m < view.mechanisms.size(); ++m) {
      view.mechanisms[m].falls = view.mechanisms[m].driver < 0 && m % 3 != 0;
    }
    differ += Differences(view);
  }
  return differ;
}

/// Vehicles that drive among single boxes that sleep; all players are here, the server has the
/// rest.
AuthorityView VehiclesAmongSleepers(std::uint64_t seed) {
  PlanWorld world;
  world.players = 20;
  world.mechanisms = 400;
  world.width = 500;
  world.chains = world.regions = false;
  AuthorityView view = RandomView(world, seed);
  for (std::size_t p = 0; p < view.players.size(); ++p) {
    view.players[p].peer = static_cast<int>(p) + 1;
    view.players[p].silent = false;
  }
  for (MechanismView& mechanism : view.mechanisms) {
    mechanism.now = {};
    mechanism.may_have = kEveryPlayer;
    mechanism.asleep = mechanism.driver < 0;
  }
  for (MovingBox& box : view.boxes) {
    if (view.mechanisms[static_cast<std::size_t>(box.group)].asleep) box.velocity = {0, 0};
  }
  return view;
}

/// The player with the vehicle that touches it first within the planner's horizon; -1: none.
int FirstToTouch(const AuthorityView& view, const MovingBox& box) {
  int first = -1;
  float soonest = FLT_MAX;
  for (const MovingBox& own : view.boxes) {
    const int p = view.mechanisms[static_cast<std::size_t>(own.group)].driver;
    if (p < 0) continue;
    const float ahead = own.velocity.norm() > kSettles ? kTouchAhead : kStandingAhead;
    const float one_way = view.players[static_cast<std::size_t>(p)].one_way_s;
    const float after = SecondsToTouch(own, box, kTouchGap, 2 * one_way + kPlanPeriod + ahead);
    if (after < soonest || (after == soonest && after != FLT_MAX && p < first)) {
      soonest = after;
      first = p;
    }
  }
  return first;
}

TEST(PlanEqual, ASleeperGoesToThePlayerThatTouchesItFirst) {
  int differ = 0, met = 0, nobody = 0;
  for (int seed = 1; seed <= 30; ++seed) {
    const AuthorityView view = VehiclesAmongSleepers(static_cast<std::uint64_t>(seed));
    const AuthorityPlan plan = PlanAuthority(view);
    for (const MovingBox& box : view.boxes) {
      const auto m = static_cast<std::size_t>(box.group);
      const bool alone =
          std::none_of(view.boxes.begin(), view.boxes.end(), [&](const MovingBox& other) {
            return other.group != box.group && Gap(box, other) <= kTouchGap;
          });
      if (!view.mechanisms[m].asleep || !alone) continue;
      const int player = FirstToTouch(view, box);
      ++(player < 0 ? nobody : met);
      differ += plan[m].authority == (player < 0 ? 0 : player + 1) ? 0 : 1;
    }
  }
  EXPECT_EQ(differ, 0);
  EXPECT_GT(met, 300);
  EXPECT_GT(nobody, 300);
}

/// The first boxes of all mechanisms, then the second ones: no two of one stand beside each other.
void DealOut(std::vector<MovingBox>* boxes) {
  std::map<int, int> seen;  // of a mechanism
  std::vector<std::pair<int, MovingBox>> dealt;
  for (const MovingBox& box : *boxes) dealt.emplace_back(seen[box.group]++, box);
  std::stable_sort(dealt.begin(), dealt.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < dealt.size(); ++i) (*boxes)[i] = dealt[i].second;
}

TEST(PlanEqual, BoxesAreEqualTogetherOrOneByOne) {
  int differ = 0, held = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    PlanWorld world;
    world.players = 12;
    world.mechanisms = 250;
    world.width = seed % 2 == 0 ? 900.0f : 120.0f;
    world.regions = seed % 4 == 0;
    world.follow_bodies = 40;
    world.fast = 0;  // beyond kApproachMax it is not looked for as far as it comes
    AuthorityView view = RandomView(world, static_cast<std::uint64_t>(seed));
    for (MovingBox& box : view.boxes) {  // what sleeps lies still
      if (view.mechanisms[static_cast<std::size_t>(box.group)].asleep) box.velocity = {0, 0};
    }
    const AuthorityPlan together = PlanAuthority(view);
    DealOut(&view.boxes);
    const AuthorityPlan apart = PlanAuthority(view);
    for (std::size_t m = 0; m < together.size(); ++m) {
      const bool same = together[m].authority == apart[m].authority &&
                        together[m].secondaries == apart[m].secondaries;
      differ += same ? 0 : 1;
      held += together[m].authority > 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(differ, 0);
  EXPECT_GT(held, 2000);
}

TEST(PlanEqual, IsEqualInSmallRoomsThatAreFollowedWhole) {
  PlanWorld world;
  EXPECT_EQ(DifferencesOver(world, 40), 0);
}

TEST(PlanEqual, IsEqualInLargeRoomsThatAreNot) {
  PlanWorld world;
  world.players = 12;
  world.mechanisms = 400;
  world.width = 900;
  world.height = 60;
  world.follow_bodies = 40;
  EXPECT_EQ(DifferencesOver(world, 25), 0);
}

TEST(PlanEqual, IsEqualInCrowdsAndInTallRooms) {
  PlanWorld crowd;
  crowd.players = 10;
  crowd.mechanisms = 300;
  crowd.width = crowd.height = 60;
  crowd.follow_bodies = 60;
  EXPECT_EQ(DifferencesOver(crowd, 15), 0);
  PlanWorld tower = crowd;
  tower.width = 30;
  tower.height = 600;
  EXPECT_EQ(DifferencesOver(tower, 15), 0);
}

TEST(PlanEqual, IsEqualWithBodiesFarOutsideTheRest) {
  PlanWorld world;
  world.players = 6;
  world.mechanisms = 200;
  world.follow_bodies = 20;
  for (int seed = 1; seed <= 10; ++seed) {
    AuthorityView view = RandomView(world, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < view.boxes.size(); i += 50) {
      view.boxes[i].min += Vec2(25000, -20000);
      view.boxes[i].max += Vec2(25000, -20000);
    }
    EXPECT_EQ(Differences(view), 0) << seed;
  }
}

TEST(PlanEqual, IsEqualWithoutPlayersOrBodies) {
  PlanWorld empty;
  empty.players = 1;
  empty.mechanisms = 0;
  EXPECT_EQ(DifferencesOver(empty, 5), 0);
  EXPECT_TRUE(PlanAuthority(AuthorityView{}).empty());
}

}  // namespace plan_equal_test
}  // namespace seam
