#pragma once
/// Numbers as bits, the most significant of a byte first: fixed widths and exponential Golomb codes
/// (Teuhola, "A Compression Method for Clustered Bit-Vectors", 1978) whose parameter learns.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/base/bytes.h"

namespace seam {

/// Bits that a number needs: 0 of 0.
inline int BitWidth(std::uint64_t value) { return value == 0 ? 0 : 64 - __builtin_clzll(value); }

/// Signed numbers in the order 0, -1, 1, -2, ...
inline std::uint32_t ZigZag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ (value < 0 ? 0xffffffffu : 0u);
}
inline std::int32_t UnZigZag(std::uint32_t code) {
  return static_cast<std::int32_t>((code >> 1) ^ ((code & 1u) != 0 ? 0xffffffffu : 0u));
}

class BitWriter {
 public:
  /// Of `value` the lowest `width` bits; 0..32.
  void Put(std::uint64_t value, int width) {
    held_ = held_ << width | (value & ((std::uint64_t{1} << width) - 1));
    bits_ += width;
    if (bits_ >= 32) PutHeld();
  }
  /// `value` in exponential Golomb code with parameter `k`, 0..16: k + 1 bits if it is below 2^k.
  __attribute__((always_inline)) void PutGolomb(std::uint32_t value, int k) {
    const std::uint64_t shifted = value + (std::uint64_t{1} << k);
    const int rest = BitWidth(shifted) - 1;  // bits behind the leading one
    const int zeros = rest - k;
    if (__builtin_expect(zeros + 1 + rest <= 32, 1)) return Put(shifted, zeros + 1 + rest);
    Put(0, zeros);
    Put(shifted >> rest, 1);
    Put(shifted, rest);
  }
  /// Bytes so far, with the last begun one.
  std::size_t size() const { return size_ + static_cast<std::size_t>(bits_ + 7) / 8; }
  /// All of it, the last byte filled with zeros; begins anew.
  Bytes Finish() {
    const std::size_t bytes = size();
    Put(0, (32 - bits_) % 32);
    Bytes out(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(bytes));
    size_ = 0;
    return out;
  }

 private:
  /// Four bytes at once: one at a time is most of what packing costs.
  __attribute__((noinline)) void PutHeld() {
    bits_ -= 32;
    if (bytes_.size() < size_ + 4) bytes_.resize(2 * size_ + 64);
    const std::uint64_t four = held_ >> bits_;
    for (int i = 0; i < 4; ++i) {
      bytes_[size_ + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(four >> (24 - 8 * i));
    }
    size_ += 4;
  }

  Bytes bytes_;             // its first size_ are written; it keeps its memory
  std::size_t size_ = 0;    // a multiple of four
  std::uint64_t held_ = 0;  // its lowest bits_ are not in bytes_ yet
  int bits_ = 0;            // below 32
};

/// Reads what BitWriter wrote; past the end it reads zeros and is no longer ok().
class BitReader {
 public:
  explicit BitReader(ByteView bytes) : bytes_(bytes) {}

  /// 0..32 bits.
  std::uint32_t Get(int width) {
    while (bits_ < width) {
      held_ = held_ << 8 | (at_ < bytes_.size ? bytes_.data[at_] : 0u);
      ++at_;
      bits_ += 8;
    }
    bits_ -= width;
    return static_cast<std::uint32_t>(held_ >> bits_ & ((std::uint64_t{1} << width) - 1));
  }
  std::uint32_t GetGolomb(int k) {
    int rest = k;
    while (Get(1) == 0) {
      if (++rest > kRestMax) return Fail();
    }
    const std::uint64_t shifted = std::uint64_t{1} << rest | Get(rest);
    const std::uint64_t value = shifted - (std::uint64_t{1} << k);
    return value > 0xffffffffu ? Fail() : static_cast<std::uint32_t>(value);
  }
  bool ok() const { return ok_ && at_ <= bytes_.size; }
  /// Whether nothing is left but the zeros that fill the last byte.
  bool AtEnd() const {
    return ok() && at_ == bytes_.size && (held_ & ((std::uint64_t{1} << bits_) - 1)) == 0;
  }

 private:
  static constexpr int kRestMax = 32;
  std::uint32_t Fail() {
    ok_ = false;
    return 0;
  }

  ByteView bytes_;
  std::size_t at_ = 0;      // bytes taken, also past the end
  std::uint64_t held_ = 0;  // its lowest bits_ were not given yet
  int bits_ = 0;            // below 8 between calls
  bool ok_ = true;
};

/// A Golomb parameter that goes towards the middle width of what was coded: a rare large number
/// hardly moves it. Writer and reader learn alike.
class Learned {
 public:
  explicit Learned(int k) : quarters_(4 * k + 2) {}
  int k() const { return quarters_ / 4; }
  void Note(std::uint32_t value) {
    const int width = BitWidth(value), now = k();
    if (width > now) quarters_ = std::min(quarters_ + 1, 4 * kMost + 3);
    if (width < now) --quarters_;
  }

 private:
  static constexpr int kMost = 16;
  int quarters_;
};

}  // namespace seam
