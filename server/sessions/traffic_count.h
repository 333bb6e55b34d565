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
  /// Counts a datagram of a session, sent (`out`) or received, as it is without its seal. A
  /// malformed one counts as kTrafficOther.
  void AddPlain(ByteView plain, bool out);
  /// Counts a datagram outside of a session, or what is none.
  void AddLoose(ByteView datagram, bool out);
  /// Writes the kinds with any bytes into the lists of `load`.
  void Write(Load* load) const;

 private:
  static constexpr std::size_t kTrafficKinds = kTrafficOther + 1;
  std::array<std::int64_t, kTrafficKinds> out_{}, in_{};
  std::vector<DatagramMessage> messages_;  // scratch of AddPlain; keeps its memory
};

}  // namespace seam
