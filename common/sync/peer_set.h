#pragma once
/// A set of peers.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/check.h"
#include "common/codec/messages.h"

namespace seam {

class StateArchive;

/// Peers 0..kPeersMax - 1 (asserted).
class PeerSet {
 public:
  bool Has(int peer) const { return (words_[Word(peer)] & Bit(peer)) != 0; }
  void Add(int peer) { words_[Word(peer)] |= Bit(peer); }
  void Remove(int peer) { words_[Word(peer)] &= ~Bit(peer); }
  void Add(const PeerSet& others) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= others.words_[i];
  }
  void Remove(const PeerSet& others) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= ~others.words_[i];
  }
  /// Keeps only the members that are in `others` too.
  void Keep(const PeerSet& others) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= others.words_[i];
  }
  bool empty() const {
    return std::all_of(words_.begin(), words_.end(), [](std::uint64_t w) { return w == 0; });
  }
  int size() const {
    int count = 0;
    Each([&count](int) { ++count; });
    return count;
  }
  /// Calls `visit(peer)` for each, ascending.
  template <class Visit>
  void Each(const Visit& visit) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      for (std::uint64_t left = words_[i]; left != 0; left &= left - 1) {
        visit(static_cast<int>(i) * kBits + __builtin_ctzll(left));
      }
    }
  }
  void Persist(StateArchive& a);  // authority.cpp
  bool operator==(const PeerSet& o) const { return words_ == o.words_; }
  bool operator!=(const PeerSet& o) const { return words_ != o.words_; }

 private:
  static constexpr int kBits = 64;
  static std::size_t Word(int peer) {
    SEAM_ASSERT(peer >= 0 && peer < kPeersMax);
    return static_cast<std::size_t>(peer / kBits);
  }
  static std::uint64_t Bit(int peer) { return std::uint64_t{1} << (peer % kBits); }

  std::array<std::uint64_t, (kPeersMax + kBits - 1) / kBits> words_{};
};

}  // namespace seam
