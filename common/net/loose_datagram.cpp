#include "common/net/loose_datagram.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/net/crc32c.h"
#include "common/net/wire_number.h"

namespace seam {
namespace {

constexpr std::size_t kChecksumAt = 4, kNumberAt = 8;

/// Returns the checksum over the magic and everything after the checksum field.
std::uint32_t Checksum(ByteView datagram) {
  const std::uint32_t magic = Crc32c({datagram.data, kChecksumAt});
  return Crc32c({datagram.data + kNumberAt, datagram.size - kNumberAt}, magic);
}

}  // namespace

Bytes LooseDatagram(std::uint64_t number, ByteView message, std::size_t least_bytes) {
  SEAM_ASSERT(message.size >= 1 && message.size <= kMessageBytesMax);
  const std::size_t bytes = kLooseHeaderBytes + 2 + message.size;
  Bytes datagram(std::max(bytes, least_bytes));
  PutNumber(datagram.data(), kLooseMagic, 4);
  PutNumber(datagram.data() + kNumberAt, number, 8);
  PutNumber(datagram.data() + kLooseHeaderBytes, message.size, 2);
  std::copy(message.begin(), message.end(), datagram.begin() + kLooseHeaderBytes + 2);
  PutNumber(datagram.data() + kChecksumAt, Checksum(datagram), 4);
  return datagram;
}

std::uint64_t LooseNumber(ByteView datagram) {
  if (datagram.size < kLooseHeaderBytes || datagram.size > kDatagramBytesMax) return 0;
  if (GetNumber(datagram.data, 4) != kLooseMagic) return 0;
  if (GetNumber(datagram.data + kChecksumAt, 4) != Checksum(datagram)) return 0;
  return GetNumber(datagram.data + kNumberAt, 8);
}

ByteView LooseMessage(ByteView datagram) {
  constexpr std::size_t kAt = kLooseHeaderBytes + 2;
  if (datagram.size <= kAt) return {};
  const auto bytes = static_cast<std::size_t>(GetNumber(datagram.data + kLooseHeaderBytes, 2));
  if (bytes > std::min(datagram.size - kAt, kMessageBytesMax)) return {};
  return {datagram.data + kAt, bytes};
}

}  // namespace seam
