#include "render/canvas/flat_deflate.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "render/canvas/row_checksum.h"

namespace seam {
namespace {

constexpr std::size_t kColours = 3;                 ///< bytes of a pixel in the stream
constexpr std::size_t kLengthMax = 258 / kColours;  ///< pixels of a match; RFC 1951: 3 to 258 bytes
constexpr std::size_t kDeflateWindow = 32768;       ///< bytes of the stream, the furthest match
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

/// Returns the fixed code of a literal, an end or a length (RFC 1951, section 3.2.6).
Code FixedCode(std::uint32_t symbol) {
  if (symbol < 144) return {Reversed(0x30 + symbol, 8), 8};
  if (symbol < 256) return {Reversed(0x190 + symbol - 144, 9), 9};
  if (symbol < 280) return {Reversed(symbol - 256, 7), 7};
  return {Reversed(0xc0 + symbol - 280, 8), 8};
}

/// Joins two codes, one after the other; 32 bits at most.
Code Joined(const Code& first, const Code& then) {
  return {first.bits | (then.bits << first.count), first.count + then.count};
}

/// Returns code and extra bits of a match's length (RFC 1951, section 3.2.5).
Code LengthCode(std::size_t length) {
  if (length == 258) return FixedCode(285);
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
  if (past >= 4) extra = 30 - __builtin_clz(past);
  const std::uint32_t group = static_cast<std::uint32_t>(extra) * 2 + (past >> extra);
  const std::uint32_t rest = past & ((1u << extra) - 1);
  return {Reversed(group, 5) | (rest << 5), 5 + extra};
}

struct Tables {
  std::array<Code, 256> literals;
  std::array<Code, kLengthMax + 1> lengths;  ///< by number of pixels
  Tables() {
    for (std::uint32_t i = 0; i < 256; ++i) literals[i] = FixedCode(i);
    for (std::size_t i = 1; i <= kLengthMax; ++i) lengths[i] = LengthCode(kColours * i);
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
    const auto low = static_cast<std::uint32_t>(held_);
    std::memcpy(out_.data() + end_, &low, sizeof(low));  // little-endian, as the stream is
    end_ += sizeof(low);
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

/// The picture given to FlatDeflate.
struct Pixels {
  const std::uint8_t* rgba;
  std::size_t width, rows;
  const std::uint8_t* At(std::size_t pixel) const { return rgba + 4 * pixel; }
  std::uint32_t One(std::size_t pixel) const {
    std::uint32_t one = 0;
    std::memcpy(&one, At(pixel), sizeof(one));
    return one;
  }
  std::uint64_t Two(std::size_t pixel) const {
    std::uint64_t two = 0;
    std::memcpy(&two, At(pixel), sizeof(two));
    return two;
  }
};

/// Returns the number of equal pixels from `a` on and from `b` on, up to `most`.
std::size_t Equal(const Pixels& pixels, std::size_t a, std::size_t b, std::size_t most) {
  constexpr std::size_t kFew = 8, kMany = 64;  // the library's comparison is best for many
  std::size_t n = 0;
  for (; n + 2 <= most && n < kFew; n += 2) {
    if (pixels.Two(a + n) != pixels.Two(b + n)) break;
  }
  if (n == kFew) {
    while (n + kMany <= most && std::memcmp(pixels.At(a + n), pixels.At(b + n), 4 * kMany) == 0)
      n += kMany;
    while (n + 2 <= most && pixels.Two(a + n) == pixels.Two(b + n)) n += 2;
  }
  return n < most && pixels.One(a + n) == pixels.One(b + n) ? n + 1 : n;
}

/// Finds a long match among three candidates: the pixel before, the row above, and the last place
/// of the same two pixels. In the stream a filter byte precedes each row, and no match crosses it.
class Matcher {
 public:
  explicit Matcher(const Pixels& pixels) : pixels_(pixels) {}

  struct Match {
    std::size_t length = 0;    ///< pixels; 0: none
    std::size_t distance = 0;  ///< bytes of the stream
  };

  /// Returns the match at column `x` of row `row`.
  Match At(std::size_t x, std::size_t row) {
    const std::size_t at = row * pixels_.width + x, left = pixels_.width - x;
    const std::uint32_t pixel = pixels_.One(at);
    Match best;
    if (row > 0 && pixels_.One(at - pixels_.width) == pixel)
      Try(at, at - pixels_.width, left, kColours * pixels_.width + 1, &best);
    if (x > 0 && best.length < kLengthMax && pixels_.One(at - 1) == pixel)
      Try(at, at - 1, left, kColours, &best);
    if (best.length < kShort && left >= 2) TryHash(at, row, left, &best);
    return best;
  }

 private:
  static constexpr std::size_t kShort = 4;  ///< pixels; such a match skips the hash search

  void Try(std::size_t at, std::size_t from, std::size_t most, std::size_t distance,
           Match* best) const {
    if (distance > kDeflateWindow) return;
    const std::size_t length = Equal(pixels_, at, from, most);
    if (length > best->length) *best = {length, distance};
  }

  void TryHash(std::size_t at, std::size_t row, std::size_t left, Match* best) {
    const std::uint64_t two = pixels_.Two(at);
    std::uint32_t& seen = last_[(two * 0x9e3779b97f4a7c15u) >> (64 - kHashBits)];
    const std::size_t from = seen;
    seen = static_cast<std::uint32_t>(at);
    if (at - from > kDeflateWindow / kColours || from >= at || pixels_.Two(from) != two) return;
    const std::size_t from_row = from / pixels_.width;
    const std::size_t most = std::min(left, (from_row + 1) * pixels_.width - from);
    Try(at, from, most, kColours * (at - from) + row - from_row, best);
  }

  Pixels pixels_;
  std::array<std::uint32_t, 1u << kHashBits> last_{};  ///< last place by hash; unverified
};

/// Writes a row's codes: its filter, none, and its pixels. Returns true if it equals the row above.
bool PutRow(const Pixels& pixels, std::size_t row, Matcher* matcher, BitWriter* bits) {
  static const Tables tables;
  bool again = false;
  bits->Put(tables.literals[0]);
  for (std::size_t x = 0; x < pixels.width;) {
    Matcher::Match match = matcher->At(x, row);
    if (match.length == 0) {
      const std::uint8_t* pixel = pixels.At(row * pixels.width + x);
      bits->Put(Joined(Joined(tables.literals[pixel[0]], tables.literals[pixel[1]]),
                       tables.literals[pixel[2]]));
      ++x;
      continue;
    }
    if (match.length == pixels.width && match.distance == kColours * pixels.width + 1) again = true;
    const Code distance = DistanceCode(match.distance);
    x += match.length;
    while (match.length > 0) {
      const std::size_t length = std::min(match.length, kLengthMax);
      bits->Put(Joined(tables.lengths[length], distance));
      match.length -= length;
    }
  }
  return again;
}

}  // namespace

void FlatDeflate(const std::uint8_t* rgba, std::size_t width, std::size_t rows,
                 std::vector<std::uint8_t>* out) {
  const Pixels pixels{rgba, width, rows};
  out->push_back(0x78);  // deflate, window of 32 kB
  out->push_back(0x01);  // fastest
  BitWriter bits(out);
  bits.Put({1, 1});  // the last block
  bits.Put({1, 2});  // of fixed codes
  Matcher matcher(pixels);
  Adler32 sum;
  RowSum row_sum;
  for (std::size_t row = 0; row < rows; ++row) {
    const bool again = PutRow(pixels, row, &matcher, &bits);
    if (!again) row_sum = SumOf(pixels.At(row * width), width);
    sum.AddByte(0);
    sum.AddRow(row_sum);
  }
  bits.Put(FixedCode(256));
  bits.Finish();
  for (int shift = 24; shift >= 0; shift -= 8)
    out->push_back(static_cast<std::uint8_t>(sum.value() >> shift));
}

}  // namespace seam
