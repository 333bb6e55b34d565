#pragma once
/// Bytes of datagrams by what they carry.

#include <array>
#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/net/datagram.h"

namespace seam {

class TrafficCount {
 public:
  /// A datagram that was sent (`out`) or came. What is no datagram of ours counts as other.
  void Add(ByteView datagram, bool out);
  /// Into the Load's lists: the kinds of which there was something.
  void Write(Load* load) const;

 private:
  static constexpr std::size_t kKinds = kTrafficOther + 1;
  std::array<std::int64_t, kKinds> out_{}, in_{};
  std::vector<DatagramMessage> messages_;  // of the last datagram; keeps its memory
};

}  // namespace seam
