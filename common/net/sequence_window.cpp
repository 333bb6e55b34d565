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
  std::uint32_t bits = 0;
  for (int i = 0; i < 32; ++i) {
    if (Has(number - 1 - i)) bits |= 1u << i;
  }
  return bits;
}

std::int64_t SequenceWindow::loss_ppm() const {
  if (empty_) return 0;
  const std::int64_t span = std::min(newest_ - first_ + 1, kSize);
  return (span - static_cast<std::int64_t>(arrived_.count())) * 1'000'000 / span;
}

}  // namespace seam
