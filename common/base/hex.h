#pragma once
/// Bytes as hexadecimal digits.

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/base/entropy.h"

namespace seam {

inline std::string ToHex(const std::uint8_t* bytes, std::size_t size) {
  static const char kHexDigits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < size; ++i) {
    text += kHexDigits[bytes[i] >> 4];
    text += kHexDigits[bytes[i] & 15];
  }
  return text;
}

/// Returns 32 digits that nobody can guess, from `entropy` of the system.
inline std::string SecretDigits(Entropy& entropy) {
  std::string text;
  for (int word = 0; word < 2; ++word) {
    const std::uint64_t bits = entropy.Next();
    std::uint8_t bytes[sizeof bits];
    for (std::size_t i = 0; i < sizeof bits; ++i)
      bytes[i] = static_cast<std::uint8_t>(bits >> (8 * i) & 255);
    text += ToHex(bytes, sizeof bytes);
  }
  return text;
}

/// Reads exactly `size` bytes from lower-case digits. False if the text is anything else.
inline bool FromHex(const std::string& text, std::uint8_t* bytes, std::size_t size) {
  if (text.size() != 2 * size) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool digit = c >= '0' && c <= '9', letter = c >= 'a' && c <= 'f';
    if (!digit && !letter) return false;
    const int value = digit ? c - '0' : c - 'a' + 10;
    std::uint8_t& byte = bytes[i / 2];
    byte = static_cast<std::uint8_t>(i % 2 == 0 ? value << 4 : byte | value);
  }
  return true;
}

}  // namespace seam
