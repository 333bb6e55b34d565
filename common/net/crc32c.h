#pragma once
/// CRC-32C (Castagnoli; RFC 3720 appendix B.4): detects every burst of up to 32 wrong bits and
/// misses other damage once in 2^32. No protection against forgery.

#include <cstdint>

#include "common/base/bytes.h"

namespace seam {

/// Returns the CRC of `bytes`. `seed` chains calls: Crc32c(b, Crc32c(a)) is the CRC of a then b.
std::uint32_t Crc32c(ByteView bytes, std::uint32_t seed = 0);

}  // namespace seam
