#include "server/sessions/address_token.h"

#include <algorithm>

namespace seam {

std::int64_t AddressToken::InSlot(std::int64_t slot, const Address& address,
                                  std::uint64_t session) const {
  std::uint8_t bytes[18 + 8 + 8];
  const auto from = BytesOf(address);
  std::copy(from.begin(), from.end(), bytes);
  PutNumber(bytes + 18, session, 8);
  PutNumber(bytes + 26, static_cast<std::uint64_t>(slot), 8);
  return static_cast<std::int64_t>(KeyedHash(secret_, {bytes, sizeof bytes}));
}

std::int64_t AddressToken::Make(std::int64_t now_us, const Address& address,
                                std::uint64_t session) const {
  return InSlot(SlotAt(now_us), address, session);
}

std::int64_t AddressToken::SlotOf(std::int64_t now_us, const Address& address,
                                  std::uint64_t session, std::int64_t token) const {
  const std::int64_t slot = SlotAt(now_us);
  if (token == InSlot(slot, address, session)) return slot;
  return token == InSlot(slot - 1, address, session) ? slot - 1 : -1;
}

}  // namespace seam
