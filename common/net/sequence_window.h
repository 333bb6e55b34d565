#pragma once
/// Which of the last 256 sequence numbers have arrived: duplicates, acks and loss come from it.

#include <bitset>
#include <cstdint>

namespace seam {

/// The full number nearest to `reference` whose low 16 bits are `wire`.
inline std::int64_t Unwrap(std::uint16_t wire, std::int64_t reference) {
  const auto low = static_cast<std::uint16_t>(reference);
  return reference + static_cast<std::int16_t>(static_cast<std::uint16_t>(wire - low));
}

class SequenceWindow {
 public:
  static constexpr std::int64_t kSize = 256;

  /// The full number of a sequence number just read.
  std::int64_t Full(std::uint16_t wire) const;
  /// It has not arrived yet and is not too old to know.
  bool IsNew(std::int64_t number) const;
  /// Notes that it has. Requires IsNew.
  void Insert(std::int64_t number);

  bool empty() const { return empty_; }
  std::int64_t newest() const { return newest_; }
  bool Has(std::int64_t number) const;
  /// Bit i: number - 1 - i has arrived.
  std::uint32_t BitsBefore(std::int64_t number) const;
  /// Missing per million of the last 256 (fewer at first).
  std::int64_t loss_ppm() const;

 private:
  bool empty_ = true;
  std::int64_t newest_ = 0, first_ = 0;
  std::bitset<kSize> arrived_;  // bit i: newest_ - i
};

}  // namespace seam
