/// Measures at rest: time until all peers show the same poses, and jitter of displayed bodies.

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/measure/mean_square.h"
#include "common/measure/parts.h"

namespace seam {
namespace {

/// A body slower than this is at rest, m/s.
constexpr float kStillSpeed = 0.01f;
/// Least time for which the oracle must be at rest at its end, s.
constexpr double kRestMin = 0.5;
/// Views may still move for this time after the oracle's rest, because of the network: s.
constexpr double kSettle = 0.5;

bool AllSlow(const std::vector<BodyState>& states) {
  return std::all_of(states.begin(), states.end(),
                     [](const BodyState& state) { return state.velocity.norm() < kStillSpeed; });
}

template <class T>
bool SameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool SamePoses(const View& a, const View& b) {
  return SameBits(a.id, b.id) && SameBits(a.x, b.x) && SameBits(a.y, b.y) &&
         SameBits(a.angle, b.angle);
}

/// Returns the views of all peers at one tick.
std::vector<const View*> ViewsAt(const Recording& recording, std::int64_t tick) {
  std::vector<const View*> views;
  for (const auto& [peer, of_peer] : recording.views) {
    const auto found = of_peer.find(tick);
    if (found != of_peer.end()) views.push_back(&found->second);
  }
  return views;
}

/// Returns the tick from which the oracle is at rest until its end, if that is at least kRestMin
/// within the recording.
std::optional<std::int64_t> OraclesRest(const Recording& recording, const Oracle& oracle) {
  std::int64_t rest = oracle.first_tick + static_cast<std::int64_t>(oracle.ticks.size());
  const std::int64_t oracle_end = std::min(rest - 1, recording.last_tick);
  while (rest > oracle.first_tick &&
         AllSlow(oracle.ticks[static_cast<std::size_t>(rest - 1 - oracle.first_tick)])) {
    --rest;
  }
  if (static_cast<double>(oracle_end - rest) * TickSeconds(recording) < kRestMin) {
    return std::nullopt;
  }
  return rest;
}

}  // namespace

std::optional<double> RestTicks(const Recording& recording, const Oracle& oracle) {
  const std::optional<std::int64_t> rests = OraclesRest(recording, oracle);
  if (!rests) return std::nullopt;
  const std::int64_t rest = *rests;
  // Backwards from the end for as long as all existing views are equal.
  std::int64_t equal_since = recording.last_tick + 1;
  bool compared = false;
  for (std::int64_t tick = recording.last_tick; tick >= rest; --tick) {
    const std::vector<const View*> views = ViewsAt(recording, tick);
    const bool equal = std::all_of(views.begin(), views.end(), [&](const View* view) {
      return SamePoses(*views.front(), *view);
    });
    if (!equal) break;
    compared = compared || views.size() > 1;
    equal_since = tick;
  }
  if (!compared) return std::nullopt;
  return static_cast<double>(equal_since - rest);
}

std::optional<double> RestJitter(const Recording& recording, const Oracle& oracle) {
  const std::optional<std::int64_t> rest = OraclesRest(recording, oracle);
  if (!rest) return std::nullopt;
  const double h = TickSeconds(recording);
  const std::int64_t begin = *rest + std::llround(kSettle / h);
  MeanSquare speed;
  for (const auto& [peer, views] : recording.views) {
    for (auto now = views.upper_bound(begin); now != views.end(); ++now) {
      const auto before = views.find(now->first - 1);
      if (before == views.end()) continue;
      for (std::size_t i = 0; i < now->second.id.size(); ++i) {
        const int k = IndexOf(before->second, now->second.id[i]);
        if (k < 0 || !oracle.At(now->first, now->second.id[i])) continue;
        const auto index = static_cast<std::size_t>(k);
        const double dx = double{now->second.x[i]} - double{before->second.x[index]};
        const double dy = double{now->second.y[i]} - double{before->second.y[index]};
        speed.Add((dx * dx + dy * dy) / (h * h));
      }
    }
  }
  return speed.Root();
}

}  // namespace seam
