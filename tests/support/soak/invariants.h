#pragma once
/// Invariants that must hold at every virtual instant of a session, with any faults.
/// docs/metrics.md, "Soak", lists them.

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/soak/fault_runner.h"

namespace seam {

/// A violated invariant: the number of violations, and the first one.
struct Broken {
  long times = 0;
  std::string first;
};

class Invariants {
 public:
  /// Both must outlive this. `strict`: the room's mode, in which other peers' bodies have infinite
  /// mass; bodies may explode there.
  Invariants(Cluster& cluster, const FaultRunner& faults, bool strict);

  /// To be called after every virtual instant, before FaultRunner::Act.
  void Look();

  /// Violations by invariant; empty: all held.
  const std::map<std::string, Broken>& broken() const { return broken_; }
  long compared() const { return compared_; }  ///< number of compared records and poses
  /// Longest observed length of each queue, by name.
  const std::map<std::string, std::size_t>& queues() const { return queues_; }
  float fastest() const { return fastest_; }          ///< m/s, of any body at any peer
  int reached_rest() const { return reached_rest_; }  ///< compared bodies at rest

 private:
  /// A client without a fault plays within this time, us: it may have to notice that it was dropped
  /// (Client::kLostUs) and to join again, with three of ten datagrams lost. The same holds for one
  /// that the server has dropped without a fault.
  static constexpr std::int64_t kBackUs = 10000000;
  /// Reliable messages have taken effect within this time, us.
  static constexpr std::int64_t kToldUs = 4000000;

  struct Record {
    PartId id = -1;
    int authority = 0;
    std::int32_t epoch = -1;
  };
  /// A body's pose, and the time of its last change.
  struct Still {
    BodyState pose;
    std::int64_t since_us = 0;
  };
  /// One peer as of the last check; the first is the server.
  struct Peer {
    const Replica* replica = nullptr;  // nullptr: it has none, or is stopped
    int self = 0;
    int revision = -1;
    std::vector<Record> records;
    std::map<PartId, int> fast_ticks;         // bodies: ticks on end beyond the speed limit
    std::int64_t behind_us = -1;              // since when its revision is not the server's
    std::map<PartId, std::int64_t> stray_us;  // mechanisms: since when it knows another owner
    std::map<PartId, std::int64_t> stray_relevant_us;  // and since when they concern it
    std::map<PartId, Still> still_elsewhere;          // bodies that lie still otherwise
    std::map<PartId, std::int64_t> far_us;            // bodies: since when it has them elsewhere
    std::map<PartId, std::int64_t> rest_other_us;     // bodies: since when it knows other rest
  };
  using Holders = std::map<std::pair<PartId, std::int32_t>, int>;  // by mechanism and epoch

  void Say(const std::string& what, const std::string& detail);
  bool Well(std::size_t peer, std::int64_t for_us) const;
  void FindPeers();
  void LookAtAuthority();
  void NoteRecord(const Peer& peer, std::size_t p, const Record& record);
  void LookAtCompositions();
  void LookForStrays();
  void LookAtBodies();
  void LookAtRest();
  void LookAtPoses();
  void NoteStill();
  bool Lies(PartId body) const;
  bool IslandLies(const Replica& holder, int body) const;
  const Replica* HolderOf(PartId body) const;
  void LookAtQueues();
  void LookAtClients();

  Cluster& cluster_;
  const FaultRunner& faults_;
  const bool strict_;
  float top_ = 0;  // m, of the scene as it was
  std::vector<Peer> peers_;
  std::vector<std::int64_t> played_us_;  // by client: when it last played
  Holders named_, believed_;
  std::set<int> named_revisions_;  // those at which the server was looked at
  std::map<PartId, Still> still_;  // bodies at their holders
  std::int64_t looked_tick_ = -1;
  std::map<std::string, Broken> broken_;
  std::map<std::string, std::size_t> queues_;
  long compared_ = 0;
  float fastest_ = 0;
  int reached_rest_ = 0;
};

}  // namespace seam
