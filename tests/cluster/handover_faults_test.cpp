/// A holder does not answer a revocation: its bodies keep moving, the server asks again, and there
/// is never more than one authority.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "client/embed/cluster.h"
#include "tests/support/authority_watch.h"
#include "tests/support/pendulums.h"
#include "tests/support/soak.h"

namespace seam {
namespace handover_faults_test {

constexpr int kAnn = 0;  // client

/// Losses on a client's path.
struct Deaf {
  bool in = false, out = false;
};

class OneWayNet : public Net {
 public:
  OneWayNet(std::unique_ptr<Net> inner, const Deaf* deaf) : inner_(std::move(inner)), deaf_(deaf) {}
  void Advance(std::int64_t now_us) override { inner_->Advance(now_us); }
  void Send(const Address& to, ByteView datagram) override {
    if (!deaf_->out) inner_->Send(to, datagram);
  }
  void Flush() override { inner_->Flush(); }
  bool Receive(Address* from, Bytes* datagram) override {
    while (inner_->Receive(from, datagram)) {
      if (!deaf_->in) return true;
    }
    return false;
  }
  std::int64_t discarded() const override { return inner_->discarded(); }

 private:
  std::unique_ptr<Net> inner_;
  const Deaf* deaf_;
};

/// Pendulums between ann and bob, in a small room or in a large one (without followers of distant
/// bodies).
ClusterConfig Shuttle(bool large, std::int64_t seed, const Deaf* deaf) {
  ClusterConfig config;
  config.scene = "pendulums.toml";
  config.scene_text = (large ? "follow = 1\nserver_follow = 1\n" : "") + Pendulums(16);
  config.impair = "demo";
  config.seed = seed;
  config.duration_s = 30;
  config.client_net = [deaf](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    if (client != kAnn) return net;
    return std::make_unique<OneWayNet>(std::move(net), deaf);
  };
  return config;
}

/// Watches that the server has one authority for each, and how long bodies stand in its view.
struct Onlooker {
  AuthorityWatch watch;
  std::map<int, std::pair<float, std::int64_t>> moved;  // body: x, and the tick it changed at
  std::int64_t longest_still = 0, tick = -1;
  int withdrawn = 0;
  std::map<int, AuthorityRecord> records;

  void Look(Cluster& cluster) {
    watch.Look(cluster);
    const Replica& server = cluster.server().replica();
    for (int m = 0; m < server.authority().count(); ++m) {
      const AuthorityRecord& now = server.authority().at(m);
      AuthorityRecord& before = records[m];
      withdrawn +=
          now.authority == before.authority && now.authority > 0 && now.epoch == before.epoch + 2
              ? 1
              : 0;
      before = now;
    }
    if (server.tick() == tick) return;
    tick = server.tick();
    for (int body = 0; body < server.world().body_count(); ++body) {
      const float x = server.world().Read(body).position.x();
      auto& [last, since] = moved[body];
      if (std::fabs(x - last) > 0.002f) {
        last = x;
        since = tick;
      }
      longest_still = std::max(longest_still, tick - since);
    }
  }
  void ExpectOneAuthority() const {
    EXPECT_EQ(watch.several, 0);
    EXPECT_EQ(watch.two_holders_of_an_epoch, 0);
    EXPECT_EQ(watch.two_named_in_an_epoch, 0);
  }
};

void ExpectAgreed(Cluster& cluster) {
  const AuthorityTable& ours = cluster.server().replica().authority();
  for (int c = 0; c < 2; ++c) {
    ASSERT_TRUE(cluster.client(c)->running()) << "client " << c;
  }
  std::map<int, int> stray;  // mechanism: ticks on end
  for (int tick = 0; tick < 240; ++tick) {
    cluster.RunToTick(cluster.server().tick() + 1);
    for (int c = 0; c < 2; ++c) {
      const AuthorityTable& theirs = cluster.client(c)->replica()->authority();
      for (int m = 0; m < ours.count(); ++m) {
        int& ticks = stray[2 * m + c];
        ticks = theirs.at(m).epoch == ours.at(m).epoch ? 0 : ticks + 1;
        ASSERT_LT(ticks, 150) << "mechanism " << m << ", client " << c;
      }
    }
  }
}

void Fail(bool large, std::int64_t seed, double from_s, double for_s, const std::string& what) {
  SCOPED_TRACE(what + (large ? ", large" : ", small") + ", seed " + std::to_string(seed));
  Deaf deaf;
  Cluster cluster(Shuttle(large, seed, &deaf));
  Onlooker onlooker;
  cluster.each_instant = [&] { onlooker.Look(cluster); };
  cluster.RunToTick(static_cast<std::int64_t>(from_s * 60));
  if (what == "paused") cluster.Pause(kAnn, true);
  deaf.in = what == "hears nothing";
  deaf.out = what == "is not heard";
  cluster.RunToTick(static_cast<std::int64_t>((from_s + for_s) * 60));
  cluster.Pause(kAnn, false);
  deaf = Deaf();
  cluster.RunToTick(static_cast<std::int64_t>((from_s + for_s + 8) * 60));
  onlooker.ExpectOneAuthority();
  EXPECT_GT(onlooker.withdrawn, 0) << "nobody was asked in vain: this shows nothing";
  // In a large room the server follows only a silent holder's moving bodies (kStandInSpeed): one at
  // the end of its swing then waits there.
  EXPECT_LT(onlooker.longest_still, large ? 180 : 60) << "it stands";
  ExpectAgreed(cluster);
}

TEST(HandOverFaults, APausedHolderStopsNoBody) {
  for (const bool large : {false, true}) {
    for (const int seed : SoakSeeds(1, 2)) {
      Fail(large, seed, 4 + 0.3 * static_cast<double>(seed), 2.3, "paused");
      Fail(large, seed, 4 + 0.3 * static_cast<double>(seed), 3.6, "paused");
    }
  }
}

TEST(HandOverFaults, AHolderThatHearsNothingReleasesByItself) {
  for (const bool large : {false, true}) {
    for (const int seed : SoakSeeds(1, 2)) {
      Fail(large, seed, 4 + 0.3 * static_cast<double>(seed), 8, "hears nothing");
      Fail(large, seed, 4 + 0.3 * static_cast<double>(seed), 2, "hears nothing");
    }
  }
}

TEST(HandOverFaults, TheServerSendsStatesForASilentHolder) {
  for (const bool large : {false, true}) {
    for (const int seed : SoakSeeds(1, 2)) {
      Fail(large, seed, 4 + 0.3 * static_cast<double>(seed), 8, "is not heard");
      Fail(large, seed, 4 + 0.3 * static_cast<double>(seed), 2, "is not heard");
    }
  }
}

}  // namespace handover_faults_test
}  // namespace seam
