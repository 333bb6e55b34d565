#pragma once
/// How many bytes an address without a session may draw: never more than it sent. A table of fixed
/// size, so that no number of addresses fills the memory.

#include <array>
#include <cstdint>

#include "common/base/entropy.h"
#include "common/net/keyed_hash.h"
#include "common/net/net.h"

namespace seam {

class ByteCredit {
 public:
  explicit ByteCredit(Entropy& entropy) : key_(DrawHashKey(entropy)) {}

  /// The address has sent so many bytes, and wants so many in answer: true if all that it has drawn
  /// stays within all that it has sent; they count as drawn then.
  bool Draw(const Address& address, std::size_t sent_bytes, std::size_t wanted_bytes);

  /// Addresses remembered. Another address in the same place takes it, and its credit is lost: who
  /// is crowded out says hello once more.
  static constexpr std::size_t kAddresses = 256;

 private:
  struct Entry {
    Address address;
    std::size_t bytes = 0;
  };
  const HashKey key_;  // so that nobody can choose whose place he takes
  std::array<Entry, kAddresses> entries_{};
};

}  // namespace seam
