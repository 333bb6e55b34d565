#include "server/sessions/byte_credit.h"

#include <algorithm>

namespace seam {

bool ByteCredit::Draw(const Address& address, std::size_t sent_bytes, std::size_t wanted_bytes) {
  std::uint8_t bytes[6];
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(address.ip >> (8 * i));
  bytes[4] = static_cast<std::uint8_t>(address.port);
  bytes[5] = static_cast<std::uint8_t>(address.port >> 8);
  Entry& entry = entries_[KeyedHash(key_, {bytes, sizeof bytes}) % kAddresses];
  if (entry.address != address) entry = {address, 0};
  entry.bytes = std::min(entry.bytes + sent_bytes, kDatagramBytesMax);
  if (wanted_bytes > entry.bytes) return false;
  entry.bytes -= wanted_bytes;
  return true;
}

}  // namespace seam
