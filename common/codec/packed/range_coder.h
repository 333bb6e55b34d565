#pragma once
/// An adaptive binary range coder (Martin, "Range encoding: an algorithm for removing redundancy
/// from a digitised message", 1979): writes a decision in as many bits as it is surprising. Writer
/// and reader learn alike what to expect.

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/bytes.h"
#include "common/codec/packed/bits.h"

namespace seam {

/// The expected share of ones among the decisions of one kind. Learns as a mean does, the first
/// ones fast, but forgets all before the last 30.
class BitModel {
 public:
  /// `ones`: 0..1. `weight`: as if so many decisions had been seen, 0..kWeightMax.
  explicit BitModel(double ones = 0.5, int weight = 1)
      : ones_(static_cast<std::uint16_t>(ones * 65535)),
        weight_(static_cast<std::uint16_t>(weight)) {
    Bound();
  }
  std::uint32_t ones() const { return ones_; }
  void Note(bool one) {
    const int off = (one ? 65535 : 0) - ones_;
    ones_ = static_cast<std::uint16_t>(ones_ + off * kShare[weight_] / 65536);
    Bound();
    if (weight_ < kWeightMax) ++weight_;
  }

  static constexpr int kWeightMax = 30;

 private:
  /// 65536 / (weight + 1.5).
  static constexpr std::array<int, kWeightMax + 1> kShare = {
      43690, 26214, 18724, 14563, 11915, 10082, 8738, 7710, 6898, 6241, 5698,
      5242,  4854,  4519,  4228,  3971,  3744,  3542, 3360, 3196, 3048, 2912,
      2788,  2674,  2570,  2473,  2383,  2299,  2221, 2148, 2080};
  /// No decision costs more than 9 bits.
  static constexpr int kOnesMin = 128;
  void Bound() {
    if (ones_ < kOnesMin) ones_ = kOnesMin;
    if (ones_ > 65535 - kOnesMin) ones_ = 65535 - kOnesMin;
  }

  std::uint16_t ones_, weight_;
};

/// What both ends of a range are compared with.
constexpr std::uint32_t kRangeTop = 1u << 24;

/// The last bytes of a stream: the fewest that lie in a range if only zeros follow, which is what a
/// reader reads past the end; `count` 0..4.
struct RangeEnd {
  std::uint64_t value = 0;  ///< these bytes and zeros, 33 bits: with the carry
  int count = 0;
};
inline RangeEnd EndOf(std::uint32_t low, std::uint32_t range) {
  RangeEnd end;
  for (; end.count < 4; ++end.count) {
    const std::uint64_t below = (std::uint64_t{1} << (32 - 8 * end.count)) - 1;
    end.value = (low + below) & ~below;
    if (end.value - low < range) return end;
  }
  end.value = low;
  return end;
}

class RangeWriter {
 public:
  __attribute__((always_inline)) void Put(bool one, BitModel* model) {
    const std::uint32_t ones = (range_ >> 16) * model->ones();
    if (one) {
      range_ = ones;
    } else {
      Add(ones);
      range_ -= ones;
    }
    model->Note(one);
    Normalise();
  }
  /// Writes the lowest `width` bits, 0..64, of which nothing is expected.
  void PutRaw(std::uint64_t value, int width) {
    while (width > 0) {
      const int part = width < 16 ? width : 16;
      width -= part;
      range_ >>= part;
      Add(range_ * static_cast<std::uint32_t>(value >> width & ((1u << part) - 1)));
      Normalise();
    }
  }
  /// Returns an upper bound of the bytes that Finish would return now.
  std::size_t size() const { return bytes_.size() + 4; }
  /// Returns all bytes, and clears the writer.
  Bytes Finish() {
    const RangeEnd end = EndOf(low_, range_);
    if (end.value >> 32 != 0) Carry();
    for (int i = 0; i < end.count; ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(end.value >> (24 - 8 * i)));
    }
    Bytes out = bytes_;
    bytes_.clear();
    low_ = 0;
    range_ = 0xffffffffu;
    return out;
  }

 private:
  void Add(std::uint32_t part) {
    low_ += part;
    if (low_ < part) Carry();
  }
  void Carry() {
    for (std::size_t i = bytes_.size(); i-- > 0 && ++bytes_[i] == 0;) {
    }
  }
  void Normalise() {
    while (range_ < kRangeTop) {
      bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
      low_ <<= 8;
      range_ <<= 8;
    }
  }

  Bytes bytes_;  // its memory is kept
  std::uint32_t low_ = 0, range_ = 0xffffffffu;
};

/// Reads the output of RangeWriter. Past the end it reads zeros, so that decisions come out as
/// true, and is soon no longer ok(): what says that there is more should be true.
class RangeReader {
 public:
  explicit RangeReader(ByteView bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) code_ = code_ << 8 | At(i);
  }

  bool Get(BitModel* model) {
    const std::uint32_t ones = (range_ >> 16) * model->ones();
    const bool one = code_ < ones;
    if (one) {
      range_ = ones;
    } else {
      code_ -= ones;
      range_ -= ones;
    }
    model->Note(one);
    Normalise();
    return one;
  }
  std::uint64_t GetRaw(int width) {
    std::uint64_t value = 0;
    while (width > 0) {
      const int part = width < 16 ? width : 16;
      width -= part;
      range_ >>= part;
      const std::uint32_t most = (1u << part) - 1;
      std::uint32_t taken = code_ / range_;
      if (taken > most) taken = most, astray_ = true;  // no writer comes here
      code_ -= taken * range_;
      value = value << part | taken;
      Normalise();
    }
    return value;
  }
  bool ok() const { return !astray_ && shifted_ <= bytes_.size && code_ < range_; }
  /// Returns true if a writer that has written this has ended with exactly these bytes.
  bool AtEnd() const {
    if (!ok()) return false;
    std::uint32_t told = 0;
    for (int i = 0; i < 4; ++i) told = told << 8 | At(i);
    const RangeEnd end = EndOf(told - code_, range_);
    const std::size_t left = bytes_.size - shifted_;
    return left == static_cast<std::size_t>(end.count) &&
           told == static_cast<std::uint32_t>(end.value);
  }

 private:
  std::uint32_t At(int i) const {
    const std::size_t at = shifted_ + static_cast<std::size_t>(i);
    return at < bytes_.size ? bytes_.data[at] : 0u;
  }
  void Normalise() {
    while (range_ < kRangeTop) {
      code_ = code_ << 8 | At(4);
      range_ <<= 8;
      ++shifted_;
    }
  }

  ByteView bytes_;
  std::size_t shifted_ = 0;  // bytes before the four that code_ began with
  std::uint32_t code_ = 0, range_ = 0xffffffffu;
  bool astray_ = false;
};

/// The expectation of numbers of one kind: whether 0, else how many bits, each learned; the bits
/// below the highest are raw.
class NumberModel {
 public:
  /// `zero`: share of zeros; `width`: usual bits of the others, 1..32.
  explicit NumberModel(double zero = 0.5, int width = 4);

  void Put(std::uint32_t value, RangeWriter* out) {
    out->Put(value == 0, &zero_);
    if (value == 0) return;
    const int width = BitWidth(value);
    std::size_t node = 1;
    for (int bit = kLevels - 1; bit >= 0; --bit) {
      const bool one = ((width - 1) >> bit & 1) != 0;
      out->Put(one, &widths_[node]);
      node = 2 * node + (one ? 1 : 0);
    }
    out->PutRaw(value, width - 1);
  }
  std::uint32_t Get(RangeReader* in) {
    if (in->Get(&zero_)) return 0;
    std::size_t node = 1;
    for (int bit = 0; bit < kLevels; ++bit) node = 2 * node + (in->Get(&widths_[node]) ? 1 : 0);
    const int rest = static_cast<int>(node - kWidths);  // bits below the highest
    return static_cast<std::uint32_t>(std::uint64_t{1} << rest | in->GetRaw(rest));
  }
  /// Signed numbers: the size, then the sign of one that is not 0.
  void PutSigned(std::int32_t value, RangeWriter* out) {
    Put(static_cast<std::uint32_t>(value < 0 ? -static_cast<std::int64_t>(value) : value), out);
    if (value != 0) out->PutRaw(value < 0 ? 1 : 0, 1);
  }
  std::int32_t GetSigned(RangeReader* in) {
    const std::uint32_t size = Get(in);
    const bool minus = size != 0 && in->GetRaw(1) != 0;
    return static_cast<std::int32_t>(minus ? 0u - size : size);
  }

 private:
  static constexpr int kLevels = 5;
  static constexpr std::size_t kWidths = std::size_t{1} << kLevels;

  BitModel zero_;
  std::array<BitModel, kWidths> widths_;  // a binary tree of the width less 1; the first is unused
};

}  // namespace seam
