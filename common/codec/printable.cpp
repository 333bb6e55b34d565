/// Text that messages may carry.

#include "common/codec/validate.h"

namespace seam {
namespace {

/// Returns the length of the UTF-8 sequence at `at`; 0 if it is malformed or a control character.
std::size_t SequenceBytes(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned lead = byte(at);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  unsigned code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xc0u) != 0x80u) return 0;
    code = code << 6 | (byte(at + i) & 0x3fu);
  }
  constexpr unsigned kMin[] = {0, 0, 0xa0, 0x800, 0x10000};  // 0xa0: U+0080..9F are controls
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return code >= kMin[bytes] && code <= 0x10ffff && !surrogate ? bytes : 0;
}

}  // namespace

bool IsPrintable(const std::string& text, std::size_t bytes_max, bool lines) {
  if (text.size() > bytes_max) return false;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const bool line = lines && (c == '\n' || c == '\r' || c == '\t');
    const std::size_t bytes = line ? 1 : SequenceBytes(text, at);
    if (bytes == 0) return false;
    at += bytes;
  }
  return true;
}

}  // namespace seam
