#pragma once
/// A set of players, as permissions name it.

#include <cstdint>

namespace seam {

/// Players as bits: bit p is player p.
using PlayerMask = std::uint32_t;
constexpr PlayerMask kEveryPlayer = ~PlayerMask{0};
inline bool Allows(PlayerMask mask, int player) {
  return mask == kEveryPlayer || (player >= 0 && ((mask >> player) & 1U) != 0);
}

}  // namespace seam
