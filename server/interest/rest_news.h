#pragma once
/// Whom it concerns that bodies have come to rest, in a large room. Those to whom they are nothing
/// are owed it: until their turn comes, or the bodies come to concern them.

#include <cstddef>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/peer_set.h"
#include "common/sync/replica.h"
#include "server/interest/pose_entry.h"

namespace seam {

class RestNews {
 public:
  /// It must outlive this.
  explicit RestNews(const Replica& replica) : replica_(replica) {}

  /// A commitment is about to be told.
  void Take(const Rest& rest);
  /// What of the last one a peer is told now: of the mechanisms of which it hears,
  /// `hears(mechanism)`. It is owed the others.
  template <class Hears>
  Rest For(int peer, const Hears& hears) {
    Rest told = head_;
    for (std::size_t i = 0; i < mechanisms_.size(); ++i) {
      if (mechanisms_[i] < 0) continue;
      if (hears(mechanisms_[i])) {
        AddPose(rest_, i, &told);
      } else {
        Owe(peer, mechanisms_[i]);
      }
    }
    return told;
  }
  /// Whether a peer was not told of all that rests of a mechanism, or of a block.
  bool Owes(int peer, int mechanism) const {
    const auto m = static_cast<std::size_t>(mechanism);
    return m < owed_.size() && owed_[m].Has(peer);
  }
  bool Owes(int peer, const RestBlock& at) const;
  /// What a peer is owed of these mechanisms, as far as it rests still; it is owed no more.
  std::vector<Rest> Owed(int peer, const std::vector<int>& mechanisms);
  /// A peer was told everything.
  void NoteTold(int peer);
  /// The mechanisms have changed; see BodyRemap.
  void Remap(const std::vector<std::vector<int>>& from);

 private:
  void Owe(int peer, int mechanism);

  const Replica& replica_;
  Rest rest_, head_;             // of the last Take; its head without bodies
  std::vector<int> mechanisms_;  // of its entries; -1: has left
  std::vector<PeerSet> owed_;    // by mechanism; what is beyond is owed to nobody
};

}  // namespace seam
