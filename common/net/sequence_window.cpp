#include "common/net/sequence_window.h"

#include <algorithm>

#include "common/base/check.h"

namespace seam {

std::int64_t SequenceWindow::Full(std::uint16_t wire) const {
  return empty_ ? wire : Unwrap(wire, newest_);
}

bool SequenceWindow::Has(std::int64_t number) const {
  if (empty_ || number > newest_ || newest_ - number >= kSize) return false;
  return arrived_[static_cast<std::size_t>(newest_ - number)];
}

bool SequenceWindow::IsNew(std::int64_t number) const {
  if (empty_ || number > newest_) return true;
  return newest_ - number < kSize && !Has(number);
}

void SequenceWindow::Insert(std::int64_t number) {
  SEAM_ASSERT(IsNew(number));
  if (empty_) {
    newest_ = first_ = number;
    empty_ = false;
  }
  if (number > newest_) {
    // Shifting a bitset by its size or more empties it.
    arrived_ <<= static_cast<std::size_t>(std::min(number - newest_, kSize));
    newest_ = number;
  }
  first_ = std::min(first_, number);
  arrived_.set(static_cast<std::size_t>(newest_ - number));
}

std::uint32_t SequenceWindow::BitsBefore(std::int64_t number) const {
  // Numbers beyond the newest have not arrived.
  const std::int64_t age = newest_ - (number - 1);
  if (empty_ || age <= -32 || age >= kSize) return 0;
  const std::bitset<kSize> low32(0xffffffffu);
  if (age < 0) return static_cast<std::uint32_t>((arrived_ & low32).to_ulong() << -age);
  const auto shift = static_cast<std::size_t>(age);
  return static_cast<std::uint32_t>((arrived_ >> shift & low32).to_ulong());
}

std::int64_t SequenceWindow::loss_ppm() const {
  if (empty_) return 0;
  const std::int64_t span = std::min(newest_ - first_ + 1, kSize);
  return (span - static_cast<std::int64_t>(arrived_.count())) * 1'000'000 / span;
}

}  // namespace seam
