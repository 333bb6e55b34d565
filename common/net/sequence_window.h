#pragma once
/// Records which of the last 256 sequence numbers have arrived, to detect duplicates and to compute
/// acks and loss.

#include <bitset>
#include <cstdint>

namespace seam {

/// Returns the full number nearest to `reference` with the low 16 bits `wire`.
inline std::int64_t Unwrap(std::uint16_t wire, std::int64_t reference) {
  const auto low = static_cast<std::uint16_t>(reference);
  return reference + static_cast<std::int16_t>(static_cast<std::uint16_t>(wire - low));
}

class SequenceWindow {
 public:
  static constexpr std::int64_t kSize = 256;

  /// Returns the full number of a sequence number read from a datagram.
  std::int64_t Full(std::uint16_t wire) const;
  /// Returns true if the number has not arrived yet and is within the window or ahead of it.
  bool IsNew(std::int64_t number) const;
  /// Marks the number as arrived. Requires IsNew.
  void Insert(std::int64_t number);

  bool empty() const { return empty_; }
  std::int64_t newest() const { return newest_; }
  bool Has(std::int64_t number) const;
  /// Returns a mask; bit i: number - 1 - i has arrived.
  std::uint32_t BitsBefore(std::int64_t number) const;
  /// Returns the share missing of the last 256 numbers (fewer at first), per million.
  std::int64_t loss_ppm() const;
  /// Returns true once 256 numbers have passed: before, a loss of 0 says little.
  bool full() const { return !empty_ && newest_ - first_ + 1 >= kSize; }

 private:
  bool empty_ = true;
  std::int64_t newest_ = 0, first_ = 0;
  std::bitset<kSize> arrived_;  // bit i: newest_ - i
};

}  // namespace seam
