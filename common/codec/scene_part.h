#pragma once
/// A part of a scene on the bus, for scenes that are too long for one message.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/compress.h"
#include "common/codec/message_limits.h"

namespace seam {

/// Bytes of a part, except the last. Larger ones in a row overflow the socket buffer of a stock
/// lcm-logger (212 kB).
constexpr std::size_t kScenePartBytes = 30000;
/// Most parts of a scene.
constexpr std::int32_t kScenePartsMax = static_cast<std::int32_t>(
    (CompressedBytesMax(kSceneTextBytesMax) + kScenePartBytes - 1) / kScenePartBytes);

/// Bus only, from the server: a part of the frame that Compress made of a scene's text. Their Room
/// has no text. Repeated as the Room is, one after another.
struct ScenePart {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t part = 0, parts = 1;
  std::vector<std::uint8_t> data;  ///< kScenePartBytes bytes; of the last part 1 or more
};

}  // namespace seam
