/// Two players, one of them disconnected or killed, have simulated the same discs differently.
/// States sent by their authority stay valid, and the server decides those still in dispute: the
/// players agree again, and the room keeps its energy. tests/sync/told_facts_test.cpp tests the
/// first half alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/gas_room.h"
#include "tests/support/soak/fault_runner.h"

namespace seam {
namespace told_facts_cluster_test {

constexpr int kDiscs = 60;

/// Errors of the first client's copies of the second's bodies at the same tick, m.
std::vector<double> Off(const Replica& first, const Replica& second, int second_peer) {
  std::vector<double> off;
  if (first.tick() != second.tick()) return off;
  const World& world = first.world();
  for (int body = 0; body < world.body_count(); ++body) {
    const int mechanism = world.mechanism(body);
    const bool both = first.authority().at(mechanism).authority == second_peer &&
                      second.authority().at(mechanism).authority == second_peer;
    if (!both) continue;
    const Vec2 apart = world.Read(body).position - second.world().Read(body).position;
    off.push_back(double{apart.norm()});
  }
  return off;
}

/// The upper one of two.
double MedianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

struct Outcome {
  double energy = 0;    ///< at the end, of that at the start
  double parted_m = 0;  ///< median of copies in the second after it
  double off_m = 0;     ///< the same in the last 3 s
};

/// The second client has a fault from 2 to 4 s.
FaultPlan PlanOf(FaultKind kind, std::int64_t seed) {
  FaultPlan plan;
  plan.config.scene = "gas-60";
  plan.config.scene_text = GasRoomText(kDiscs);
  plan.config.reconcile = "rollback";
  plan.config.seed = seed;
  plan.config.drive = Drive::kNone;
  plan.config.keep = false;
  plan.faults = {Fault{kind, 1, 2, 4, 0}};
  return plan;
}

/// In rooms where the server simulates no client's body except a silent one's.
Outcome After(FaultKind kind, std::int64_t seed) {
  FaultPlan plan = PlanOf(kind, seed);
  plan.config.scene_text = "server_follow = 0\n" + plan.config.scene_text;
  plan.config.duration_s = 14;
  FaultRunner faults(plan);
  Cluster cluster(faults.Config());
  std::vector<double> parted, off;
  double before = 0;
  std::int64_t looked[2] = {-1, -1};  // ticks at which ann was compared with bob and the server
  cluster.each_instant = [&] {
    faults.Act(cluster);
    const Client *const ann = cluster.client(0), *const bob = cluster.client(1);
    if (ann == nullptr || ann->replica() == nullptr) return;
    const std::int64_t tick = ann->replica()->tick();
    if (tick == 60) before = KineticEnergy(ann->replica()->world());
    if (tick < 4 * 60 || tick % 2 != 0 || bob == nullptr || bob->replica() == nullptr) return;
    const auto compare = [&](int n, const Replica& other, int peer) -> std::vector<double> {
      if (other.tick() != tick || std::exchange(looked[n], tick) == tick) return {};
      return Off(*ann->replica(), other, peer);
    };
    std::vector<double> now = compare(0, *bob->replica(), bob->peer());
    if (tick < 5 * 60) parted.insert(parted.end(), now.begin(), now.end());
    for (const double m : compare(1, cluster.server().replica(), 0)) now.push_back(m);
    if (tick >= 11 * 60) off.insert(off.end(), now.begin(), now.end());
  };
  cluster.Run();
  EXPECT_GT(off.size(), 200u) << "ann has copies of what bob or the server has";
  return {KineticEnergy(cluster.client(0)->replica()->world()) / before, MedianOf(parted),
          MedianOf(off)};
}

/// Upper medians over eight seeds. Over sixty, medians of the energy are 1.09 to 1.33. When each
/// client replayed by the other's states and then sent different ones, copies were off by 35 to 83
/// cm as long as the room ran.
TEST(ReturningClient, AReturningClientAgreesAgainWithoutAddingEnergy) {
  for (const FaultKind kind : {FaultKind::kCut, FaultKind::kKill}) {
    SCOPED_TRACE(ToString(kind));
    std::vector<double> energy, parted, off;
    for (int seed = 1; seed <= 8; ++seed) {
      const Outcome seen = After(kind, seed);
      energy.push_back(seen.energy);
      parted.push_back(seen.parted_m);
      off.push_back(seen.off_m);
    }
    if (kind == FaultKind::kCut) {
      EXPECT_GT(MedianOf(parted), 0.1) << "they had parted";
    }
    EXPECT_LT(MedianOf(off), 0.05);
    EXPECT_LT(MedianOf(energy), 1.6);
    EXPECT_GT(MedianOf(energy), 0.6);
  }
}

/// The room's energy at the server at 10 s and at the end, relative to the start.
struct Energies {
  double then = 0, end = 0;
  int decided = 0;  ///< discs that are the server's at the end
};

Energies EnergiesAfter(FaultKind kind, const char* impair, std::int64_t seed) {
  FaultPlan plan = PlanOf(kind, seed);
  plan.config.impair = impair;
  plan.config.duration_s = 20;
  FaultRunner faults(plan);
  Cluster cluster(faults.Config());
  const World& world = cluster.server().replica().world();
  const double before = KineticEnergy(world);
  Energies seen;
  cluster.each_instant = [&] {
    faults.Act(cluster);
    if (cluster.server().tick() == 10 * 60) seen.then = KineticEnergy(world) / before;
  };
  cluster.Run();
  seen.end = KineticEnergy(world) / before;
  const AuthorityTable& authority = cluster.server().replica().authority();
  for (int m = 0; m < authority.count(); ++m) seen.decided += authority.at(m).authority == 0;
  return seen;
}

/// The server has simulated everything on and sends states for the disconnected client: nothing is
/// lost.
TEST(ContestedCrowd, ADisconnectedClientMissesNothing) {
  for (const char* impair : {"demo", "4g"}) {
    SCOPED_TRACE(impair);
    const Energies seen = EnergiesAfter(FaultKind::kCut, impair, 1);
    EXPECT_NEAR(seen.end, 1, 0.001);
    EXPECT_LT(seen.decided, kDiscs / 2);
  }
}

/// A client that was paused or restarted has other discs than the server. Before the server decided
/// them, the room reached 15 times its energy after 24 s of this network, rising.
TEST(ContestedCrowd, TheServerDecidesBodiesThatTheirOwnersDisputeAfterAPause) {
  for (const FaultKind kind : {FaultKind::kPause, FaultKind::kKill}) {
    SCOPED_TRACE(ToString(kind));
    const Energies seen = EnergiesAfter(kind, "delay=105ms,jitter=12ms,loss=6%", 2);
    EXPECT_EQ(seen.decided, kDiscs);
    EXPECT_NEAR(seen.end / seen.then, 1, 0.002);
    EXPECT_LT(seen.end, 2);
    EXPECT_GT(seen.end, 0.5);
  }
}

}  // namespace told_facts_cluster_test
}  // namespace seam
