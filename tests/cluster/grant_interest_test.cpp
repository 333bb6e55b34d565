/// In a large room, clients that need a change of authority hear of it at once, the others soon,
/// and distant ones last: no client keeps a wrong owner.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "client/embed/cluster.h"
#include "server/sessions/traffic_count.h"
#include "tests/support/authority_watch.h"
#include "tests/support/pendulums.h"
#include "tests/support/soak.h"

namespace seam {
namespace grant_interest_test {

constexpr int kAnn = 0, kCarl = 2;  // clients

/// Pendulums that swing between ann's region and bob's, and carl a kilometre away; the interest
/// radius is `hear` m.
std::string FarAndNear(int count, int hear) {
  std::string text = "follow = 1\nserver_follow = 1\nbounds = [[-200, -200], [2000, 200]]\n";
  text += Pendulums(count);
  text += R"(
[[player]]
name = "carl"
vehicle = "box"
region = [[900, -100], [1100, 100]]
[[part]]
name = "box"
box = [1, 1]
position = [1000, 1]
[[part]]
name = "ground"
chain = [[900, 0], [1100, 0]]
)";
  return text + "[planner]\nhear = " + std::to_string(hear) + "\n";
}

constexpr int kAllHear = 2000;

ClusterConfig Room(const std::string& impair, std::int64_t seed = 1, int hear = kAllHear) {
  ClusterConfig config;
  config.scene = "far.toml";
  config.scene_text = FarAndNear(8, hear);
  config.impair = impair;
  config.seed = seed;
  return config;
}

/// Mechanisms of which a client knows another owner or epoch than the server.
int Strays(Cluster& cluster, int client) {
  const AuthorityTable& ours = cluster.server().replica().authority();
  const AuthorityTable& theirs = cluster.client(client)->replica()->authority();
  int strays = 0;
  for (int m = 0; m < ours.count(); ++m) {
    const bool same =
        ours.at(m).epoch == theirs.at(m).epoch && ours.at(m).authority == theirs.at(m).authority;
    strays += same ? 0 : 1;
  }
  return strays;
}

TEST(GrantInterest, ADistantClientHearsLessButWithinThreeSeconds) {
  for (const int seed : SoakSeeds(1, 2)) {
    Cluster cluster(Room("demo", seed));
    AuthorityWatch watch;
    cluster.each_instant = [&] { watch.Look(cluster); };
    std::map<int, std::int32_t> heard;  // mechanism: the epoch that carl knew
    std::map<int, std::int64_t> since;  // and the tick at which it was no longer the server's
    int changes[3] = {0, 0, 0};         // of records, as each client saw them
    std::map<std::pair<int, int>, std::int32_t> known;
    cluster.RunToTick(30);
    while (cluster.server().tick() < 15 * 60) {
      cluster.RunToTick(cluster.server().tick() + 1);
      const AuthorityTable& ours = cluster.server().replica().authority();
      for (int c = 0; c < 3; ++c) {
        const AuthorityTable& theirs = cluster.client(c)->replica()->authority();
        for (int m = 0; m < ours.count(); ++m) {
          const auto [it, fresh] = known.emplace(std::pair(c, m), theirs.at(m).epoch);
          if (it->second != theirs.at(m).epoch) ++changes[c];
          it->second = theirs.at(m).epoch;
          if (c != kCarl) continue;
          if (theirs.at(m).epoch == ours.at(m).epoch || theirs.at(m).epoch != heard[m]) {
            since[m] = cluster.server().tick();
          }
          heard[m] = theirs.at(m).epoch;
          ASSERT_LT(cluster.server().tick() - since[m], 3 * 60) << "mechanism " << m;
        }
      }
    }
    EXPECT_GT(changes[kAnn], 40) << "else this shows nothing";
    EXPECT_GT(changes[kCarl], 10) << "he does hear of them";
    EXPECT_LT(changes[kCarl], changes[kAnn]) << "no questions, and what is over is not told";
    EXPECT_EQ(watch.several, 0);
    EXPECT_EQ(watch.two_holders_of_an_epoch, 0);
    EXPECT_EQ(watch.two_named_in_an_epoch, 0);
  }
}

TEST(GrantInterest, AClientOutsideTheInterestAreaHearsEventually) {
  ClusterConfig few = Room("demo", 1, 60), all = Room("demo");
  int changes[2] = {0, 0}, longest[2] = {0, 0};
  for (const bool nothing : {false, true}) {
    ClusterConfig& config = nothing ? few : all;
    config.duration_s = 70;
    Cluster cluster(config);
    std::map<int, std::int32_t> known;
    std::map<int, int>
        strange;  // mechanism: ticks for which carl has heard nothing, and it changed
    cluster.RunToTick(30);
    while (cluster.server().tick() < 60 * 60) {
      cluster.RunToTick(cluster.server().tick() + 1);
      const AuthorityTable& ours = cluster.server().replica().authority();
      const AuthorityTable& theirs = cluster.client(kCarl)->replica()->authority();
      for (int m = 0; m < ours.count(); ++m) {
        const bool heard = std::exchange(known[m], theirs.at(m).epoch) != theirs.at(m).epoch;
        changes[nothing] += heard ? 1 : 0;
        const bool right = heard || theirs.at(m).epoch == ours.at(m).epoch;
        strange[m] = right ? 0 : strange[m] + 1;
        longest[nothing] = std::max(longest[nothing], strange[m]);
      }
    }
  }
  EXPECT_LT(changes[1], changes[0] / 4);
  EXPECT_LT(longest[0], 3 * 60);
  EXPECT_GT(longest[1], 5 * 60) << "this shows nothing";
  EXPECT_LT(longest[1], 21 * 60);
}

bool AnyClientFollows(const AuthorityRecord& record) {
  PeerSet others = record.secondaries;
  others.Remove(0);
  others.Remove(record.authority);
  return !others.empty();
}

/// The holder must agree bit for bit only with followers.
TEST(GrantInterest, AHolderKnowsIfAnyClientFollowsItsMechanism) {
  Cluster cluster(Room("demo"));
  cluster.RunToTick(30);
  int seen[2] = {0, 0}, longest = 0, apart = 0;  // apart: from what the server knows
  std::map<int, int> strange;                    // mechanism: ticks in which its holder errs
  while (cluster.server().tick() < 20 * 60) {
    cluster.RunToTick(cluster.server().tick() + 1);
    const AuthorityTable& ours = cluster.server().replica().authority();
    for (int m = 0; m < ours.count(); ++m) {
      const int holder = ours.at(m).authority;
      if (holder == 0) continue;
      const AuthorityRecord& theirs = cluster.client(holder - 1)->replica()->authority().at(m);
      const bool right = theirs.epoch == ours.at(m).epoch &&
                         AnyClientFollows(theirs) == AnyClientFollows(ours.at(m));
      ++seen[AnyClientFollows(ours.at(m))];
      apart += right ? 0 : 1;
      strange[m] = right ? 0 : strange[m] + 1;
      longest = std::max(longest, strange[m]);
    }
  }
  EXPECT_GT(seen[0], 1000) << "or nothing was tried";
  EXPECT_GT(seen[1], 1000) << "or nothing was tried";
  EXPECT_GT(apart, 0) << "news takes its time";
  EXPECT_LT(longest, 30) << "ticks";
}

TEST(GrantInterest, OnlyTheHolderReceivesTheRevocation) {
  Cluster cluster(Room("demo"));
  cluster.RunToTick(30);
  int questions = 0;
  cluster.each_instant = [&] {
    const AuthorityTable& ours = cluster.server().replica().authority();
    for (int c = 0; c < 3; ++c) {
      const AuthorityTable& theirs = cluster.client(c)->replica()->authority();
      for (int m = 0; m < ours.count(); ++m) {
        if (theirs.at(m).epoch <= ours.at(m).epoch) continue;
        ++questions;
        EXPECT_EQ(cluster.client(c)->peer(), ours.at(m).authority) << "not its business";
      }
    }
  };
  cluster.RunToTick(8 * 60);
  EXPECT_GT(questions, 0);
}

TEST(GrantInterest, AnEditThatMergesMechanismsLeavesNobodyInAnotherEpoch) {
  for (const int seed : SoakSeeds(1, 3)) {
    Cluster cluster(Room("4g", seed));
    cluster.RunToTick(5 * 60 + 7 * seed);
    const PartId beam = 0;
    cluster.server().Order(Edit(FreeEdit{beam}, EditCause::kOutside));  // all pendulums are one
    cluster.RunToTick(cluster.server().tick() + 90);
    for (int c = 0; c < 3; ++c) {
      const Replica& theirs = *cluster.client(c)->replica();
      const Replica& ours = cluster.server().replica();
      ASSERT_EQ(theirs.revision(), ours.revision()) << "seed " << seed << ", client " << c;
      const int m = ours.world().mechanism(ours.world().BodyOfId(beam));
      EXPECT_EQ(theirs.authority().at(m).epoch, ours.authority().at(m).epoch)
          << "seed " << seed << ", client " << c;
      EXPECT_EQ(theirs.authority().at(m).authority, ours.authority().at(m).authority)
          << "seed " << seed << ", client " << c;
    }
  }
}

TEST(GrantInterest, ARejoiningClientLearnsAllOwners) {
  Cluster cluster(Room("demo"));
  cluster.RunToTick(4 * 60);
  cluster.Kill(kCarl);
  cluster.RunToTick(10 * 60);
  cluster.Revive(kCarl);
  cluster.RunToTick(14 * 60);
  ASSERT_TRUE(cluster.client(kCarl)->running());
  const int mechanisms = cluster.server().replica().authority().count();
  EXPECT_LT(Strays(cluster, kCarl), mechanisms) << "what changed in the last two seconds at most";
  cluster.client(kAnn);
  for (int tick = 0; tick < 3 * 60 && Strays(cluster, kCarl) > 0; ++tick) {
    cluster.RunToTick(cluster.server().tick() + 1);
  }
  EXPECT_EQ(Strays(cluster, kCarl), 0);
}

}  // namespace grant_interest_test
}  // namespace seam
