#include "common/record/time_range.h"

#include <algorithm>
#include <cstdio>

#include "common/base/check.h"

namespace seam {
namespace {

/// Tolerance against losing ticks at the ends to rounding, s.
constexpr double kEndSlack = 1e-6;

double Seconds(std::int64_t tick, int tick_hz) {
  return static_cast<double>(tick) / std::max(1, tick_hz);
}

std::string Digits4(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// Erases the ticks outside the range from maps by peer and tick, and then peers without ticks.
template <class Map, class Keep>
void KeepTicks(Map* by_peer, const Keep& keep) {
  for (auto peer = by_peer->begin(); peer != by_peer->end();) {
    auto& ticks = peer->second;
    for (auto it = ticks.begin(); it != ticks.end();) {
      it = keep(it->first) ? std::next(it) : ticks.erase(it);
    }
    peer = ticks.empty() ? by_peer->erase(peer) : std::next(peer);
  }
}

template <class List, class Keep>
void KeepList(List* list, const Keep& keep) {
  list->erase(std::remove_if(list->begin(), list->end(),
                             [&](const auto& message) { return !keep(message.tick); }),
              list->end());
}

}  // namespace

bool TimeRange::Holds(std::int64_t tick, int tick_hz) const {
  const double at_s = Seconds(tick, tick_hz);
  return !(at_s < from_s - kEndSlack) && !(at_s > to_s + kEndSlack);
}

void RequireRange(const TimeRange& range, const Recording& recording, const std::string& path) {
  if (!range.given()) return;
  if (range.from_s > range.to_s) throw OperatorError("--from must not be after --to");
  const double first_s = Seconds(recording.first_tick, recording.room.tick_hz);
  const double last_s = Seconds(recording.last_tick, recording.room.tick_hz);
  if (range.from_s > last_s + kEndSlack || range.to_s < first_s - kEndSlack) {
    throw OperatorError(path + ": --from and --to leave nothing: it has views of " +
                        Digits4(first_s) + " to " + Digits4(last_s) + " s");
  }
}

void KeepRange(const TimeRange& range, Recording* recording) {
  if (!range.given()) return;
  const int hz = recording->room.tick_hz;
  const auto keep = [&](std::int64_t tick) { return range.Holds(tick, hz); };
  KeepTicks(&recording->views, keep);
  KeepTicks(&recording->view_us, keep);
  KeepTicks(&recording->strands, keep);
  KeepList(&recording->impacts, keep);
  KeepList(&recording->events, keep);
  KeepList(&recording->loads, keep);
  for (auto& [peer, stats] : recording->stats) KeepList(&stats, keep);
  std::int64_t first = 0, last = -1;
  for (const auto& [peer, views] : recording->views) {
    first = last < first ? views.begin()->first : std::min(first, views.begin()->first);
    last = std::max(last, views.rbegin()->first);
  }
  recording->first_tick = first;
  recording->last_tick = last;
}

std::string DamageOf(const Recording& recording) {
  if (recording.skipped_bytes == 0 && recording.undecodable == 0 && recording.bus_gaps == 0) {
    return "";
  }
  return std::to_string(recording.skipped_bytes) + " damaged bytes skipped, " +
         std::to_string(recording.undecodable) + " events undecodable, " +
         std::to_string(recording.bus_gaps) + " messages missing";
}

}  // namespace seam
