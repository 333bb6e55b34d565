/// Breaks each invariant of the soak and checks that it is reported.

#include <gtest/gtest.h>

#include "tests/support/replica_test_access.h"
#include "tests/support/soak/invariants.h"

namespace seam {
namespace soak_invariants_test {

/// A session in which nothing goes wrong by itself.
class SoakInvariants : public ::testing::Test {
 protected:
  void SetUp() override {
    plan_.config.scene = "stack";
    plan_.config.impair = "perfect";
    plan_.config.drive = Drive::kNone;
    plan_.config.keep = false;
    plan_.config.duration_s = 100;
    faults_ = std::make_unique<FaultRunner>(plan_);
    cluster_ = std::make_unique<Cluster>(faults_->Config());
    invariants_ = std::make_unique<Invariants>(*cluster_, *faults_, false);
    cluster_->each_instant = [this] {
      if (harm_) harm_();
      invariants_->Look();
      faults_->Act(*cluster_);
    };
    RunFor(6);
    ASSERT_TRUE(invariants_->broken().empty()) << invariants_->broken().begin()->first;
  }
  void RunFor(double seconds) {
    cluster_->RunToTick(cluster_->server().tick() + static_cast<std::int64_t>(60 * seconds));
  }
  Replica& replica(int client) {
    return const_cast<Replica&>(*cluster_->client(client)->replica());
  }
  bool Broke(const std::string& what) const { return invariants_->broken().count(what) == 1; }

  FaultPlan plan_;
  std::unique_ptr<FaultRunner> faults_;
  std::unique_ptr<Cluster> cluster_;
  std::unique_ptr<Invariants> invariants_;
  std::function<void()> harm_;  // before each look
};

TEST_F(SoakInvariants, FindsTwoHoldersOfOneEpoch) {
  const int peer = cluster_->client(0)->peer();
  AuthorityRecord record = replica(0).authority().at(0);
  record.authority = record.authority == peer ? 0 : peer;
  replica(0).authority().Set(0, record);
  const int other = cluster_->client(1)->peer();
  if (record.authority == 0) {
    record.authority = other;
    replica(1).authority().Set(0, record);
  }
  RunFor(0.1);
  EXPECT_TRUE(Broke("an epoch has one authority"));
}

TEST_F(SoakInvariants, FindsARestingBodyThatWasDisplaced) {
  RunFor(8);
  ASSERT_TRUE(replica(0).rest().Holds(0));
  harm_ = [this] {
    World& world = ReplicaTestAccess::world(replica(0));
    BodyState state = world.Read(0);
    state.position.x() += 0.001f;
    world.Write(0, state, false);
  };
  RunFor(0.5);
  EXPECT_TRUE(Broke("what rests lies where it rests"));
}

TEST_F(SoakInvariants, FindsABodyAboveTheSpeedLimit) {
  harm_ = [this] {
    World& world = ReplicaTestAccess::world(replica(0));
    BodyState state = world.Read(0);
    state.velocity = {cluster_->scene().speed_limit + 10, 0};
    world.Write(0, state);
  };
  RunFor(0.05);
  EXPECT_FALSE(Broke("nothing explodes")) << "a moment is no explosion";
  RunFor(0.2);
  EXPECT_TRUE(Broke("nothing explodes"));
}

TEST_F(SoakInvariants, FindsAHealthyClientThatDoesNotPlay) {
  cluster_->Kill(0);
  RunFor(12);
  EXPECT_TRUE(Broke("who is well plays"));
}

TEST_F(SoakInvariants, FindsAClientThatGoesOnInAnotherWorld) {
  // Bob no longer hears of edits, and so cannot be repaired.
  Server& server = cluster_->server();
  const PartId part = server.replica().world().id(0);
  server.Order(Edit(RemoveEdit{part}, EditCause::kOutside));
  harm_ = [this] { cluster_->Pause(1, true); };
  RunFor(6);
  EXPECT_TRUE(Broke("edits arrive"));
}

TEST_F(SoakInvariants, FindsQueuesThatGrow) {
  Server& server = cluster_->server();
  harm_ = [&] {
    cluster_->Pause(1, true);
    for (int i = 0; i < 20; ++i) server.Order(Edit(PushEdit{0, {0.001f, 0}}, EditCause::kOutside));
  };
  RunFor(3);
  EXPECT_TRUE(Broke("queues are bounded"));
}

TEST(SoakFaultPlan, ASeedRepeatsItsPlanAndAnotherSeedDiffers) {
  const FaultChoice choice{{"crossing", "stack", "wall"}, 60};
  const FaultPlan plan = DrawFaults(7, choice), again = DrawFaults(7, choice);
  EXPECT_EQ(plan.name, again.name);
  ASSERT_EQ(plan.faults.size(), again.faults.size());
  for (std::size_t i = 0; i < plan.faults.size(); ++i) {
    EXPECT_EQ(plan.faults[i].from_s, again.faults[i].from_s);
    EXPECT_EQ(plan.faults[i].kind, again.faults[i].kind);
    EXPECT_LE(plan.faults[i].to_s, 60 - kCalmSeconds);
  }
  EXPECT_NE(plan.name, DrawFaults(8, choice).name);
}

}  // namespace soak_invariants_test
}  // namespace seam
