#include "server/sessions/address_token.h"

namespace seam {
namespace {

std::uint8_t* Put(std::uint8_t* at, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<std::uint8_t>(value >> (8 * i));
  return at + bytes;
}

}  // namespace

std::int64_t AddressToken::InSlot(std::int64_t slot, const Address& address,
                                  std::uint64_t session) const {
  std::uint8_t bytes[4 + 2 + 8 + 8];
  std::uint8_t* at = Put(bytes, address.ip, 4);
  at = Put(at, address.port, 2);
  at = Put(at, session, 8);
  Put(at, static_cast<std::uint64_t>(slot), 8);
  return static_cast<std::int64_t>(KeyedHash(secret_, {bytes, sizeof bytes}));
}

std::int64_t AddressToken::Make(std::int64_t now_us, const Address& address,
                                std::uint64_t session) const {
  return InSlot(now_us / kSlotUs, address, session);
}

bool AddressToken::Good(std::int64_t now_us, const Address& address, std::uint64_t session,
                        std::int64_t token) const {
  const std::int64_t slot = now_us / kSlotUs;
  return token == InSlot(slot, address, session) || token == InSlot(slot - 1, address, session);
}

}  // namespace seam
