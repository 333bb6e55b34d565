#pragma once
/// Who owns a body: the server's one answer. It holds the state of authority, follows the plan with
/// one holder at a time, and says what is to be told to everyone; it sends nothing itself.

#include <cstdint>
#include <vector>

#include "common/sync/replica.h"
#include "server/authority/plan.h"

namespace seam {

class AuthorityManager {
 public:
  /// Writes the table of `replica`, which, like `scene`, must outlive it. At first the server has
  /// everything; in mode buffer it follows everything too, so that it can take over at any moment.
  AuthorityManager(const Scene& scene, const SyncConfig& config, Replica& replica);

  /// What it cannot know by itself.
  struct Situation {
    std::vector<int> peer_of_player;  ///< -1: nobody is ready to drive it
    PeerSet confirmed;                ///< peers that have received all that they were told reliably
    std::vector<std::vector<int>> together;  ///< see AuthorityView
  };

  /// After each tick: plans when that is due, and takes every hand-over as far as it can go.
  /// Returns what everyone is to be told, in this order.
  std::vector<Grants> Update(std::int64_t now_us, const Situation& situation);
  /// Somebody came or went: the next Update plans.
  void PlanSoon() { plan_due_ = true; }
  /// The server has what a peer that is gone had. Requires that its lease has ended (lease.h).
  std::vector<Grants> TakeBack(std::int64_t now_us, int peer);
  /// The mechanisms are others now; see BodyRemap.
  void Remap(const std::vector<std::vector<int>>& from);

  /// Everything, for one who joins.
  std::vector<Grants> Export(std::int64_t now_us) const;
  /// Whether the peer has authority over the mechanism, as far as everyone was told.
  bool Has(int peer, int mechanism) const { return table().at(mechanism).authority == peer; }
  /// Whether the peer follows a body in its buffer zone.
  bool Follows(int peer, int body) const;
  /// Whether mechanisms have one authority, and none of them is changing hands.
  bool InOneHand(const std::vector<int>& mechanisms) const;

  enum class Right {
    kYes,
    kStale,  ///< of an epoch that is over
    kNo,
  };
  /// Whether a peer may say, in an epoch, where a body is.
  Right RightToMove(int peer, int body, int epoch) const;

 private:
  /// What is remembered of a mechanism besides its record.
  struct Memory {
    bool revoking = false;                 // its holder is told to let go, and has not confirmed
    int last_authority = 0;                // when it was planned last
    std::int64_t changed_tick = -1000000;  // when a plan first saw that authority
  };

  const AuthorityTable& table() const { return replica_.authority(); }
  AuthorityView Look(const Situation& situation);
  /// Whether the holder of a mechanism that is revoked has let go. The one place that decides it.
  bool Released(int mechanism, const Situation& situation) const;
  /// The record while nobody has it: the server next, an epoch on.
  AuthorityRecord WithoutHolder(AuthorityRecord record) const;

  const Scene& scene_;
  const SyncConfig config_;
  Replica& replica_;
  AuthorityPlan plan_;  // the last one
  bool plan_due_ = true;
  std::vector<Memory> memory_;  // by mechanism
};

}  // namespace seam
