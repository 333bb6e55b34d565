#pragma once
/// Bytes of datagrams by kind of content.

#include <array>
#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/net/datagram.h"

namespace seam {

class TrafficCount {
 public:
  /// Counts a datagram, sent (`out`) or received. A malformed one counts as kTrafficOther.
  void Add(ByteView datagram, bool out);
  /// Writes the kinds with any bytes into the lists of `load`.
  void Write(Load* load) const;

 private:
  static constexpr std::size_t kTrafficKinds = kTrafficOther + 1;
  std::array<std::int64_t, kTrafficKinds> out_{}, in_{};
  std::vector<DatagramMessage> messages_;  // scratch of Add; keeps its memory
};

}  // namespace seam
