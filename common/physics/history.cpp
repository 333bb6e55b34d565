#include "common/physics/history.h"

#include <algorithm>

#include "common/base/check.h"

namespace seam {

History::History(int body_count, int capacity_ticks)
    : bodies_(body_count),
      capacity_(capacity_ticks),
      ring_(static_cast<std::size_t>(body_count) * static_cast<std::size_t>(capacity_ticks)) {
  SEAM_ASSERT(body_count >= 0 && capacity_ticks > 0);
}

void History::Record(std::int64_t tick, const std::vector<BodyState>& states) {
  SEAM_ASSERT(tick >= 0 && (count_ == 0 || tick == newest_ + 1));
  SEAM_ASSERT(static_cast<int>(states.size()) == bodies_);
  newest_ = tick;
  count_ = std::min(count_ + 1, capacity_);
  std::copy(states.begin(), states.end(), ring_.begin() + (tick % capacity_) * bodies_);
}

const BodyState* History::At(std::int64_t tick, int body) const {
  SEAM_ASSERT(body >= 0 && body < bodies_);
  if (count_ == 0 || tick > newest_ || tick <= newest_ - count_) return nullptr;
  return &ring_[static_cast<std::size_t>((tick % capacity_) * bodies_ + body)];
}

BodyState* History::At(std::int64_t tick, int body) {
  return const_cast<BodyState*>(static_cast<const History*>(this)->At(tick, body));
}

std::int64_t History::newest() const { return count_ == 0 ? -1 : newest_; }
std::int64_t History::oldest() const { return count_ == 0 ? -1 : newest_ - count_ + 1; }
void History::Clear() { count_ = 0; }

}  // namespace seam
