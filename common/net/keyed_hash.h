#pragma once
/// A short keyed hash: SipHash-2-4 (Aumasson and Bernstein, "SipHash: a fast short-input PRF",
/// 2012), from libsodium.

#include <array>
#include <cstdint>

#include "common/base/bytes.h"
#include "common/base/entropy.h"

namespace seam {

using HashKey = std::array<std::uint8_t, 16>;

HashKey DrawHashKey(Entropy& entropy);

/// Returns the hash. Without the key it is indistinguishable from random bits, even to an observer
/// of other hashes with that key.
std::uint64_t KeyedHash(const HashKey& key, ByteView bytes);

}  // namespace seam
