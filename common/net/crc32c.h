#pragma once
/// CRC-32C (Castagnoli; RFC 3720 appendix B.4): finds every burst of up to 32 wrong bits, and
/// misses other damage once in 2^32. It is no protection against someone who forges.

#include <cstdint>

#include "common/base/bytes.h"

namespace seam {

/// Of all of `bytes`; `seed` chains calls: Crc32c(b, Crc32c(a)) is that of a then b.
std::uint32_t Crc32c(ByteView bytes, std::uint32_t seed = 0);

}  // namespace seam
