/// Hand-overs, one holder at a time, without a network. ann's region is left of x = 0, bob's right
/// of it; the ball is ann's, and nothing moves.

#include "server/authority/authority_manager.h"

#include <gtest/gtest.h>

#include "common/scene/scene.h"

namespace seam {
namespace {

constexpr int kAnn = 1, kBob = 2;

class AuthorityManagerTest : public ::testing::Test {
 protected:
  AuthorityManagerTest()
      : scene_(ParseScene(R"(
gravity = [0, 0]
[[part]]
name = "ball"
circle = 0.5
position = [-50, 0]
[[player]]
name = "ann"
region = [[-100, -100], [-0.001, 100]]
[[player]]
name = "bob"
region = [[0, -100], [100, 100]]
)",
                          "test.toml")),
        replica_(scene_, MakeSyncConfig("buffer", ""), 0, -1),
        manager_(scene_, MakeSyncConfig("buffer", ""), replica_) {
    situation_.peer_of_player = {kAnn, kBob};
  }

  const AuthorityRecord& Ball() const { return std::as_const(replica_).authority().at(0); }
  /// Plans now.
  std::vector<Grants> Update() {
    manager_.PlanSoon();
    return manager_.Update(1, situation_);
  }

  Scene scene_;
  Replica replica_;
  AuthorityManager manager_;
  AuthorityManager::Situation situation_;
};

TEST_F(AuthorityManagerTest, AtFirstTheServerHasAndFollowsEverything) {
  EXPECT_TRUE(manager_.Has(0, 0));
  EXPECT_TRUE(Ball().secondaries.Has(0));
  EXPECT_EQ(Ball().epoch, 0);
}

TEST_F(AuthorityManagerTest, TheServerGivesAtOnceAndSaysItOnce) {
  const std::vector<Grants> grants = Update();
  ASSERT_EQ(grants.size(), 1u);
  EXPECT_EQ(grants[0].authority.at(0), kAnn);
  EXPECT_EQ(grants[0].epoch.at(0), 1);
  EXPECT_TRUE(manager_.Has(kAnn, 0));
  EXPECT_TRUE(Update().empty()) << "nothing new";
}

TEST_F(AuthorityManagerTest, AHandOverWaitsUntilTheHolderHasConfirmed) {
  Update();
  situation_.peer_of_player = {-1, kBob};  // ann's region has nobody
  const std::vector<Grants> revocation = Update();
  ASSERT_EQ(revocation.size(), 1u);
  EXPECT_EQ(revocation[0].authority.at(0), 0);
  EXPECT_EQ(revocation[0].epoch.at(0), 2);
  EXPECT_TRUE(manager_.Has(kAnn, 0)) << "told to let go, but not known to have done so";
  EXPECT_FALSE(manager_.InOneHand({0}));
  situation_.confirmed.Add(kBob);
  EXPECT_TRUE(Update().empty()) << "it is not bob's word that counts";
  EXPECT_TRUE(manager_.Has(kAnn, 0));
  situation_.confirmed.Add(kAnn);
  Update();
  EXPECT_TRUE(manager_.Has(0, 0));
  EXPECT_EQ(Ball().epoch, 2) << "the epoch that the revocation named";
  EXPECT_TRUE(manager_.InOneHand({0}));
}

TEST_F(AuthorityManagerTest, WhatWasTakenBackHasAnEpochThatNobodyWasPromised) {
  Update();
  const int given = Ball().epoch;
  ASSERT_EQ(manager_.TakeBack(2, kAnn).size(), 1u);
  EXPECT_TRUE(manager_.Has(0, 0));
  EXPECT_EQ(Ball().epoch, given + 1);
  EXPECT_FALSE(Ball().secondaries.Has(kAnn));
  EXPECT_TRUE(manager_.TakeBack(2, kBob).empty()) << "he has nothing";
}

TEST_F(AuthorityManagerTest, TakingBackDuringARevocationUsesTheNextEpoch) {
  Update();
  const int given = Ball().epoch;
  situation_.peer_of_player = {-1, kBob};
  Update();
  manager_.TakeBack(2, kAnn);
  EXPECT_EQ(Ball().epoch, given + 2) << "the revocation has used up one";
  EXPECT_TRUE(manager_.InOneHand({0}));
}

TEST_F(AuthorityManagerTest, OnlyTheHolderMayMoveABodyAndOnlyInItsEpoch) {
  using Right = AuthorityManager::Right;
  Update();
  const int epoch = Ball().epoch;
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, epoch), Right::kYes);
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, epoch - 1), Right::kStale);
  EXPECT_EQ(manager_.RightToMove(kBob, 0, epoch), Right::kNo);
  EXPECT_EQ(manager_.RightToMove(kBob, 0, epoch - 1), Right::kStale);
}

TEST_F(AuthorityManagerTest, AfterARemapWhatIsNewIsNotBeingRevoked) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  Update();
  ASSERT_FALSE(manager_.InOneHand({0}));
  manager_.Remap({{0}});
  EXPECT_FALSE(manager_.InOneHand({0})) << "still the same mechanism";
  manager_.Remap({{}});
  EXPECT_TRUE(manager_.InOneHand({0}));
}

TEST_F(AuthorityManagerTest, WhoMayNotPushAPartDoesNotGetIt) {
  Scene scene = ParseScene(R"(
[[part]]
name = "ball"
circle = 0.5
position = [-50, 0]
permissions = {push = ["bob"]}
[[player]]
name = "ann"
region = [[-100, -100], [-0.001, 100]]
[[player]]
name = "bob"
)",
                           "test.toml");
  Replica replica(scene, MakeSyncConfig("buffer", ""), 0, -1);
  AuthorityManager manager(scene, MakeSyncConfig("buffer", ""), replica);
  manager.Update(1, situation_);
  EXPECT_TRUE(manager.Has(0, 0));
}

}  // namespace
}  // namespace seam
