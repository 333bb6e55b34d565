/// Changes of authority, and how far a displayed body jumps at one.

#include <algorithm>
#include <cmath>
#include <set>

#include "common/measure/parts.h"

namespace seam {
namespace {

/// Calls `act(tick, before, k, now, i)` for each body whose authority differs from the tick before.
template <class Action>
void ForEachChange(const std::map<std::int64_t, View>& views, const Action& act) {
  for (auto now = views.begin(); now != views.end(); ++now) {
    const auto before = views.find(now->first - 1);
    if (before == views.end()) continue;
    for (std::size_t i = 0; i < now->second.id.size(); ++i) {
      const int found = IndexOf(before->second, now->second.id[i]);
      if (found < 0) continue;
      const auto k = static_cast<std::size_t>(found);
      if (before->second.authority[k] == now->second.authority[i]) continue;
      act(now->first, before->second, k, now->second, i);
    }
  }
}

}  // namespace

void MeasureHandover(const Recording& recording, const std::map<PartId, int>& mechanisms,
                     Measures* measures) {
  const double h = TickSeconds(recording);
  for (const auto& [peer, views] : recording.views) {
    ForEachChange(views, [&](std::int64_t, const View& before, std::size_t k, const View& now,
                             std::size_t i) {
      const double dx = double{now.x[i]} - double{before.x[k]} - double{now.vx[i]} * h;
      const double dy = double{now.y[i]} - double{before.y[k]} - double{now.vy[i]} * h;
      measures->handover_jump_m = std::max(measures->handover_jump_m, std::hypot(dx, dy));
    });
  }
  if (recording.views.empty()) return;
  // The server's views, or of the lowest peer there is; a mechanism's bodies change together.
  std::set<std::pair<std::int64_t, int>> changes;
  ForEachChange(recording.views.begin()->second, [&](std::int64_t tick, const View&, std::size_t,
                                                     const View& now, std::size_t i) {
    const auto mechanism = mechanisms.find(now.id[i]);
    changes.insert({tick, mechanism == mechanisms.end() ? -1 - now.id[i] : mechanism->second});
  });
  measures->handovers = static_cast<std::int64_t>(changes.size());
}

}  // namespace seam
