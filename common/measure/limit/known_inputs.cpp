/// Finds when a player's inputs are known to other players, by the recording's own times.

#include <algorithm>
#include <vector>

#include "common/measure/limit/held_inputs.h"

namespace seam {
namespace {

/// Arrival times of one player's inputs at the server.
class Arrivals {
 public:
  Arrivals(const std::map<std::int64_t, Inputs>& pieces,
           const std::map<std::int64_t, View>& server_views) {
    std::vector<std::int64_t> ways;
    for (const auto& [first_tick, piece] : pieces) {
      if (piece.drive.empty()) continue;
      const std::int64_t last = first_tick + static_cast<std::int64_t>(piece.drive.size()) - 1;
      newest_.push_back({piece.utime, last});
      const auto view = server_views.find(last);
      if (view != server_views.end()) ways.push_back(piece.utime - view->second.utime);
    }
    std::sort(newest_.begin(), newest_.end());
    for (std::size_t i = 1; i < newest_.size(); ++i) {
      newest_[i].second = std::max(newest_[i].second, newest_[i - 1].second);
    }
    late_us_ = Middle(&ways).value_or(0);
  }

  /// Returns the newest tick that had arrived by then; nullopt: none.
  std::optional<std::int64_t> NewestAt(std::int64_t utime) const {
    const auto after = std::upper_bound(newest_.begin(), newest_.end(),
                                        std::make_pair(utime, std::int64_t{INT64_MAX}));
    if (after == newest_.begin()) return std::nullopt;
    return std::prev(after)->second;
  }
  /// Returns the median time from the server's step of a tick to the arrival of its input; negative
  /// where clients run ahead of the server.
  std::int64_t late_us() const { return late_us_; }

  static std::optional<std::int64_t> Middle(std::vector<std::int64_t>* values) {
    if (values->empty()) return std::nullopt;
    const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
    std::nth_element(values->begin(), middle, values->end());
    return *middle;
  }

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> newest_;  // utime, tick; both ascending
  std::int64_t late_us_ = 0;
};

/// Returns how long after the server a player knows an input, measured to the server's view of the
/// tick that the player shows then: the way back, plus the time by which the player runs ahead.
std::int64_t BehindUs(const Recording& recording, int player, const Arrivals& own) {
  std::vector<std::int64_t> round_trips;
  const auto stats = recording.stats.find(player + 1);  // peer p plays player p - 1
  if (stats != recording.stats.end()) {
    for (const Stats& s : stats->second) {
      if (s.rtt_us > 0) round_trips.push_back(s.rtt_us);
    }
  }
  const std::optional<std::int64_t> round_trip = Arrivals::Middle(&round_trips);
  return std::max<std::int64_t>(0, round_trip ? *round_trip - own.late_us() : own.late_us());
}

}  // namespace

KnownInputs FindKnownInputs(const Recording& recording) {
  const auto server = recording.views.find(0);
  if (server == recording.views.end()) return {};
  std::map<int, Arrivals> arrivals;
  for (const auto& [player, pieces] : recording.inputs) {
    arrivals.emplace(player, Arrivals(pieces, server->second));
  }
  const auto ticks = static_cast<std::size_t>(recording.last_tick + 1);
  KnownInputs known;
  for (const auto& [of, came] : arrivals) {
    for (const auto& [at, own] : arrivals) {
      if (of == at) continue;
      const std::int64_t behind_us = BehindUs(recording, at, own);
      std::vector<std::int64_t>& by_tick = known[{of, at}];
      by_tick.assign(ticks, -1);
      std::int64_t newest = -1;
      for (std::size_t tick = 0; tick < ticks; ++tick) {
        const auto view = server->second.find(static_cast<std::int64_t>(tick));
        // Without a view in the log, the last known tick stays.
        if (view != server->second.end()) {
          newest = came.NewestAt(view->second.utime - behind_us).value_or(-1);
        }
        by_tick[tick] = std::min(newest, static_cast<std::int64_t>(tick));
      }
    }
  }
  return known;
}

}  // namespace seam
