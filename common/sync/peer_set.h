#pragma once
/// A set of peers.

#include <bitset>

#include "common/base/check.h"
#include "common/codec/messages.h"

namespace seam {

/// Peers 0..kPeersMax - 1 (asserted).
class PeerSet {
 public:
  bool Has(int peer) const { return peers_[At(peer)]; }
  void Add(int peer) { peers_.set(At(peer)); }
  void Remove(int peer) { peers_.reset(At(peer)); }
  void Add(const PeerSet& others) { peers_ |= others.peers_; }
  bool empty() const { return peers_.none(); }
  int size() const { return static_cast<int>(peers_.count()); }
  bool operator==(const PeerSet& o) const { return peers_ == o.peers_; }
  bool operator!=(const PeerSet& o) const { return peers_ != o.peers_; }

 private:
  static std::size_t At(int peer) {
    SEAM_ASSERT(peer >= 0 && peer < kPeersMax);
    return static_cast<std::size_t>(peer);
  }
  std::bitset<static_cast<std::size_t>(kPeersMax)> peers_;
};

}  // namespace seam
