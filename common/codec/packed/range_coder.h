#pragma once
/// Codes bits by what came before them: an adaptive binary range coder (Martin, "Range encoding",
/// 1979; the models as in Witten, Neal and Cleary, "Arithmetic coding for data compression", 1987).
/// A bit that is as its model expects costs a fraction of a bit. Writer and reader adapt alike.

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/bytes.h"
#include "common/codec/packed/bits.h"

namespace seam {

/// The probability that a bit is 0. It learns fast at first, and then from the last 30 bits or so.
class BitModel {
 public:
  BitModel() = default;
  /// `zero`: the probability that is assumed at first, in parts of kCertain.
  explicit BitModel(std::uint32_t zero);
  std::uint32_t zero() const { return zero_; }
  void Note(bool bit) {
    const int rate = kRates[seen_];
    if (seen_ + 1u < kRates.size()) ++seen_;
    if (bit) {
      zero_ = static_cast<std::uint16_t>(zero_ - ((zero_ - kProbabilityLeast) >> rate));
    } else {
      zero_ = static_cast<std::uint16_t>(zero_ + ((kCertain - kProbabilityLeast - zero_) >> rate));
    }
  }

  /// Probabilities are in parts of this, and at least kProbabilityLeast of them.
  static constexpr std::uint32_t kCertain = 65536, kProbabilityLeast = 64;

 private:
  static constexpr std::array<std::uint8_t, 8> kRates{2, 3, 3, 4, 4, 4, 5, 5};
  std::uint16_t zero_ = kCertain / 2;
  std::uint8_t seen_ = 0;
};

/// Returns a probability for BitModel.
constexpr std::uint32_t Percent(std::uint32_t percent) {
  return percent * BitModel::kCertain / 100;
}

/// The distribution of a number: whether it is 0, how many bits it has, and the first of these
/// behind the leading one.
struct NumberModel {
  NumberModel() = default;
  /// Expects 0 with a probability in percent, and other numbers to have about `bits` bits.
  NumberModel(int percent, int bits);

  BitModel zero;
  std::array<BitModel, 32> width;  ///< a binary tree; the first is not used
  std::array<BitModel, 32> next;   ///< by width: the bit behind the leading one
};

/// Writer and reader have the same calls, so that one function says the form of both: the writer
/// returns what it is given, the reader what was written.
class RangeWriter {
 public:
  bool Code(bool bit, BitModel* model) {
    const std::uint32_t bound = (range_ >> 16) * model->zero();
    model->Note(bit);
    if (bit) {
      Raise(bound);
      range_ -= bound;
    } else {
      range_ = bound;
    }
    Normalise();
    return bit;
  }
  std::uint32_t Code(std::uint32_t value, NumberModel* model);
  /// Writes the lowest `width` bits of `value`, of which nothing is known; width 0..64.
  std::uint64_t Raw(std::uint64_t value, int width);
  /// Returns the bytes that are needed at most if nothing more is written.
  std::size_t size() const { return bytes_.size() + 4; }
  /// Returns all bytes, and clears the writer.
  Bytes Finish();

 private:
  void Raise(std::uint32_t by) {
    low_ += by;
    if (low_ < by) Carry();
  }
  void Normalise() {
    for (; range_ < kRangeLeast; range_ <<= 8) {
      bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
      low_ <<= 8;
    }
  }
  void Carry();

  static constexpr std::uint32_t kRangeLeast = 1u << 24;
  Bytes bytes_;
  std::uint32_t low_ = 0, range_ = 0xffffffff;
};

/// Reads the output of RangeWriter. What it returns past the end is without meaning, and it is no
/// longer ok().
class RangeReader {
 public:
  explicit RangeReader(ByteView bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) Take();
  }
  bool Code(bool, BitModel* model) {
    const std::uint32_t bound = (range_ >> 16) * model->zero();
    const bool bit = code_ >= bound;
    model->Note(bit);
    if (bit) {
      code_ -= bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    for (; range_ < kRangeLeast; range_ <<= 8) Take();
    return bit;
  }
  std::uint32_t Code(std::uint32_t, NumberModel* model);
  std::uint64_t Raw(std::uint64_t, int width);
  /// False once it has read past the end. The writer leaves out up to three zero bytes.
  bool ok() const { return at_ <= bytes_.size + 3; }
  /// Returns true if all bytes, and no more, were needed.
  bool AtEnd() const {
    if (!ok() || at_ < bytes_.size || bytes_.size == 0) return false;
    return bytes_.data[bytes_.size - 1] != 0 || at_ == bytes_.size + 3;
  }

 private:
  void Take() {
    code_ = code_ << 8 | (at_ < bytes_.size ? bytes_.data[at_] : 0u);
    ++at_;
  }

  static constexpr std::uint32_t kRangeLeast = 1u << 24;
  ByteView bytes_;
  std::size_t at_ = 0;  // bytes read, may exceed the end
  std::uint32_t code_ = 0, range_ = 0xffffffff;
};

}  // namespace seam
