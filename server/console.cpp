#include "server/console.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace seam {
namespace {

std::string Milliseconds(std::int64_t us) {
  return us < 0 ? "-" : fmt::format("{:.0f} ms", static_cast<double>(us) * 1e-3);
}

std::string PercentText(std::int64_t ppm) {
  return ppm < 0 ? "-" : fmt::format("{:.1f} %", static_cast<double>(ppm) * 1e-4);
}

/// Formats session time as "12 of 30 s", or "12 s" without an end.
std::string Time(std::int64_t tick, std::int64_t last_tick, int tick_hz) {
  const double now = static_cast<double>(std::max<std::int64_t>(0, tick)) / tick_hz;
  if (last_tick == 0) return fmt::format("{:.0f} s", now);
  return fmt::format("{:.0f} of {:g} s", now, static_cast<double>(last_tick) / tick_hz);
}

}  // namespace

std::string MissingPlayers(const Server& server) {
  constexpr std::size_t kMissingNamed = 3;
  const std::vector<std::string> missing = server.missing();
  // One name more is as short as "and 1 more".
  const std::size_t named = missing.size() <= kMissingNamed + 1 ? missing.size() : kMissingNamed;
  std::string names;
  for (std::size_t i = 0; i < named; ++i) names += (i == 0 ? "" : ", ") + missing[i];
  if (named == missing.size()) return names;
  return names + fmt::format(" and {} more", missing.size() - named);
}

std::string ServerProgress(const Server& server, std::int64_t last_tick,
                           const DurationHistogram& ticks) {
  const std::size_t players = server.scene().players.size();
  const std::string missing = MissingPlayers(server);
  const std::string who = fmt::format("{} of {} players{}", server.player_count(), players,
                                      missing.empty() ? "" : " (" + missing + " missing)");
  if (!server.started()) return "waiting: " + who + "; Ctrl-C stops";
  const Stats& stats = server.stats();
  return fmt::format("{}, {}, rtt {}, loss {}, tick p99 {:.2f} ms, {} drops; Ctrl-C stops",
                     Time(server.tick(), last_tick, server.scene().solver.tick_hz), who,
                     Milliseconds(stats.rtt_us), PercentText(stats.loss_ppm),
                     static_cast<double>(ticks.PercentileUs(0.99)) * 1e-3, Dropped(stats));
}

}  // namespace seam
