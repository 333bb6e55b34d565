#include "server/sessions/room_chunks.h"

#include <algorithm>

#include "common/base/compress.h"
#include "common/codec/codec.h"

namespace seam {
namespace {

/// A session that never gets ready is dropped after this, us, and the time for the room.
constexpr std::int64_t kHalfOpenUs = 10000000;
/// That time, us for each byte on its way: a line of 1 kB/s.
constexpr std::int64_t kUsPerRoomByte = 1000;
/// Time to parse a scene, us for each byte: a tenth of the speed that is usual.
constexpr std::int64_t kUsPerSceneByte = 10;
/// Messages of the room that wait at a session's link: more than a link sends ahead of its
/// acknowledgements, and a small part of the room.
constexpr std::size_t kRoomAhead = 96;
static_assert(kRoomAhead * kChunkBytesMax > kReliableWindowBytes);

}  // namespace

RoomChunks::RoomChunks(const Bytes& room)
    : bytes_(Compress(room)), load_us_(kUsPerSceneByte * static_cast<std::int64_t>(room.size())) {}

void RoomChunks::SendAhead(std::int64_t now_us, Link* link, std::size_t* sent) const {
  while (*sent < bytes_.size() && link->waiting() < kRoomAhead) {
    const std::size_t end = std::min(bytes_.size(), *sent + kChunkBytesMax);
    Chunk chunk;
    chunk.utime = now_us;
    chunk.offset_bytes = static_cast<std::int32_t>(*sent);
    chunk.data.assign(bytes_.begin() + static_cast<std::ptrdiff_t>(*sent),
                      bytes_.begin() + static_cast<std::ptrdiff_t>(end));
    link->SendReliable(Encode(chunk));
    *sent = end;
  }
}

std::int64_t RoomChunks::ReadyByUs(std::int64_t created_us) const {
  return created_us + kHalfOpenUs + kUsPerRoomByte * static_cast<std::int64_t>(bytes_.size()) +
         load_us_;
}

}  // namespace seam
