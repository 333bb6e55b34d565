#pragma once
/// Proof of a client's address: a number that only this server can compute, sent to the address and
/// returned from it. The server stores nothing per address.

#include <cstdint>

#include "common/base/entropy.h"
#include "common/net/keyed_hash.h"
#include "common/net/net.h"

namespace seam {

class AddressToken {
 public:
  /// Draws the secret.
  explicit AddressToken(Entropy& entropy) : secret_(DrawHashKey(entropy)) {}

  /// Returns a keyed hash of the address, the session's number and the time slot.
  std::int64_t Make(std::int64_t now_us, const Address& address, std::uint64_t session) const;
  /// Returns the slot in which the token was made for this address and session: this one or the one
  /// before; -1: in neither.
  std::int64_t SlotOf(std::int64_t now_us, const Address& address, std::uint64_t session,
                      std::int64_t token) const;
  static std::int64_t SlotAt(std::int64_t now_us) { return now_us / kSlotUs; }

  /// Length of a time slot, us: a token is valid for one to two slots. Long enough for the slowest
  /// path, short enough that a recorded token is soon worthless.
  static constexpr std::int64_t kSlotUs = 10000000;

 private:
  std::int64_t InSlot(std::int64_t slot, const Address& address, std::uint64_t session) const;

  const HashKey secret_;
};

}  // namespace seam
