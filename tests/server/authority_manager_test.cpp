/// Hand-overs, one holder at a time, without a network. ann's region is left of x = 0, bob's right
/// of it; the ball is ann's, and nothing moves.

#include "server/authority/authority_manager.h"

#include <gtest/gtest.h>

#include <utility>

#include "common/scene/scene.h"
#include "common/sync/lease.h"
#include "tests/support/replica_test_access.h"

namespace seam {
namespace authority_manager_test {

using Right = AuthorityManager::Right;

constexpr int kAnn = 1, kBob = 2;
constexpr PartId kBall = 0;

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
  std::vector<Grants> Update(std::int64_t now_us = 1) {
    manager_.PlanSoon();
    return manager_.Update(now_us, situation_);
  }

  Scene scene_;
  Replica replica_;
  AuthorityManager manager_;
  AuthorityManager::PlannerInputs situation_;
};

TEST_F(AuthorityManagerTest, AtFirstTheServerHoldsAndFollowsEverything) {
  EXPECT_TRUE(manager_.Has(0, 0));
  EXPECT_TRUE(Ball().secondaries.Has(0));
  EXPECT_EQ(Ball().epoch, 0);
}

TEST_F(AuthorityManagerTest, TheServerGrantsAtOnceAndAnnouncesItOnce) {
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
  EXPECT_EQ(manager_.AcceptRelease(kBob, kBall, 2), Right::kNo) << "not bob's word counts";
  EXPECT_TRUE(Update().empty());
  EXPECT_TRUE(manager_.Has(kAnn, 0));
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 2), Right::kYes);
  Update();
  EXPECT_TRUE(manager_.Has(0, 0));
  EXPECT_EQ(Ball().epoch, 2) << "the epoch that the revocation named";
  EXPECT_TRUE(manager_.InOneHand({0}));
}

TEST_F(AuthorityManagerTest, AReleaseCountsOnlyForTheGrantThatAskedForIt) {
  Update();
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 1), Right::kStale) << "the grant that gave it";
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 2), Right::kNo) << "nobody asked";
  situation_.peer_of_player = {-1, kBob};
  Update();
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 1), Right::kStale);
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 3), Right::kNo) << "an epoch still to come";
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, -1), Right::kStale);
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall + 1, 2), Right::kNo) << "no such mechanism";
  EXPECT_EQ(manager_.AcceptRelease(kBob, kBall, 2), Right::kNo);
  EXPECT_TRUE(Update().empty());
  EXPECT_TRUE(manager_.Has(kAnn, 0)) << "none of them counted";
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 2), Right::kYes);
  Update();
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 2), Right::kStale) << "said again";
}

TEST_F(AuthorityManagerTest, AnOverdueHolderIsNamedAndLosesItTwoEpochsLater) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  Update();
  const std::int64_t told_us = 2;
  Update(told_us);
  EXPECT_EQ(manager_.OverdueHolders(told_us + kReleasePatienceUs), PeerSet());
  PeerSet ann;
  ann.Add(kAnn);
  EXPECT_EQ(manager_.OverdueHolders(told_us + kReleasePatienceUs + 1), ann);
  EXPECT_TRUE(manager_.Has(kAnn, 0)) << "one authority, until it is taken back";
  manager_.TakeBack(2, kAnn);
  EXPECT_EQ(manager_.OverdueHolders(2 * kReleasePatienceUs), PeerSet());
  EXPECT_TRUE(manager_.Has(0, 0));
  EXPECT_EQ(Ball().epoch, 3);
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, 1), Right::kStale);
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 2), Right::kStale) << "too late";
}

TEST_F(AuthorityManagerTest, AnUnansweredRevocationIsWithdrawnAndRepeatedLater) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  Update();
  EXPECT_TRUE(Update(kWithdrawUs).empty()) << "it may still answer";
  const std::vector<Grants> withdrawn = Update(kWithdrawUs + 2);
  ASSERT_EQ(withdrawn.size(), 1u);
  EXPECT_EQ(withdrawn[0].authority.at(0), kAnn);
  EXPECT_EQ(withdrawn[0].epoch.at(0), 3) << "the question was the second";
  EXPECT_TRUE(manager_.InOneHand({0})) << "its edits are ordered again";
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, 1), Right::kYes) << "it may not know the third yet";
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, 2), Right::kStale) << "nobody had it in the second";
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, 3), Right::kYes);
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 2), Right::kYes) << "late, and void";
  Update(kWithdrawUs + 3);
  EXPECT_TRUE(manager_.Has(kAnn, 0));
  const std::vector<Grants> again = Update(kWithdrawUs + kAskAgainUs + 3);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].authority.at(0), 0);
  EXPECT_EQ(again[0].epoch.at(0), 4);
  EXPECT_TRUE(Update(3 * kWithdrawUs).empty()) << "this one stands";
  EXPECT_EQ(manager_.AcceptRelease(kAnn, kBall, 4), Right::kYes);
  Update(3 * kWithdrawUs + 1);
  EXPECT_TRUE(manager_.Has(0, 0));
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, 3), Right::kStale);
  EXPECT_EQ(manager_.OverdueHolders(10 * kReleasePatienceUs), PeerSet());
}

TEST_F(AuthorityManagerTest, ASilentHolderIsNotAskedAgainBeforeItIsHeard) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  Update();
  situation_.silent.Add(kAnn);
  ASSERT_EQ(Update(kWithdrawUs + 2).size(), 1u);
  EXPECT_TRUE(Update(kWithdrawUs + kAskAgainUs + 3).empty());
  situation_.silent.Remove(kAnn);
  const std::vector<Grants> again = Update(kWithdrawUs + kAskAgainUs + 4);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].authority.at(0), 0);
}

TEST_F(AuthorityManagerTest, AHolderIsNotOverdueWhileTheQuestionWaitsForItsTurn) {
  Update();
  situation_.untrusted.Add(kAnn);
  situation_.one_way_s = {0, 0};
  std::vector<std::int32_t> asked;
  for (std::int64_t now_us = 1; now_us < 12'000'000; now_us += 20'000) {
    situation_.sent_us = {now_us < 8'000'000 ? 0 : 8'000'000, now_us};
    for (const Grants& told : Update(now_us)) asked.push_back(told.epoch.at(0));
    EXPECT_EQ(manager_.OverdueHolders(now_us), PeerSet()) << now_us;
  }
  EXPECT_EQ(asked, (std::vector<std::int32_t>{2, 3, 4})) << "again once the first was sent";
  EXPECT_NE(manager_.OverdueHolders(kTellPatienceUs + 8'100'000), PeerSet());
}

TEST_F(AuthorityManagerTest, ALongPathHasFourRoundTripsToAnswer) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  situation_.one_way_s = {0, 0.0f};
  Update();
  situation_.peer_of_player = {kAnn, kBob};
  situation_.one_way_s = {0.5f, 0};  // a round trip of 1 s
  EXPECT_TRUE(Update(3900000).empty());
  EXPECT_EQ(Update(4100000).size(), 1u);
}

TEST_F(AuthorityManagerTest, WithdrawalsDoNotLengthenThePatience) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  PeerSet ann;
  ann.Add(kAnn);
  for (std::int64_t now_us = 1; now_us < kReleasePatienceUs; now_us += 10000) {
    Update(now_us);
    EXPECT_EQ(manager_.OverdueHolders(now_us), PeerSet()) << now_us;
  }
  EXPECT_EQ(Ball().epoch, 3) << "it was withdrawn once";
  EXPECT_EQ(manager_.OverdueHolders(kReleasePatienceUs + 40000), ann);
}

TEST_F(AuthorityManagerTest, AnEndedLeaseCoversOnlyTheHoldersOwnMechanismAndEpoch) {
  Update();
  EXPECT_TRUE(manager_.HoldsInEpoch(kAnn, kBall, 1));
  EXPECT_FALSE(manager_.HoldsInEpoch(kAnn, kBall, 2)) << "nobody has it in that epoch";
  EXPECT_FALSE(manager_.HoldsInEpoch(kBob, kBall, 1)) << "it is not bob's";
  EXPECT_FALSE(manager_.HoldsInEpoch(0, kBall, 1));
  EXPECT_FALSE(manager_.HoldsInEpoch(kAnn, kBall + 1, 1)) << "no such mechanism";
}

TEST_F(AuthorityManagerTest, ATimelyReleaseIsNotOverdueBeforeTheNextPlan) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  Update();
  manager_.AcceptRelease(kAnn, kBall, 2);
  EXPECT_EQ(manager_.OverdueHolders(2 * kReleasePatienceUs), PeerSet());
}

TEST_F(AuthorityManagerTest, ALatecomerDuringARevocationGetsTheSameRecordAsTheOthers) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  Update();
  const std::vector<Grants> told = manager_.Export(2);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].authority.at(0), 0) << "else one whose world is repaired would hold it again";
  EXPECT_EQ(told[0].epoch.at(0), 2);
}

TEST_F(AuthorityManagerTest, EpochsGoOnPastSixteenBits) {
  constexpr int kHandOvers = 70000;
  AuthorityTable client(replica_.world().composition(), replica_.table());
  int holder = kAnn;
  for (int n = 0; n < kHandOvers; ++n) {
    situation_.peer_of_player = {holder, -1};
    for (const Grants& g : Update()) client.Apply(g);  // revocation, but for the first time
    const AuthorityRecord record = Ball();
    if (record.authority != holder) {
      ASSERT_EQ(manager_.AcceptRelease(record.authority, kBall, record.epoch + 1), Right::kYes);
      for (const Grants& g : Update()) client.Apply(g);
    }
    ASSERT_EQ(Ball().authority, holder) << n;
    ASSERT_EQ(client.at(0).authority, holder) << n;
    ASSERT_EQ(client.at(0).epoch, 2 * n + 1);
    holder = holder == kAnn ? kBob : kAnn;
  }
  EXPECT_GT(Ball().epoch, 1 << 16);
}

TEST_F(AuthorityManagerTest, ATakenBackMechanismHasAnUnpromisedEpoch) {
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
  Update();
  const int epoch = Ball().epoch;
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, epoch), Right::kYes);
  EXPECT_EQ(manager_.RightToMove(kAnn, 0, epoch - 1), Right::kStale);
  EXPECT_EQ(manager_.RightToMove(kBob, 0, epoch), Right::kNo);
  EXPECT_EQ(manager_.RightToMove(kBob, 0, epoch - 1), Right::kStale);
}

TEST_F(AuthorityManagerTest, ARemapKeepsRevocationsOfOldMechanismsOnly) {
  Update();
  situation_.peer_of_player = {-1, kBob};
  Update();
  ASSERT_FALSE(manager_.InOneHand({0}));
  BodyRemap change;
  change.bodies.resize(1);
  change.bodies[0].body = 0;
  change.mechanisms = {{0}};
  ReplicaTestAccess::table(replica_).Renumber(change);
  EXPECT_FALSE(manager_.InOneHand({0})) << "still the same mechanism";
  change.mechanisms = {{}};
  ReplicaTestAccess::table(replica_).Renumber(change);
  EXPECT_TRUE(manager_.InOneHand({0}));
}

TEST_F(AuthorityManagerTest, APlayerWithoutPushPermissionDoesNotGetThePart) {
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

/// A bouncing body touches something for a tick or two, and flies on.
TEST(AuthorityManager, AFallingMechanismKeepsItsFlightPlanThroughABounce) {
  const Scene scene = ParseScene(
      "follow = 0\nbuffer = 1\n"
      "[[part]]\nname = \"hers\"\ncircle = 0.5\nposition = [-1.6, 90]\n"
      "[[part]]\nname = \"his\"\ncircle = 0.5\nposition = [1.6, 87]\nvelocity = [0, 12]\n"
      "[[player]]\nname = \"ann\"\nregion = [[-100, -100], [-0.001, 200]]\n"
      "[[player]]\nname = \"bob\"\nregion = [[0, -100], [100, 200]]\n",
      "test.toml");
  const SyncConfig config = MakeSyncConfig("buffer", "");
  Replica replica(scene, config, 0, -1);
  AuthorityManager manager(scene, config, replica);
  AuthorityManager::PlannerInputs situation;
  situation.peer_of_player = {kAnn, kBob};
  const auto ann_follows_his = [&] {
    manager.PlanSoon();
    manager.Update(1, situation);
    EXPECT_EQ(std::as_const(replica).authority().at(1).authority, kBob);
    return std::as_const(replica).authority().at(1).secondaries.Has(kAnn);
  };
  bool falls = true;
  situation.falls = [&](PartId) { return falls; };
  EXPECT_FALSE(ann_follows_his()) << "it flies beside hers";
  falls = false;
  for (int tick = 0; tick < 10; ++tick) replica.Step();
  EXPECT_FALSE(ann_follows_his()) << "it bounces";
  for (int tick = 0; tick < 10; ++tick) replica.Step();
  EXPECT_TRUE(ann_follows_his()) << "it may turn";
}

}  // namespace authority_manager_test
}  // namespace seam
