#include "common/codec/packed/range_coder.h"

#include <algorithm>
#include <cstdlib>

namespace seam {
namespace {

constexpr int kWidthLevels = 5;  // of the tree of widths less 1, 0..31
constexpr int kRawMost = 16;     // bits without a model that are coded at once
/// How likely a number is to have so many bits more or less than expected. Whole numbers: all
/// machines must begin alike.
constexpr std::array<std::uint32_t, 16> kWeights{1024, 676, 446, 294, 194, 128, 84, 56,
                                                 37,   24,  16,  11,  7,   5,   3,  2};

}  // namespace

BitModel::BitModel(std::uint32_t zero)
    : zero_(static_cast<std::uint16_t>(
          std::clamp(zero, kProbabilityLeast, kCertain - kProbabilityLeast))) {}

NumberModel::NumberModel(int percent, int bits)
    : zero(Percent(static_cast<std::uint32_t>(percent))) {
  const auto weight = [&](int w) {
    return kWeights[std::min(static_cast<std::size_t>(std::abs(w + 1 - bits)),
                             kWeights.size() - 1)];
  };
  for (int node = 1; node < 32; ++node) {
    const int level = BitWidth(static_cast<std::uint64_t>(node)) - 1;
    const int span = 32 >> level, first = (node - (1 << level)) * span;
    std::uint32_t low = 0, all = 0;
    for (int w = first; w < first + span; ++w) {
      all += weight(w);
      if (w < first + span / 2) low += weight(w);
    }
    width[static_cast<std::size_t>(node)] = BitModel((low << 16) / all);
  }
}

std::uint64_t RangeWriter::Raw(std::uint64_t value, int width) {
  while (width > 0) {
    const int now = std::min(width, kRawMost);
    width -= now;
    range_ >>= now;
    Raise(static_cast<std::uint32_t>(value >> width & ((std::uint64_t{1} << now) - 1)) * range_);
    Normalise();
  }
  return value;
}

std::uint32_t RangeWriter::Code(std::uint32_t value, NumberModel* model) {
  Code(value != 0, &model->zero);
  if (value == 0) return 0;
  const int more = BitWidth(value) - 1;
  std::size_t node = 1;
  for (int level = kWidthLevels - 1; level >= 0; --level) {
    const bool bit = (more >> level & 1) != 0;
    Code(bit, &model->width[node]);
    node = 2 * node + (bit ? 1 : 0);
  }
  if (more == 0) return value;
  Code((value >> (more - 1) & 1) != 0, &model->next[static_cast<std::size_t>(more)]);
  Raw(value, more - 1);
  return value;
}

void RangeWriter::Carry() {
  std::size_t i = bytes_.size();
  while (++bytes_[--i] == 0) {
  }
}

Bytes RangeWriter::Finish() {
  // Any number from low_ on, less than range_ above it, will do: one that ends in most zero bytes,
  // which the reader adds.
  int kept = 1;
  for (; kept < 4; ++kept) {
    const std::uint32_t rest = (std::uint32_t{1} << (32 - 8 * kept)) - 1;
    const std::uint64_t end = (std::uint64_t{low_} + rest) & ~std::uint64_t{rest};
    if (end - low_ < range_) break;
  }
  if (kept < 4) {
    const std::uint32_t rest = (std::uint32_t{1} << (32 - 8 * kept)) - 1;
    Raise(static_cast<std::uint32_t>(((std::uint64_t{low_} + rest) & ~std::uint64_t{rest}) - low_));
  }
  for (; kept > 0; --kept) {
    bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
    low_ <<= 8;
  }
  Bytes out(bytes_);
  bytes_.clear();
  low_ = 0;
  range_ = 0xffffffff;
  return out;
}

std::uint64_t RangeReader::Raw(std::uint64_t, int width) {
  std::uint64_t value = 0;
  while (width > 0) {
    const int now = std::min(width, kRawMost);
    width -= now;
    range_ >>= now;
    const std::uint32_t part =
        std::min(code_ / range_, (std::uint32_t{1} << now) - 1);  // more: no writer's bytes
    code_ -= part * range_;
    value = value << now | part;
    for (; range_ < kRangeLeast; range_ <<= 8) Take();
  }
  return value;
}

std::uint32_t RangeReader::Code(std::uint32_t, NumberModel* model) {
  if (!Code(false, &model->zero)) return 0;
  std::size_t node = 1;
  for (int level = 0; level < kWidthLevels; ++level) {
    node = 2 * node + (Code(false, &model->width[node]) ? 1 : 0);
  }
  const int more = static_cast<int>(node) - 32;
  std::uint32_t value = 1;
  if (more == 0) return value;
  value = 2 + (Code(false, &model->next[static_cast<std::size_t>(more)]) ? 1u : 0u);
  return value << (more - 1) | static_cast<std::uint32_t>(Raw(0, more - 1));
}

}  // namespace seam
