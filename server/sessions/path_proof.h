#pragma once
/// Bounds what is sent to the address of a session until its client has acknowledged something that
/// was sent there. Keys alone do not prove an address: somebody may have joined by reading
/// another's path, or moves his session to the address of a victim.

#include <cstddef>
#include <cstdint>
#include <limits>

namespace seam {

class PathProof {
 public:
  /// Most bytes to an address without proof, for each byte from there.
  static constexpr std::size_t kBytesForEach = 4;

  /// Begins with an address. `sent`: number of the newest datagram sent to the client so far.
  void Begin(std::int64_t sent) {
    sent_before_ = sent;
    left_ = 0;
    proved_ = false;
  }
  /// Counts a datagram from the address. `acknowledged`: number of the newest datagram that the
  /// client has acknowledged, 0: none.
  void Receive(std::size_t bytes, std::int64_t acknowledged) {
    proved_ = proved_ || acknowledged > sent_before_;
    left_ += kBytesForEach * bytes;
  }
  /// Returns the bytes that may be sent to the address now.
  std::size_t left() const { return proved_ ? std::numeric_limits<std::size_t>::max() : left_; }
  /// Takes a datagram to the address out of these. Returns false, and takes nothing, if it is more.
  bool Spend(std::size_t bytes) {
    if (proved_) return true;
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }

 private:
  std::int64_t sent_before_ = 0;
  std::size_t left_ = 0;
  bool proved_ = false;
};

}  // namespace seam
