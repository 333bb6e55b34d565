#pragma once
/// A short hash that only the owner of a key can compute: SipHash-2-4 (Aumasson and Bernstein,
/// "SipHash: a fast short-input PRF", 2012), from libsodium. The one door to that library.

#include <array>
#include <cstdint>

#include "common/base/bytes.h"
#include "common/base/entropy.h"

namespace seam {

using HashKey = std::array<std::uint8_t, 16>;

HashKey DrawHashKey(Entropy& entropy);

/// Without the key it cannot be told from random bits, whatever else was hashed with the key.
std::uint64_t KeyedHash(const HashKey& key, ByteView bytes);

}  // namespace seam
