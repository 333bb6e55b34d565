#pragma once
/// Decides which clients receive a rest commit now and which later (large rooms only). For a client
/// to which the bodies are out of interest the commit is pending until their turn comes
/// (Broadcast::RefreshDistant) or they come into interest.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/peer_set.h"
#include "common/sync/replica.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {

class RestAudience {
 public:
  /// `replica` must outlive this object.
  explicit RestAudience(const Replica& replica) : replica_(replica) {}

  /// Takes a rest commit that is about to be sent.
  void Take(const Rest& rest);
  /// Chooses the part of the last commit that each of these clients is sent now: the mechanisms
  /// that it hears, of which `hearing(mechanism)` returns the peers. The other mechanisms become
  /// pending for it.
  template <class Hearing>
  void Sort(const PeerSet& clients, const Hearing& hearing) {
    due_.assign(static_cast<std::size_t>(kPeersMax), {});
    for (std::size_t i = 0; i < mechanisms_.size(); ++i) {
      if (mechanisms_[i] < 0) continue;
      PeerSet now = hearing(mechanisms_[i]), later = clients;
      now.Keep(clients);
      now.Each([&](int peer) { due_[static_cast<std::size_t>(peer)].push_back(i); });
      later.Remove(now);
      if (!later.empty()) MarkPending(later, mechanisms_[i]);
    }
  }
  /// Returns the part to send to the peer now, as of the last Sort.
  Rest For(int peer) const;
  /// True if a rest commit of the mechanism, or of a mechanism in the block, is pending for the
  /// peer.
  bool IsPendingFor(int peer, int mechanism) const {
    return owed_ && (*owed_)[mechanism].Has(peer);
  }
  bool IsPendingFor(int peer, const RestBlock& at) const;
  /// Returns the pending commits of these mechanisms, for bodies that still rest, and clears them.
  /// A commit stays pending while the server's copy of its body may move.
  std::vector<Rest> Owed(int peer, const std::vector<int>& mechanisms);
  /// Clears all pending commits of a peer that was sent everything at rest.
  void NoteTold(int peer);

 private:
  void MarkPending(const PeerSet& peers, int mechanism);

  const Replica& replica_;
  Rest rest_, head_;             // the last Take; its head without bodies
  std::vector<int> mechanisms_;  // by its entries; -1: the body is gone
  std::vector<std::vector<std::size_t>> due_;     // by peer, of the last Sort: entries
  std::optional<MechanismColumn<PeerSet>> owed_;  // peers with a pending commit
};

}  // namespace seam
