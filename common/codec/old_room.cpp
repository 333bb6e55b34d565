/// Rooms of protocols 1 to 3, which are recognised only to say so.

#include "common/codec/codec.h"

namespace seam {

std::int32_t OldRoomProtocol(ByteView bytes) {
  // Type hash (8 bytes), utime (8), sequence (4 in protocols 1 and 2, then 8), protocol (4).
  constexpr std::uint64_t kRoomHashBefore3 = 0xfc29582c30d1354e;
  constexpr std::uint64_t kRoomHashOf3 = 0xc7e41b86538767b7;
  const std::uint64_t hash = TypeHash(bytes);
  if (hash != kRoomHashBefore3 && hash != kRoomHashOf3) return 0;
  const std::size_t at = hash == kRoomHashOf3 ? 24 : 20;
  if (bytes.size < at + 4) return 0;
  std::uint32_t protocol = 0;
  for (std::size_t i = 0; i < 4; ++i) protocol = protocol << 8 | bytes.data[at + i];
  const bool known = hash == kRoomHashOf3 ? protocol == 3 : protocol == 1 || protocol == 2;
  return known ? static_cast<std::int32_t>(protocol) : 0;
}

}  // namespace seam
