#pragma once
/// Writes and reads numbers as bits, most significant bit first: fixed widths and exponential
/// Golomb codes (Teuhola, "A Compression Method for Clustered Bit-Vectors", 1978).

#include <cstddef>
#include <cstdint>

#include "common/base/bytes.h"

namespace seam {

/// Returns the number of significant bits; 0 for 0.
inline int BitWidth(std::uint64_t value) { return value == 0 ? 0 : 64 - __builtin_clzll(value); }

/// Maps signed numbers 0, -1, 1, -2, ... to 0, 1, 2, 3, ...
inline std::uint32_t ZigZag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ (value < 0 ? 0xffffffffu : 0u);
}
inline std::int32_t UnZigZag(std::uint32_t code) {
  return static_cast<std::int32_t>((code >> 1) ^ ((code & 1u) != 0 ? 0xffffffffu : 0u));
}

class BitWriter {
 public:
  /// Writes the lowest `width` bits of `value`; width 0..32.
  void Put(std::uint64_t value, int width) {
    held_ = held_ << width | (value & ((std::uint64_t{1} << width) - 1));
    bits_ += width;
    if (bits_ >= 32) PutHeld();
  }
  /// Writes `value` in exponential Golomb code with parameter `k`, 0..16: k + 1 bits if below 2^k.
  __attribute__((always_inline)) void PutGolomb(std::uint32_t value, int k) {
    const std::uint64_t shifted = value + (std::uint64_t{1} << k);
    const int rest = BitWidth(shifted) - 1;  // bits after the leading one
    const int zeros = rest - k;
    if (__builtin_expect(zeros + 1 + rest <= 32, 1)) return Put(shifted, zeros + 1 + rest);
    Put(0, zeros);
    Put(shifted >> rest, 1);
    Put(shifted, rest);
  }
  /// Returns the bytes so far, including an incomplete last one.
  std::size_t size() const { return size_ + static_cast<std::size_t>(bits_ + 7) / 8; }
  /// Returns all bytes, the last one padded with zeros, and clears the writer.
  Bytes Finish() {
    const std::size_t bytes = size();
    Put(0, (32 - bits_) % 32);
    Bytes out(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(bytes));
    size_ = 0;
    return out;
  }

 private:
  /// Stores four bytes at once: one at a time would be most of the cost of packing.
  __attribute__((noinline)) void PutHeld() {
    bits_ -= 32;
    if (bytes_.size() < size_ + 4) bytes_.resize(2 * size_ + 64);
    const std::uint64_t four = held_ >> bits_;
    for (int i = 0; i < 4; ++i) {
      bytes_[size_ + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(four >> (24 - 8 * i));
    }
    size_ += 4;
  }

  Bytes bytes_;             // the first size_ are written; memory is kept
  std::size_t size_ = 0;    // a multiple of four
  std::uint64_t held_ = 0;  // the lowest bits_ are not in bytes_ yet
  int bits_ = 0;            // below 32
};

/// Reads the output of BitWriter. Past the end it returns zeros and is no longer ok().
class BitReader {
 public:
  explicit BitReader(ByteView bytes) : bytes_(bytes) {}

  /// Reads `width` bits, 0..32.
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
  /// Returns true if only the zero padding of the last byte is left.
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
  std::size_t at_ = 0;      // bytes read, may exceed the end
  std::uint64_t held_ = 0;  // the lowest bits_ are not returned yet
  int bits_ = 0;            // below 8 between calls
  bool ok_ = true;
};

}  // namespace seam
