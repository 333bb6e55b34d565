#pragma once
/// Compact encoding of integer columns in a review page: zigzag varints (7 bits in a byte, the
/// lowest first) of differences, and runs of equal values. render/page/decode.js decodes them.

#include <cstdint>
#include <vector>

namespace seam {

using PageBytes = std::vector<std::uint8_t>;

/// Appends a zigzag varint: 0, -1, 1, -2, 2 ... become 0, 1, 2, 3, 4 ..., so that small values take
/// one byte.
void PutSigned(PageBytes* out, std::int64_t value);
void PutUnsigned(PageBytes* out, std::uint64_t value);

/// Appends each value as its difference from the straight line through the two before it; the first
/// as it is, the second as a difference. Smooth motion gives bytes of 0 and +-1.
void PutSecondDifferences(PageBytes* out, const std::vector<std::int64_t>& values);
/// Appends each value as its difference from the one before it.
void PutFirstDifferences(PageBytes* out, const std::vector<std::int64_t>& values);
/// Appends the number of runs of equal values, then each run as its length and its value.
void PutRuns(PageBytes* out, const std::vector<std::int64_t>& values);

}  // namespace seam
