#include "render/canvas/row_checksum.h"

#include <algorithm>
#include <array>

namespace seam {
namespace {

constexpr std::uint32_t kModulus = 65521;
constexpr std::uint32_t kPixels = 8;           ///< pixels of a block
constexpr std::uint32_t kLanes = 4 * kPixels;  ///< bytes of a block
constexpr std::uint32_t kBytes = 3 * kPixels;  ///< bytes of a block that are summed
constexpr std::size_t kBlocksMax = 16;         ///< greatest number whose lane sums fit in 16 bits

using Lanes = std::array<std::uint16_t, kLanes>;

/// For each lane: 1 if its byte is summed, and the number of summed bytes from there to the end of
/// the block.
struct Weights {
  Lanes counts{}, rest{};
  constexpr Weights() {
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      if (i % 4 == 3) continue;
      counts[i] = 1;
      rest[i] = static_cast<std::uint16_t>(kBytes - 3 * (i / 4) - i % 4);
    }
  }
};
constexpr Weights kWeights;

std::uint32_t Product(const Lanes& a, const Lanes& b) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < kLanes; ++i) sum += static_cast<std::uint32_t>(a[i]) * b[i];
  return sum;
}

/// Adds up to kBlocksMax blocks, column by column, in a form that compilers vectorise.
void AddBlocks(const std::uint8_t* rgba, std::uint32_t blocks, RowSum* row) {
  Lanes sums{}, earlier{};
  for (std::uint32_t block = 0; block < blocks; ++block, rgba += kLanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      earlier[i] = static_cast<std::uint16_t>(earlier[i] + sums[i]);
      sums[i] = static_cast<std::uint16_t>(sums[i] + rgba[i]);
    }
  }
  row->weighted = (row->weighted + row->sum * (blocks * kBytes) +
                   kBytes * Product(earlier, kWeights.counts) + Product(sums, kWeights.rest)) %
                  kModulus;
  row->sum = (row->sum + Product(sums, kWeights.counts)) % kModulus;
}

}  // namespace

RowSum SumOf(const std::uint8_t* rgba, std::size_t pixels) {
  RowSum row;
  row.bytes = 3 * pixels;
  while (pixels >= kPixels) {
    const std::size_t blocks = std::min(pixels / kPixels, kBlocksMax);
    AddBlocks(rgba, static_cast<std::uint32_t>(blocks), &row);
    rgba += blocks * kLanes;
    pixels -= blocks * kPixels;
  }
  for (; pixels > 0; --pixels, rgba += 4) {
    for (std::size_t i = 0; i < 3; ++i) {
      row.sum = (row.sum + rgba[i]) % kModulus;
      row.weighted = (row.weighted + row.sum) % kModulus;
    }
  }
  return row;
}

void Adler32::AddByte(std::uint8_t byte) {
  a_ = (a_ + byte) % kModulus;
  b_ = (b_ + a_) % kModulus;
}

void Adler32::AddRow(const RowSum& row) {
  const std::uint64_t from_before = static_cast<std::uint64_t>(a_) * (row.bytes % kModulus);
  b_ = static_cast<std::uint32_t>((b_ + from_before + row.weighted) % kModulus);
  a_ = (a_ + row.sum) % kModulus;
}

}  // namespace seam
