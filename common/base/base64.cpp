#include "common/base/base64.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace seam {
namespace {

constexpr char kDigits64[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string ToBase64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool there = at + i < bytes.size();
      group = group << 8 | (there ? static_cast<std::uint8_t>(bytes[at + i]) : 0u);
    }
    const std::size_t digits = std::min<std::size_t>(3, bytes.size() - at) + 1;
    for (std::size_t i = 0; i < 4; ++i) {
      text += i < digits ? kDigits64[group >> (18 - 6 * i) & 63] : '=';
    }
  }
  return text;
}

bool FromBase64(const std::string& text, std::string* bytes) {
  bytes->clear();
  if (text.size() % 4 != 0) return false;
  for (std::size_t at = 0; at < text.size(); at += 4) {
    std::uint32_t group = 0;
    std::size_t digits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const char c = text[at + i];
      const char* const digit = c == '\0' ? nullptr : std::strchr(kDigits64, c);
      if (digit != nullptr && digits == i) ++digits;
      const bool pads = c == '=' && at + 4 == text.size() && i >= 2;
      if (digit == nullptr && !pads) return false;
      if (digit != nullptr && digits != i + 1) return false;  // behind padding
      group = group << 6 | (digit == nullptr ? 0u : static_cast<std::uint32_t>(digit - kDigits64));
    }
    for (std::size_t i = 0; i + 1 < digits; ++i) *bytes += static_cast<char>(group >> (16 - 8 * i));
  }
  return ToBase64(*bytes) == text;
}

}  // namespace seam
