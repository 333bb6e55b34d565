#pragma once
/// Big-endian numbers in datagrams.

#include <cstdint>

namespace seam {

/// Writes the low `bytes` bytes of a number.
inline void PutNumber(std::uint8_t* at, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<std::uint8_t>(value >> (8 * (bytes - 1 - i)));
}

inline std::uint64_t GetNumber(const std::uint8_t* at, int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value = (value << 8) | at[i];
  return value;
}

}  // namespace seam
