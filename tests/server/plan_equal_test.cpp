/// The plan by grid and sweep is the same, entry by entry, as the plan that compares everything
/// with everything.

#include <gtest/gtest.h>

#include "server/authority/plan.h"
#include "tests/lab/world/plan_worlds.h"
#include "tests/support/plan/plan_reference.h"

namespace seam {
namespace {

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

/// With gravity downwards, to the right and nowhere, in turn; two of three things fall freely.
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

TEST(PlanEqual, InSmallRoomsThatAreFollowedWhole) {
  PlanWorld world;
  EXPECT_EQ(DifferencesOver(world, 40), 0);
}

TEST(PlanEqual, InLargeRoomsThatAreNot) {
  PlanWorld world;
  world.players = 12;
  world.mechanisms = 400;
  world.width = 900;
  world.height = 60;
  world.follow_bodies = 40;
  EXPECT_EQ(DifferencesOver(world, 25), 0);
}

TEST(PlanEqual, InCrowdsAndInTallRooms) {
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

TEST(PlanEqual, WithThingsFarOutsideTheRest) {
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

TEST(PlanEqual, NobodyAndNothing) {
  PlanWorld empty;
  empty.players = 1;
  empty.mechanisms = 0;
  EXPECT_EQ(DifferencesOver(empty, 5), 0);
  EXPECT_TRUE(PlanAuthority(AuthorityView{}).empty());
}

}  // namespace
}  // namespace seam
