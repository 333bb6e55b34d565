#include "render/canvas/flat_deflate.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace seam {
namespace {

constexpr std::size_t kMatchMin = 4, kMatchMax = 258;  ///< bytes; RFC 1951 allows 3 to 258
constexpr std::size_t kWindow = 32768;                 ///< bytes, the furthest match
constexpr std::size_t kPixel = 3;                      ///< bytes
constexpr int kHashBits = 13;

/// A code of the format, its bits in the order of the stream.
struct Code {
  std::uint32_t bits = 0;
  int count = 0;
};

std::uint32_t Reversed(std::uint32_t value, int count) {
  std::uint32_t reversed = 0;
  for (int i = 0; i < count; ++i) reversed |= ((value >> i) & 1u) << (count - 1 - i);
  return reversed;
}

/// The fixed code of a literal, an end or a length (RFC 1951, section 3.2.6).
Code FixedCode(std::uint32_t symbol) {
  if (symbol < 144) return {Reversed(0x30 + symbol, 8), 8};
  if (symbol < 256) return {Reversed(0x190 + symbol - 144, 9), 9};
  if (symbol < 280) return {Reversed(symbol - 256, 7), 7};
  return {Reversed(0xc0 + symbol - 280, 8), 8};
}

/// Code and extra bits of a match's length (RFC 1951, section 3.2.5).
Code LengthCode(std::size_t length) {
  if (length == kMatchMax) return FixedCode(285);
  const auto past = static_cast<std::uint32_t>(length - 3);
  int extra = 0;
  while ((past >> extra) >= 8) ++extra;
  const std::uint32_t group = static_cast<std::uint32_t>(extra) * 4 + (past >> extra);
  const Code code = FixedCode(257 + group);
  const std::uint32_t rest = past & ((1u << extra) - 1);
  return {code.bits | (rest << code.count), code.count + extra};
}

Code DistanceCode(std::size_t distance) {
  const auto past = static_cast<std::uint32_t>(distance - 1);
  int extra = 0;
  while ((past >> extra) >= 4) ++extra;
  const std::uint32_t group = static_cast<std::uint32_t>(extra) * 2 + (past >> extra);
  const std::uint32_t rest = past & ((1u << extra) - 1);
  return {Reversed(group, 5) | (rest << 5), 5 + extra};
}

struct Tables {
  std::array<Code, 256> literals;
  std::array<Code, kMatchMax + 1> lengths;
  Tables() {
    for (std::uint32_t i = 0; i < 256; ++i) literals[i] = FixedCode(i);
    for (std::size_t i = 3; i <= kMatchMax; ++i) lengths[i] = LengthCode(i);
  }
};

class BitWriter {
 public:
  explicit BitWriter(std::vector<std::uint8_t>* out) : out_(*out), end_(out->size()) {}
  void Put(const Code& code) {
    held_ |= static_cast<std::uint64_t>(code.bits) << count_;
    count_ += code.count;
    if (count_ < 32) return;
    Reserve();
    for (int i = 0; i < 4; ++i) out_[end_++] = static_cast<std::uint8_t>(held_ >> (8 * i));
    held_ >>= 32;
    count_ -= 32;
  }
  /// Fills the last byte with zeros.
  void Finish() {
    Reserve();
    for (; count_ > 0; count_ -= 8, held_ >>= 8) out_[end_++] = static_cast<std::uint8_t>(held_);
    out_.resize(end_);
  }

 private:
  void Reserve() {
    if (end_ + 8 > out_.size()) out_.resize(2 * end_ + 4096);
  }
  std::vector<std::uint8_t>& out_;
  std::size_t end_;
  std::uint64_t held_ = 0;
  int count_ = 0;
};

/// Finds the longest match among few candidates. Positions are those of the pixels; in the stream
/// each row has one byte more, before it, and no match goes over it.
class Matcher {
 public:
  Matcher(const std::uint8_t* pixels, std::size_t row_bytes)
      : pixels_(pixels), row_bytes_(row_bytes) {}

  struct Match {
    std::size_t length = 0, distance = 0;  ///< bytes of the stream
  };

  /// At a position of row `row`.
  Match At(std::size_t at, std::size_t row) {
    const std::size_t begin = row * row_bytes_, left = begin + row_bytes_ - at;
    Match best;
    if (at >= begin + kPixel) Try(at, at - kPixel, left, kPixel, &best);
    if (row > 0 && best.length < kMatchMax) {
      Try(at, at - row_bytes_, left, row_bytes_ + 1, &best);
    }
    if (best.length < 3 * kMatchMin && left >= 4) TryHash(at, row, left, &best);
    return best;
  }

 private:
  void Try(std::size_t at, std::size_t from, std::size_t most, std::size_t distance,
           Match* best) const {
    if (distance > kWindow) return;
    const std::size_t length = Equal(at, from, most);
    if (length > best->length) *best = {length, distance};
  }

  void TryHash(std::size_t at, std::size_t row, std::size_t left, Match* best) {
    std::uint32_t four = 0;
    std::memcpy(&four, pixels_ + at, sizeof(four));
    Seen& seen = last_[(four * 2654435761u) >> (32 - kHashBits)];
    if (seen.known) {
      const std::size_t most = std::min(left, (seen.row + 1) * row_bytes_ - seen.at);
      Try(at, seen.at, most, at - seen.at + row - seen.row, best);
    }
    seen = {at, row, true};
  }

  /// How many bytes from `a` on are those from `b` < a on.
  std::size_t Equal(std::size_t a, std::size_t b, std::size_t most) const {
    std::size_t n = 0;
    for (; n + 8 <= most; n += 8) {
      std::uint64_t x = 0, y = 0;
      std::memcpy(&x, pixels_ + a + n, 8);
      std::memcpy(&y, pixels_ + b + n, 8);
      if (x != y) break;
    }
    while (n < most && pixels_[a + n] == pixels_[b + n]) ++n;
    return n;
  }

  /// Where four such bytes were.
  struct Seen {
    std::size_t at = 0, row = 0;
    bool known = false;
  };
  const std::uint8_t* pixels_;
  std::size_t row_bytes_;
  std::array<Seen, 1u << kHashBits> last_{};
};

constexpr std::uint32_t kModulus = 65521;

/// A row's codes: its filter, none, and its bytes.
void PutRow(const std::uint8_t* pixels, std::size_t row, std::size_t row_bytes, Matcher* matcher,
            BitWriter* bits) {
  static const Tables tables;
  bits->Put(tables.literals[0]);
  const std::size_t end = (row + 1) * row_bytes;
  for (std::size_t at = row * row_bytes; at < end;) {
    Matcher::Match match = matcher->At(at, row);
    if (match.length < kMatchMin) {
      bits->Put(tables.literals[pixels[at++]]);
      continue;
    }
    const Code distance = DistanceCode(match.distance);
    while (match.length >= kMatchMin) {
      const std::size_t length = std::min(match.length, kMatchMax);
      bits->Put(tables.lengths[length]);
      bits->Put(distance);
      match.length -= length;
      at += length;
    }
  }
}

}  // namespace

std::uint32_t Adler32(const std::uint8_t* data, std::size_t bytes, std::uint32_t before) {
  constexpr std::size_t kLanes = 32, kRowsMax = 16;  // so few that 16 bits hold a lane's sums
  std::uint32_t a = before & 0xffff, b = before >> 16;
  while (bytes >= kLanes) {  // column by column, in a form that compilers make wide
    const std::size_t rows = std::min(bytes / kLanes, kRowsMax);
    std::array<std::uint16_t, kLanes> sums{}, earlier{};
    for (std::size_t row = 0; row < rows; ++row, data += kLanes) {
      for (std::size_t i = 0; i < kLanes; ++i) {
        earlier[i] = static_cast<std::uint16_t>(earlier[i] + sums[i]);
        sums[i] = static_cast<std::uint16_t>(sums[i] + data[i]);
      }
    }
    b += a * static_cast<std::uint32_t>(rows * kLanes);
    for (std::size_t i = 0; i < kLanes; ++i) {
      a += sums[i];
      b += static_cast<std::uint32_t>(earlier[i] * kLanes + sums[i] * (kLanes - i));
    }
    a %= kModulus;
    b %= kModulus;
    bytes -= rows * kLanes;
  }
  for (std::size_t i = 0; i < bytes; ++i) {
    a = (a + data[i]) % kModulus;
    b = (b + a) % kModulus;
  }
  return b << 16 | a;
}

void FlatDeflate(const std::uint8_t* pixels, std::size_t row_bytes, std::size_t rows,
                 std::vector<std::uint8_t>* out) {
  out->push_back(0x78);  // deflate, window of 32 kB
  out->push_back(0x01);  // fastest
  BitWriter bits(out);
  bits.Put({1, 1});  // the last block
  bits.Put({1, 2});  // of fixed codes
  Matcher matcher(pixels, row_bytes);
  std::uint32_t sum = 1;
  for (std::size_t row = 0; row < rows; ++row) {
    PutRow(pixels, row, row_bytes, &matcher, &bits);
    const std::uint8_t filter = 0;
    sum = Adler32(&filter, 1, sum);
    sum = Adler32(pixels + row * row_bytes, row_bytes, sum);
  }
  bits.Put(FixedCode(256));
  bits.Finish();
  for (int shift = 24; shift >= 0; shift -= 8)
    out->push_back(static_cast<std::uint8_t>(sum >> shift));
}

}  // namespace seam
