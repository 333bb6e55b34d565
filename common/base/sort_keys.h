#pragma once
/// Sorting by a number, digit by digit: n, not n log n, for the thousands of boxes of a plan.

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace seam {

/// A number that orders like the float; of zeros the negative one comes first.
inline std::uint32_t OrderedBits(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000u;
}

/// A key in the high 32 bits, what it belongs to in the low.
using SortKey = std::uint64_t;

/// Sorts by key; of equal keys those first that came first. `spare` is only for its memory.
inline void SortByKey(std::vector<SortKey>* keys, std::vector<SortKey>* spare) {
  constexpr int kDigits = 3, kBits = 11;
  constexpr std::uint32_t kMask = (1u << kBits) - 1;
  std::array<std::array<std::uint32_t, 1u << kBits>, kDigits> begin{};
  for (const SortKey key : *keys) {
    for (int digit = 0; digit < kDigits; ++digit) {
      ++begin[static_cast<std::size_t>(digit)][(key >> (32 + digit * kBits)) & kMask];
    }
  }
  spare->resize(keys->size());
  for (int digit = 0; digit < kDigits; ++digit) {
    auto& at = begin[static_cast<std::size_t>(digit)];
    const bool all_alike =
        !keys->empty() && at[(keys->front() >> (32 + digit * kBits)) & kMask] == keys->size();
    if (all_alike) continue;
    std::uint32_t sum = 0;
    for (std::uint32_t& count : at) {
      const std::uint32_t here = count;
      count = sum;
      sum += here;
    }
    for (const SortKey key : *keys) {
      (*spare)[at[(key >> (32 + digit * kBits)) & kMask]++] = key;
    }
    keys->swap(*spare);
  }
}

}  // namespace seam
