#pragma once
/// One session until everything has come to rest, for tests: the tick at which all bodies slept at
/// their authorities, and the tick at which all peers had the same bits.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/two_sides.h"

namespace seam {

struct RestRun {
  bool all_awake_at_first = true;
  bool owner_changed = false;     ///< some mechanism went from one client to another
  std::int64_t asleep_tick = -1;  ///< from this tick on all slept at their authorities; -1: never
  std::int64_t equal_tick = -1;   ///< from this tick on all peers had the same bits; -1: never
  float jump_m = 0;               ///< farthest that an authority's body moved when committed
  bool agreed = false;            ///< at the end the same bodies rest at all peers
  std::int64_t mismatches = 0;    ///< ticks with other hashes after a second of equal bits
  double quiet_bytes_per_s = -1;  ///< UDP payload of the busiest client, both ways, once all rest

  /// Time from the last body's falling asleep to equality, s; -1: never equal.
  double seconds() const {
    if (asleep_tick < 0 || equal_tick < 0) return -1;
    return static_cast<double>(std::max<std::int64_t>(0, equal_tick - asleep_tick)) / 60.0;
  }
};

/// Follows a cluster tick by tick.
class RestWatcher {
 public:
  explicit RestWatcher(Cluster& cluster) : cluster_(cluster) {}

  /// Runs until all bodies have rested for `quiet_s` with equal bits everywhere, or to `end_s`.
  RestRun Run(double end_s, double quiet_s) {
    const auto end = static_cast<std::int64_t>(end_s * 60);
    while (cluster_.server().tick() < end) {
      cluster_.RunToTick(cluster_.server().tick() + 1);
      Look();
      const std::int64_t since = std::max(run_.asleep_tick, run_.equal_tick);
      const bool both = run_.asleep_tick >= 0 && run_.equal_tick >= 0;
      if (both && static_cast<double>(now() - since) >= quiet_s * 60) break;
    }
    run_.agreed = Agreed();
    return run_;
  }

 private:
  std::int64_t now() { return cluster_.server().tick(); }
  const Replica& replica(int peer) {
    for (int i = 0; peer > 0 && i < cluster_.client_count(); ++i) {
      const Client* client = cluster_.client(i);
      if (client->running() && client->peer() == peer) return *client->replica();
    }
    return cluster_.server().replica();
  }
  std::vector<const Replica*> All() {
    std::vector<const Replica*> all = {&cluster_.server().replica()};
    for (int i = 0; i < cluster_.client_count(); ++i) {
      if (cluster_.client(i)->running()) all.push_back(cluster_.client(i)->replica());
    }
    return all;
  }
  bool Agreed() {
    for (const Replica* replica : All()) {
      if (!replica->rest().all()) return false;
      if (replica->rest().Hash() != cluster_.server().replica().rest().Hash()) return false;
    }
    return true;
  }

  void Look() {
    const Replica& server = cluster_.server().replica();
    const std::vector<const Replica*> all = All();
    bool asleep = true, equal = static_cast<int>(all.size()) == cluster_.client_count() + 1;
    if (before_.empty()) before_.resize(static_cast<std::size_t>(server.world().body_count()));
    for (int body = 0; body < server.world().body_count(); ++body) {
      Before& before = before_[static_cast<std::size_t>(body)];
      const int owner = server.authority().at(server.world().mechanism(body)).authority;
      const Replica& authority = replica(owner);
      const BodyState pose = authority.world().Read(body);
      const bool awake = authority.world().awake(body);
      const bool held = authority.rest().Holds(body);
      if (now() < 30) run_.all_awake_at_first = run_.all_awake_at_first && awake;
      if (owner == before.owner && held && !before.held) {
        run_.jump_m = std::max(run_.jump_m, (pose.position - before.pose.position).norm());
      }
      run_.owner_changed = run_.owner_changed ||
                           (before.last_player > 0 && owner > 0 && owner != before.last_player);
      before.owner = owner;
      if (owner > 0) before.last_player = owner;
      before.held = held;
      before.pose = pose;
      asleep = asleep && !awake;
      for (const Replica* other : all) {
        const BodyState there = other->world().Read(body);
        equal = equal && there.position == pose.position && there.angle == pose.angle;
      }
    }
    Note(asleep, &run_.asleep_tick);
    Note(equal, &run_.equal_tick);
    Count();
  }
  void Note(bool holds, std::int64_t* since) {
    if (!holds) *since = -1;
    if (holds && *since < 0) *since = now();
  }
  /// Hashes and bytes, once all has been equal for 3 s.
  void Count() {
    const bool rests = run_.equal_tick >= 0 && run_.asleep_tick >= 0 &&
                       now() >= std::max(run_.equal_tick, run_.asleep_tick) + 180;
    if (!rests) {
      bytes_then_.clear();
      return;
    }
    run_.mismatches += Agreed() ? 0 : 1;
    std::vector<std::int64_t> bytes;
    for (int i = 0; i < cluster_.client_count(); ++i) {
      const Stats& stats = cluster_.client(i)->stats();
      bytes.push_back(stats.bytes_in + stats.bytes_out);
    }
    if (bytes_then_.empty()) {
      bytes_then_ = bytes;
      then_ = now();
      return;
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const double per_s =
          static_cast<double>(bytes[i] - bytes_then_[i]) * 60 / static_cast<double>(now() - then_);
      run_.quiet_bytes_per_s = i == 0 ? per_s : std::max(run_.quiet_bytes_per_s, per_s);
    }
  }

  struct Before {
    int owner = -1, last_player = -1;
    bool held = false;
    BodyState pose;
  };
  Cluster& cluster_;
  RestRun run_;
  std::vector<Before> before_;
  std::vector<std::int64_t> bytes_then_;
  std::int64_t then_ = 0;
};

}  // namespace seam
