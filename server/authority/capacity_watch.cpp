#include "server/authority/capacity_watch.h"

#include <algorithm>

#include "server/authority/plan.h"

namespace seam {

int CapacityWatch::Look(std::size_t player, std::int64_t now_us, int peer, float load,
                        const std::function<int()>& steps) {
  if (seen_.size() <= player) seen_.resize(player + 1);
  Seen& seen = seen_[player];
  if (seen.peer != peer) seen = {peer, 0, 0};
  const auto answer = [&] {
    return seen.bodies > 0 ? static_cast<int>(seen.bodies) : PlayerView::kUnlimited;
  };
  const bool limited = seen.bodies > 0;
  if (peer <= 0 || load < 0 || (!limited && load <= kFull)) return answer();
  if (limited && now_us - seen.changed_us < kSettleUs) return answer();
  const auto now = static_cast<float>(std::max(1, steps()));
  const float factor = std::clamp(kTarget / std::max(load, 0.01f), kFactorMin, kFactorMax);
  seen.changed_us = now_us;
  if (factor <= 1) {
    seen.bodies = std::max(1.0f, now * factor);
    return answer();
  }
  seen.bodies *= factor;
  // Its capacity is more than twice its bodies: it is no longer limited.
  if (seen.bodies > 2 * now) seen.bodies = 0;
  return answer();
}

}  // namespace seam
