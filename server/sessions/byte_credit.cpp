#include "server/sessions/byte_credit.h"

#include <algorithm>

namespace seam {

bool ByteCredit::Draw(const Address& address, std::size_t sent_bytes, std::size_t wanted_bytes) {
  const auto bytes = BytesOf(address);
  Entry& entry = entries_[KeyedHash(key_, {bytes.data(), bytes.size()}) % kAddresses];
  if (entry.address != address) entry = {address, 0};
  entry.bytes = std::min(entry.bytes + sent_bytes, kDatagramBytesMax);
  if (wanted_bytes > entry.bytes) return false;
  entry.bytes -= wanted_bytes;
  return true;
}

}  // namespace seam
