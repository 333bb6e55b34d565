#include "tests/lab/handover/handover.h"

#include <algorithm>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "common/measure/percentile.h"
#include "tests/lab/session.h"
#include "tests/support/path/opened_net.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace {

/// kB that came to clients: of grants, and of everything.
struct Arrivals {
  double grants = 0, all = 0;
};

/// A client's network that counts what arrives.
class CountingNet : public OpenedNet {
 public:
  CountingNet(std::unique_ptr<Net> inner, Arrivals* count)
      : OpenedNet(std::move(inner), {},
                  [count](std::int64_t, DatagramHeader*, std::vector<Bytes>* messages) {
                    for (const Bytes& message : *messages) {
                      const bool grants = std::holds_alternative<Grants>(Decode(message));
                      if (grants) count->grants += static_cast<double>(message.size()) * 1e-3;
                    }
                    return true;
                  }),
        count_(count) {}
  bool Receive(Address* from, Bytes* datagram) override {
    if (!OpenedNet::Receive(from, datagram)) return false;
    count_->all += static_cast<double>(datagram->size()) * 1e-3;
    return true;
  }

 private:
  Arrivals* count_;
};

class Watch {
 public:
  explicit Watch(Cluster& cluster) : cluster_(cluster) {}

  /// After every virtual instant.
  void Look() {
    FindPeers();
    const Replica& server = cluster_.server().replica();
    // Mechanisms are others after an edit, and what was begun of them is not followed on.
    if (server.revision() != revision_) {
      revision_ = server.revision();
      wishes_.assign(static_cast<std::size_t>(server.authority().count()), Wish{});
      holders_.clear();
      gaps_due_.clear();
    }
    const bool ticked = server.tick() != looked_tick_;
    looked_tick_ = server.tick();
    for (int m = 0; m < server.authority().count(); ++m) LookAt(m, ticked);
    CompareGaps();
  }

  void Write(double seconds, HandOvers* out) {
    out->per_s = static_cast<double>(ms_.size()) / seconds;
    out->dropped_per_s = static_cast<double>(dropped_) / seconds;
    if (!ms_.empty()) {
      out->p50_ms = Percentile(ms_, 0.5);
      out->p99_ms = Percentile(ms_, 0.99);
      out->max_ms = Percentile(ms_, 1);
    }
    if (!gaps_m_.empty()) {
      out->gap_p95_m = Percentile(gaps_m_, 0.95);
      out->gap_p95_mps = Percentile(gaps_mps_, 0.95);
    }
    out->compared = static_cast<std::int64_t>(gaps_m_.size());
    out->unsimulated = unsimulated_;
    out->several = several_;
    if (looks_ > 0) out->none_share = static_cast<double>(none_) / static_cast<double>(looks_);
  }

 private:
  struct Wish {
    int peer = -1;  // -1: who has it is who is to have it
    std::int64_t since_us = 0;
  };
  struct Gap {
    int mechanism = 0, before = 0, now = 0;
    std::int64_t until_tick = 0;
  };

  void FindPeers() {
    peers_.clear();
    const Replica& server = cluster_.server().replica();
    peers_[0] = &server;
    for (int c = 0; c < cluster_.client_count(); ++c) {
      const Client* client = cluster_.client(c);
      if (client == nullptr || !client->running()) continue;
      if (client->replica()->revision() == server.revision()) {
        peers_[client->peer()] = client->replica();
      }
    }
  }

  void LookAt(int m, bool ticked) {
    const Replica& server = cluster_.server().replica();
    int holder = -1, believers = 0;
    const auto& mechanisms = server.world().composition().mechanisms;
    const int first = mechanisms[static_cast<std::size_t>(m)].assemblies.front();
    const PartId id = server.world().composition().assemblies[static_cast<std::size_t>(first)].id;
    // What lies committed needs nobody.
    bool simulated = server.rest().Holds(server.world().BodyOfId(id));
    for (const auto& [peer, replica] : peers_) {
      const bool has = replica->authority().at(m).authority == peer;
      believers += has ? 1 : 0;
      if (has) holder = peer;
      if (!ticked) continue;
      const int body = replica->world().BodyOfId(id);
      simulated = simulated || replica->world().activity(body) == Activity::kSimulated;
    }
    several_ += believers > 1 ? 1 : 0;
    if (ticked) {
      ++looks_;
      none_ += believers == 0 ? 1 : 0;
      unsimulated_ += simulated ? 0 : 1;
    }
    FollowWish(m, holder);
    if (holder >= 0) FollowHolder(m, holder);
  }

  void FollowWish(int m, int holder) {
    Wish& wish = wishes_[static_cast<std::size_t>(m)];
    if (wish.peer >= 0 && holder == wish.peer) {
      ms_.push_back(static_cast<double>(cluster_.now_us() - wish.since_us) * 1e-3);
      wish.peer = -1;
    }
    const int wanted = ServerTestAccess::Authority(cluster_.server()).Wanted(m);
    if (wish.peer >= 0 && wanted != wish.peer) {
      ++dropped_;
      wish.peer = -1;
    }
    if (wish.peer < 0 && holder >= 0 && wanted != holder) wish = {wanted, cluster_.now_us()};
  }

  void FollowHolder(int m, int holder) {
    const auto [known, fresh] = holders_.emplace(m, holder);
    if (fresh || known->second == holder) return;
    gaps_due_.push_back({m, known->second, holder, peers_.at(holder)->tick() + 4});
    known->second = holder;
  }

  /// As soon as both are at the same tick.
  void CompareGaps() {
    std::vector<Gap> left;
    for (const Gap& gap : gaps_due_) {
      const auto before = peers_.find(gap.before), now = peers_.find(gap.now);
      if (before == peers_.end() || now == peers_.end()) continue;
      if (before->second->tick() == now->second->tick()) {
        Compare(gap.mechanism, before->second->world(), now->second->world());
      } else if (now->second->tick() < gap.until_tick) {
        left.push_back(gap);
      }
    }
    gaps_due_ = std::move(left);
  }

  void Compare(int m, const World& before, const World& now) {
    const Composition& made = now.composition();
    for (const int a : made.mechanisms[static_cast<std::size_t>(m)].assemblies) {
      const PartId id = made.assemblies[static_cast<std::size_t>(a)].id;
      const int one = before.BodyOfId(id), other = now.BodyOfId(id);
      // What either has not, or only shows, says nothing.
      if (before.activity(one) != Activity::kSimulated ||
          now.activity(other) != Activity::kSimulated)
        continue;
      const BodyState then = before.Read(one), here = now.Read(other);
      gaps_m_.push_back(static_cast<double>((here.position - then.position).norm()));
      gaps_mps_.push_back(static_cast<double>((here.velocity - then.velocity).norm()));
    }
  }

  Cluster& cluster_;
  std::map<int, const Replica*> peers_;  // those that count the same mechanisms
  int revision_ = -1;
  std::int64_t looked_tick_ = -1, looks_ = 0, none_ = 0, unsimulated_ = 0, several_ = 0;
  std::int64_t dropped_ = 0;
  std::vector<Wish> wishes_;    // by mechanism
  std::map<int, int> holders_;  // by mechanism: who had it last
  std::vector<Gap> gaps_due_;
  std::vector<double> ms_, gaps_m_, gaps_mps_;
};

}  // namespace

HandOvers MeasureHandOvers(ClusterConfig config) {
  Arrivals count;
  config.keep = false;
  config.smooth_rate = 0;
  config.client_net = [&count](std::size_t, std::unique_ptr<Net> net) {
    return std::make_unique<CountingNet>(std::move(net), &count);
  };
  Cluster cluster(config);
  const double seconds = config.duration_s > 0 ? config.duration_s : cluster.scene().duration_s;
  const int hz = cluster.scene().solver.tick_hz;
  cluster.RunToTick(std::min<std::int64_t>(hz, static_cast<std::int64_t>(seconds * hz)));
  const Arrivals begin = count;
  Watch watch(cluster);
  cluster.each_instant = [&watch] { watch.Look(); };
  const std::int64_t first = cluster.server().tick();
  cluster.RunToTick(static_cast<std::int64_t>(seconds * hz));
  RequireScripts(cluster.server());
  const Arrivals end = count;
  HandOvers out;
  out.clients = cluster.client_count();
  out.mechanisms = cluster.server().replica().authority().count();
  const double span_s = static_cast<double>(cluster.server().tick() - first) / hz;
  if (span_s <= 0) return out;
  watch.Write(span_s, &out);
  const double clients = std::max(1, out.clients);
  out.grants_kbps = (end.grants - begin.grants) / (span_s * clients);
  out.to_client_kbps = (end.all - begin.all) / (span_s * clients);
  return out;
}

}  // namespace seam
