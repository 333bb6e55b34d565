#include "common/sync/inputs/world_pieces.h"

#include <algorithm>
#include <cstring>

#include "common/base/compress.h"

namespace seam {
namespace {

/// The length is written in four bytes, little-endian.
constexpr std::size_t kLengthBytes = sizeof(std::uint32_t);
/// Most bytes of a world before compression.
constexpr std::size_t kWorldBytesMax = std::size_t{1} << 28;

}  // namespace

std::vector<Chunk> ToWorldPieces(ByteView world, std::int64_t now_us) {
  const Bytes packed = Compress(world);
  Bytes all(kLengthBytes);
  const auto length = static_cast<std::uint32_t>(packed.size());
  std::memcpy(all.data(), &length, kLengthBytes);
  all.insert(all.end(), packed.begin(), packed.end());
  if (all.size() > kPackedRoomBytesMax) return {};
  std::vector<Chunk> pieces;
  for (std::size_t at = 0; at < all.size(); at += kChunkBytesMax) {
    const std::size_t end = std::min(all.size(), at + kChunkBytesMax);
    Chunk& piece = pieces.emplace_back();
    piece.utime = now_us;
    piece.offset_bytes = static_cast<std::int32_t>(at);
    piece.data.assign(all.begin() + static_cast<std::ptrdiff_t>(at),
                      all.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return pieces;
}

bool IsWholeWorld(const Bytes& received) {
  std::uint32_t length = 0;
  if (received.size() < kLengthBytes) return false;
  std::memcpy(&length, received.data(), kLengthBytes);
  return received.size() - kLengthBytes >= length;
}

std::optional<Bytes> WorldOf(const Bytes& received) {
  if (received.size() < kLengthBytes) return std::nullopt;
  return Decompress(ByteView(received.data() + kLengthBytes, received.size() - kLengthBytes),
                    kWorldBytesMax);
}

}  // namespace seam
