#include "server/console.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace seam {
namespace {

/// Formats bytes as "950 B", "12.3 kB", "4.5 MB".
std::string Amount(std::int64_t bytes) {
  const auto amount = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  return bytes < 1000000 ? fmt::format("{:.1f} kB", amount * 1e-3)
                         : fmt::format("{:.1f} MB", amount * 1e-6);
}

std::string Milliseconds(std::int64_t us) {
  return us < 0 ? "-" : fmt::format("{:.0f} ms", static_cast<double>(us) * 1e-3);
}

std::string Percent(std::int64_t ppm) {
  return ppm < 0 ? "-" : fmt::format("{:.1f} %", static_cast<double>(ppm) * 1e-4);
}

/// Formats session time as "12 of 30 s", or "12 s" without an end.
std::string Time(std::int64_t tick, std::int64_t last_tick, int tick_hz) {
  const double now = static_cast<double>(std::max<std::int64_t>(0, tick)) / tick_hz;
  if (last_tick == 0) return fmt::format("{:.0f} s", now);
  return fmt::format("{:.0f} of {:g} s", now, static_cast<double>(last_tick) / tick_hz);
}

/// Formats "0", or the counts by reason: "12 (10 stale, 2 over budget)".
std::string DropsText(const DropCount& drops) {
  const std::pair<std::int64_t, const char*> reasons[] = {{drops.malformed, "malformed"},
                                                          {drops.stale, "stale"},
                                                          {drops.right, "without right"},
                                                          {drops.implausible, "implausible"},
                                                          {drops.budget, "over budget"}};
  std::string text;
  for (const auto& [count, reason] : reasons) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? " (" : ", ", count, reason);
  }
  return std::to_string(drops.total()) + text + (text.empty() ? "" : ")");
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
                     Milliseconds(stats.rtt_us), Percent(stats.loss_ppm),
                     static_cast<double>(ticks.PercentileUs(0.99)) * 1e-3, Dropped(stats));
}

std::string SessionSummary(const std::vector<ClientAccount>& accounts) {
  const bool any = std::any_of(accounts.begin(), accounts.end(),
                               [](const ClientAccount& account) { return account.sessions > 0; });
  if (!any) return "";
  const auto line = [](const auto&... cells) {
    return fmt::format("  {:<16} {:>4} {:>5} {:>8} {:>8} {:>7} {:>9} {:>9} {:>9} {:>7}\n",
                       cells...);
  };
  std::string table =
      line("client", "peer", "joins", "rtt", "worst", "loss", "in", "out", "corrected", "drops");
  for (const ClientAccount& a : accounts) {
    if (a.sessions == 0) continue;
    const std::int64_t worst_us = a.readings > 0 ? a.rtt_us_max : -1;
    table += line(a.name + (a.player ? "" : " (guest)"), a.peer, a.sessions,
                  Milliseconds(a.rtt_us()), Milliseconds(worst_us), Percent(a.loss_ppm()),
                  Amount(a.bytes_in), Amount(a.bytes_out), a.corrections, DropsText(a.dropped));
  }
  return table;
}

}  // namespace seam
