#pragma once
/// Compression by zstd. Its .cpp is the only file that includes <zstd.h>.

#include <cstddef>
#include <optional>

#include "common/base/bytes.h"

namespace seam {

/// Returns the largest size that Compress makes of so many bytes.
constexpr std::size_t CompressedBytesMax(std::size_t bytes) { return bytes + bytes / 256 + 64; }

/// Returns one zstd frame that says the size of its content and ends with a checksum.
Bytes Compress(ByteView content);

/// Returns the content of a frame of Compress. Returns nullopt, before it allocates anything,
/// unless the bytes are one frame that claims a content of 1 to `bytes_max` bytes; and nullopt if
/// the content is damaged or has another size than claimed.
std::optional<Bytes> Decompress(ByteView frame, std::size_t bytes_max);

}  // namespace seam
