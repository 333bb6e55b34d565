/// Crowds whose owners disagree become the server's, as a pure function of the planner's view:
/// ann's region is left of x = 0, bob's right of it.

#include "server/authority/plan_contested.h"

#include <gtest/gtest.h>

namespace seam {
namespace plan_contested_test {

constexpr int kAnn = 1, kBob = 2;

class PlanContested : public ::testing::Test {
 protected:
  PlanContested() {
    view_.settles = true;
    view_.buffer_m = 4;
    view_.players.push_back({kAnn, 0.05f, true, {-100, -100}, {-0.001f, 100}});
    view_.players.push_back({kBob, 0.05f, true, {0, -100}, {100, 100}});
  }

  /// Adds a box half a metre wide, awake, held by its region's player for long, with the value of
  /// MechanismView::contested.
  std::size_t Add(float x, float contested) {
    MechanismView mechanism;
    mechanism.position = {x, 0};
    mechanism.held_ticks = 1000000;
    mechanism.now.authority = x < 0 ? kAnn : kBob;
    mechanism.contested = contested;
    MovingBox box;
    box.min = mechanism.position - Vec2(0.25f, 0.25f);
    box.max = mechanism.position + Vec2(0.25f, 0.25f);
    box.group = static_cast<int>(view_.mechanisms.size());
    view_.mechanisms.push_back(mechanism);
    view_.boxes.push_back(box);
    return view_.mechanisms.size() - 1;
  }
  /// A row around the border, half a metre apart.
  void AddRow(int count, float contested) {
    for (int i = 0; i < count; ++i) {
      Add(0.6f * (static_cast<float>(i - count / 2) + 0.5f), contested);
    }
  }
  int Decided() const {
    int decided = 0;
    for (const PlannedAuthority& planned : PlanAuthority(view_)) {
      EXPECT_TRUE(!planned.decided || planned.authority == 0);
      decided += planned.decided ? 1 : 0;
    }
    return decided;
  }

  AuthorityView view_;
};

TEST_F(PlanContested, ACrowdOfTwoOwnersBecomesTheServers) {
  AddRow(12, kContestedSum / 10);
  EXPECT_EQ(Decided(), 12);
}

TEST_F(PlanContested, AgreedBodiesKeepTheirOwners) {
  AddRow(12, kContestedSum / 13);
  EXPECT_EQ(Decided(), 0) << "a surprise now and then";
}

TEST_F(PlanContested, BodiesKeepTheirOwnersWherePeersDoNotGoBack) {
  AddRow(12, kContestedSum);
  view_.settles = false;
  EXPECT_EQ(Decided(), 0);
}

TEST_F(PlanContested, TheOwnerThatLosesABodyFollowsIt) {
  AddRow(12, kContestedSum);
  view_.follow_bodies = 0;
  const AuthorityPlan plan = PlanAuthority(view_);
  for (std::size_t m = 0; m < plan.size(); ++m) {
    ASSERT_TRUE(plan[m].decided);
    EXPECT_TRUE(plan[m].secondaries.Has(view_.mechanisms[m].now.authority)) << m;
  }
}

TEST_F(PlanContested, BodiesOfOneOwnerStayItsOwnDespiteTheServersError) {
  for (int i = 0; i < 6; ++i) Add(-20 + 0.6f * static_cast<float>(i), kContestedSum);
  Add(20, kContestedSum);
  EXPECT_EQ(Decided(), 0) << "the seventh is far away";
}

TEST_F(PlanContested, SleepingBodiesAreIgnored) {
  AddRow(12, kContestedSum);
  view_.mechanisms[3].asleep = true;
  EXPECT_EQ(Decided(), 11);
}

TEST_F(PlanContested, StaysTheServersUntilItIsAloneOrSleeps) {
  AddRow(12, 0);
  for (MechanismView& mechanism : view_.mechanisms) {
    mechanism.decided = true;
    mechanism.now.authority = 0;
  }
  EXPECT_EQ(Decided(), 12) << "nobody tells anything of it any more";
  const std::size_t come = Add(3.95f, 0);  // beside the last
  EXPECT_EQ(Decided(), 13) << "what comes to it goes with it";
  view_.mechanisms[come].position.x() = 50;
  view_.boxes[come].min.x() = 50;
  view_.boxes[come].max.x() = 50.5f;
  EXPECT_EQ(Decided(), 12);
  for (MechanismView& mechanism : view_.mechanisms) mechanism.asleep = true;
  EXPECT_EQ(Decided(), 0);
}

}  // namespace plan_contested_test
}  // namespace seam
