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

void History::Begin(std::int64_t tick) {
  SEAM_ASSERT(tick >= 0 && (count_ == 0 || tick == newest_ + 1));
  newest_ = tick;
  count_ = std::min(count_ + 1, capacity_);
}

void History::Record(std::int64_t tick, const std::vector<BodyState>& states) {
  SEAM_ASSERT(static_cast<int>(states.size()) == bodies_);
  Begin(tick);
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

void History::Remap(const std::vector<BodyOrigin>& origins, const std::vector<BodyState>& now) {
  SEAM_ASSERT(origins.size() == now.size());
  const int bodies = static_cast<int>(origins.size());
  std::vector<BodyState> ring(static_cast<std::size_t>(bodies) *
                              static_cast<std::size_t>(capacity_));
  for (std::int64_t tick = oldest(); count_ > 0 && tick <= newest_; ++tick) {
    for (int body = 0; body < bodies; ++body) {
      const BodyOrigin& origin = origins[static_cast<std::size_t>(body)];
      BodyState& state = ring[static_cast<std::size_t>((tick % capacity_) * bodies + body)];
      state = origin.body < 0 ? now[static_cast<std::size_t>(body)]
                              : Carried(origin, *At(tick, origin.body));
    }
  }
  ring_ = std::move(ring);
  bodies_ = bodies;
}

}  // namespace seam
