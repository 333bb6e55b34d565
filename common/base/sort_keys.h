#pragma once
/// Radix sort by a 32-bit key: O(n), not O(n log n), for the thousands of boxes of a plan.

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace seam {

/// Returns an integer that orders like the float; -0 comes before +0.
inline std::uint32_t OrderedBits(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000u;
}

/// A sort key in the high 32 bits, the index of its owner in the low 32 bits.
using SortKey = std::uint64_t;

/// Sorts by key and keeps the order of equal keys (stable). `spare` is scratch memory.
inline void SortByKey(std::vector<SortKey>* keys, std::vector<SortKey>* spare) {
  constexpr int kDigits = 3, kDigitBits = 11;
  constexpr std::uint32_t kMask = (1u << kDigitBits) - 1;
  std::array<std::array<std::uint32_t, 1u << kDigitBits>, kDigits> begin{};
  for (const SortKey key : *keys) {
    for (int digit = 0; digit < kDigits; ++digit) {
      ++begin[static_cast<std::size_t>(digit)][(key >> (32 + digit * kDigitBits)) & kMask];
    }
  }
  spare->resize(keys->size());
  for (int digit = 0; digit < kDigits; ++digit) {
    auto& at = begin[static_cast<std::size_t>(digit)];
    const bool all_alike =
        !keys->empty() && at[(keys->front() >> (32 + digit * kDigitBits)) & kMask] == keys->size();
    if (all_alike) continue;
    std::uint32_t sum = 0;
    for (std::uint32_t& count : at) {
      const std::uint32_t here = count;
      count = sum;
      sum += here;
    }
    for (const SortKey key : *keys) {
      (*spare)[at[(key >> (32 + digit * kDigitBits)) & kMask]++] = key;
    }
    keys->swap(*spare);
  }
}

}  // namespace seam
