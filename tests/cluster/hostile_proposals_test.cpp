/// Forbidden proposals, and nonsense in permitted ones: each is dropped, counted by its reason and
/// cheap, and the room runs on.

#include <gtest/gtest.h>

#include "common/sync/edits/edit_order.h"
#include "server/edits/edit_log.h"
#include "tests/support/allocations/count_allocations.h"
#include "tests/support/client_test_access.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace hostile_proposals_test {

/// A group at rest is ann's: she may propose bonds of it.
const std::string kGroups = std::string("duration = 30\nbuffer = 8\n") + kTwoSides + R"(
[grouping]
after = 0.5
[[part]]
name = "floor"
box = [80, 1]
position = [0, -0.5]
anchored = true
[[part]]
name = "box"
box = [1, 1]
position = [-20, 0.515]
repeat = {count = 6, step = [1.5, 0]}
[[part]]
name = "his"
box = [1, 1]
position = [20, 0.515]
)";

EditOrder Proposal(AnyEdit what) { return ToOrder(Edit(std::move(what))); }

class HostileProposals : public ::testing::Test {
 protected:
  HostileProposals() {
    ClusterConfig config;
    config.scene_text = kGroups;
    config.reconcile = "retrospect";
    config.impair = "perfect";
    config.drive = Drive::kNone;
    cluster_ = std::make_unique<Cluster>(config);
    cluster_->RunToTick(20);
  }

  const World& world() { return cluster_->server().replica().world(); }

  std::unique_ptr<Cluster> cluster_;
};

/// The log alone, as the server asks it.
TEST_F(HostileProposals, ForbiddenProposalsAreNeitherParsedNorCopied) {
  const SyncConfig config = MakeSyncConfig("buffer", "retrospect");
  Replica replica(cluster_->scene(), config, 0, -1);
  AuthorityManager authority(cluster_->scene(), config, replica);
  EditLog log(replica.world(), authority, 60);
  const EditOrder insert = Proposal(InsertEdit{
      "[[part]]\nname = \"x\"\nbox = [1, 1]\nposition = [0, 9]\n" + std::string(800, '\n')});
  const std::size_t before = AllocatedBytes();
  for (int i = 0; i < 100; ++i) EXPECT_EQ(log.Propose(1, insert), EditLog::Verdict::kNoRight);
  // A copy of the scene's parts alone is more than this; each text is copied out of its message.
  EXPECT_LT(AllocatedBytes() - before, 100 * 4 * kEditTextMax);
  EXPECT_GT(sizeof(Part) * cluster_->scene().parts.size(), 1500u);
  for (const AnyEdit& what :
       {AnyEdit(RemoveEdit{1}), AnyEdit(FreeEdit{0}), AnyEdit(PushEdit{1, {1, 0}, 0}),
        AnyEdit(SeatEdit{0, 0}), AnyEdit(BlastEdit{{0, 0}, 1, 1}), AnyEdit(std::monostate{})}) {
    EXPECT_EQ(log.Propose(1, Proposal(what)), EditLog::Verdict::kNoRight) << what.index();
  }
  EXPECT_TRUE(log.OrderPending(0).orders.empty());
}

TEST_F(HostileProposals, NonsenseInABondOrABreakIsDropped) {
  const SyncConfig config = MakeSyncConfig("buffer", "retrospect");
  Replica replica(cluster_->scene(), config, 0, -1);
  AuthorityManager authority(cluster_->scene(), config, replica);
  EditLog log(replica.world(), authority, 60);
  // Peer 0 has every right: only the content can be wrong.
  const auto bond = [](float x, float angle, float strength) {
    return Proposal(BondEdit{1, 2, {x, 0}, angle, strength, BondCause::kGroup});
  };
  EXPECT_EQ(log.Propose(0, bond(1.5f, 0, 0)), EditLog::Verdict::kTaken);
  for (const float wild : {3e38f, -3e38f, 1e9f, 1e5f}) {
    EXPECT_NE(log.Propose(0, bond(wild, 0, 0)), EditLog::Verdict::kTaken) << wild;
    EXPECT_NE(log.Propose(0, bond(1.5f, wild, 0)), EditLog::Verdict::kTaken) << wild;
    EXPECT_NE(log.Propose(0, bond(1.5f, 0, wild)), EditLog::Verdict::kTaken) << wild;
  }
  for (const std::int32_t joint : {-1, 0, 1, 1000, INT32_MAX}) {
    EXPECT_NE(log.Propose(0, Proposal(BreakEdit{joint})), EditLog::Verdict::kTaken) << joint;
  }
  EXPECT_EQ(log.OrderPending(0).orders.size(), 1u);
}

TEST_F(HostileProposals, OnePeerDoesNotFillTheRoomForTheOthers) {
  const SyncConfig config = MakeSyncConfig("buffer", "retrospect");
  Replica replica(cluster_->scene(), config, 0, -1);
  AuthorityManager authority(cluster_->scene(), config, replica);
  EditLog log(replica.world(), authority, 60);
  for (int i = 0; i < EditLog::kWaitingMax; ++i) {
    EXPECT_TRUE(log.Add(Edit(PushEdit{1, {0, 0}, 0}, EditCause::kOutside)));
  }
  EXPECT_FALSE(log.Add(Edit(PushEdit{1, {0, 0}, 0}, EditCause::kOutside)));
  replica.authority().Set(0, {1, 1, {}});
  const EditOrder bond = Proposal(BondEdit{1, 2, {1.5f, 0}, 0, 0, BondCause::kGroup});
  EXPECT_EQ(log.Propose(1, bond), EditLog::Verdict::kTaken);
}

TEST_F(HostileProposals, AProposalOfABrokenJointDoesNotBreakTheOneInItsPlace) {
  const SyncConfig config = MakeSyncConfig("buffer", "retrospect");
  Replica replica(cluster_->scene(), config, 0, -1);
  AuthorityManager authority(cluster_->scene(), config, replica);
  EditLog log(replica.world(), authority, 60);
  const auto apply = [&] {
    for (const EditOrder& order : log.OrderPending(0).orders) {
      ASSERT_TRUE(replica.Queue(order));
      replica.ApplyNextEdit();
      log.NoteApplied(ToEdit(order), 0);
    }
  };
  const BondEdit group{1, 2, {1.5f, 0}, 0, 0, BondCause::kGroup};
  log.Add(Edit(group));
  apply();
  ASSERT_EQ(replica.revision(), 1);
  EditOrder stale = Proposal(BreakEdit{0});
  stale.sequence = 1;  // seen by a peer that had the first bond
  log.Add(Edit(BreakEdit{0}));
  apply();
  log.Add(Edit(group));
  apply();
  ASSERT_EQ(replica.world().scene().joints.size(), 1u) << "in the first one's place";
  EXPECT_EQ(log.Propose(0, stale), EditLog::Verdict::kStale);
  // Twice in one go, with a bond between them that takes the place.
  log.Add(Edit(BreakEdit{0}));
  log.Add(Edit(BondEdit{3, 4, {1.5f, 0}, 0, 0, BondCause::kGroup}));
  log.Add(Edit(BreakEdit{0}));
  apply();
  EXPECT_EQ(replica.world().scene().joints.size(), 1u);
  EXPECT_FALSE(replica.world().scene().joints[0].gone) << "of parts 3 and 4";
  stale.sequence = replica.revision();
  EXPECT_EQ(log.Propose(0, stale), EditLog::Verdict::kTaken) << "and now it is meant";
}

TEST_F(HostileProposals, ForgedProposalsAreCountedAndTheRoomRunsOn) {
  Server& server = cluster_->server();
  cluster_->RunToTick(60);
  const Stats before = server.stats();
  const auto dropped = [&] {
    const Stats& now = server.stats();
    return now.dropped_right + now.dropped_stale + now.dropped_implausible + now.dropped_malformed -
           before.dropped_right - before.dropped_stale - before.dropped_implausible -
           before.dropped_malformed;
  };
  const auto say = [&](const EditOrder& order) {
    ClientTestAccess::Say(cluster_->client(0), order);
  };
  const auto settle = [&] { cluster_->RunToTick(server.tick() + 30); };
  const int revision = server.replica().revision();
  const auto bond = [](float x, float angle) {
    return Proposal(BondEdit{1, 3, {x, 0}, angle, 0, BondCause::kGroup});
  };
  for (const EditOrder& order :
       {bond(3, 3e38f), bond(3e38f, 0), bond(-3e38f, -3e38f), Proposal(BreakEdit{INT32_MAX}),
        Proposal(BreakEdit{0}), Proposal(std::monostate{}), Proposal(RemoveEdit{1})}) {
    say(order);
  }
  settle();
  EXPECT_EQ(dropped(), 7);
  EditOrder ordered = Proposal(PushEdit{1, {1, 0}, 0});
  ordered.number = revision;
  say(ordered);
  settle();
  EXPECT_EQ(dropped(), 8) << "only the server gives numbers";
  const std::int64_t right = server.stats().dropped_right;
  for (int tick = 0; tick < 5; ++tick) {
    for (int i = 0; i < 100; ++i) {
      say(Proposal(InsertEdit{"[[part]]\nname = \"x\"\nbox = [1, 1]\nposition = [0, 9]\n"}));
    }
    cluster_->RunToTick(server.tick() + 1);
  }
  cluster_->RunToTick(server.tick() + 120);
  EXPECT_EQ(server.stats().dropped_right + server.stats().dropped_budget - right, 500);
  EXPECT_EQ(server.replica().world().scene().parts.size(), cluster_->scene().parts.size());
  EXPECT_EQ(server.client_count(), 2);
  EXPECT_EQ(cluster_->client(1)->replica()->revision(), server.replica().revision());
}

}  // namespace hostile_proposals_test
}  // namespace seam
