#include "server/delay_history.h"

#include <algorithm>

namespace seam {

std::int64_t DelayHistory::ReadTick(std::int64_t tick) const {
  for (auto at = changes_.rbegin(); std::next(at) != changes_.rend(); ++at) {
    const std::int64_t last_before = at->first - 1 + std::next(at)->second;
    if (tick > last_before) return std::max(at->first - 1, tick - at->second);
  }
  return tick - changes_.front().second;
}

}  // namespace seam
