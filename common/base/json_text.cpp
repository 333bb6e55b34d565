#include "common/base/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seam {
namespace {

constexpr std::uint32_t kReplacement = 0xfffd;

/// Returns the character at text[*i] and moves *i past it.
std::uint32_t NextCharacter(const std::string& text, std::size_t* i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const std::uint32_t first = byte((*i)++);
  if (first < 0x80) return first;
  const int more = first >= 0xf0 && first < 0xf5 ? 3 : first >= 0xe0 ? 2 : first >= 0xc2 ? 1 : 0;
  if (more == 0 || first >= 0xf5 || *i + static_cast<std::size_t>(more) > text.size())
    return kReplacement;
  std::uint32_t character = first & (0x3fu >> more);
  for (int k = 0; k < more; ++k) {
    const std::uint32_t next = byte(*i + static_cast<std::size_t>(k));
    if ((next & 0xc0) != 0x80) return kReplacement;
    character = character << 6 | (next & 0x3f);
  }
  static const std::uint32_t kLeastOfLength[] = {0, 0x80, 0x800, 0x10000};
  const bool surrogate = character >= 0xd800 && character < 0xe000;
  if (character < kLeastOfLength[more] || character > 0x10ffff || surrogate) return kReplacement;
  *i += static_cast<std::size_t>(more);
  return character;
}

bool Plain(std::uint32_t c) {
  return c >= 0x20 && c < 0x7f && c != '"' && c != '\\' && c != '<' && c != '>' && c != '&' &&
         c != '\'';
}

}  // namespace

std::string JsonText(const std::string& text) {
  std::string json = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const std::uint32_t c = NextCharacter(text, &i);
    if (Plain(c)) {
      json += static_cast<char>(c);
    } else if (c < 0x10000) {
      json += fmt::format("\\u{:04x}", c);
    } else {
      json += fmt::format("\\u{:04x}\\u{:04x}", 0xd800 + ((c - 0x10000) >> 10),
                          0xdc00 + ((c - 0x10000) & 0x3ff));
    }
  }
  return json + "\"";
}

std::string JsonNumber(double value, int digits) {
  if (!std::isfinite(value)) return "null";
  std::string text = fmt::format("{:.{}f}", value, digits);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string JsonNumber(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "null";
}

std::string JsonNumber(const std::optional<double>& value) {
  return value ? JsonNumber(*value) : "null";
}

std::int64_t Thousandths(double value) {
  constexpr double kThousandthsMax = 1e12;  // far beyond any world, and an exact integer
  return std::isfinite(value)
             ? std::llround(std::clamp(value * 1000, -kThousandthsMax, kThousandthsMax))
             : 0;
}

std::string JsonList(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ","));
}

}  // namespace seam
