#pragma once
/// Limits the bytes sent to an address without a session: never more than it has sent (no traffic
/// amplification). A table of fixed size, so that no number of addresses fills the memory.

#include <array>
#include <cstdint>

#include "common/base/entropy.h"
#include "common/net/keyed_hash.h"
#include "common/net/net.h"

namespace seam {

class ByteCredit {
 public:
  explicit ByteCredit(Entropy& entropy) : key_(DrawHashKey(entropy)) {}

  /// Credits `sent_bytes` to the address, then takes `wanted_bytes` for an answer. Returns false,
  /// and takes nothing, if the credit is smaller.
  bool Draw(const Address& address, std::size_t sent_bytes, std::size_t wanted_bytes);

  /// Entries in the table. An address that hashes to a taken entry replaces it, and the old credit
  /// is lost: the client that loses it has to say hello once more.
  static constexpr std::size_t kAddresses = 256;

 private:
  struct Entry {
    Address address;
    std::size_t bytes = 0;
  };
  const HashKey key_;  // secret, so that no sender can choose the entry that it replaces
  std::array<Entry, kAddresses> entries_{};
};

}  // namespace seam
