#include "common/record/events/summary_text.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "common/base/json_text.h"
#include "common/record/events/event_text.h"

namespace seam {
namespace {

const char* HowEnded(const Summary& summary) {
  switch (static_cast<Ended>(summary.ended)) {
    case Ended::kNot: return "so far";
    case Ended::kEnded: return "ended";
    case Ended::kKilled: break;
  }
  return "killed";
}

std::string SessionName(const Summary& summary) {
  return fmt::format("{:016x}", static_cast<std::uint64_t>(summary.of));
}

/// Formats bytes as "950 B", "12.3 kB", "4.5 MB".
std::string Amount(std::int64_t bytes) {
  const auto amount = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  return bytes < 1000000 ? fmt::format("{:.1f} kB", amount * 1e-3)
                         : fmt::format("{:.1f} MB", amount * 1e-6);
}

std::string RoundTrip(std::int32_t us) {
  return us < 0 ? "-" : fmt::format("{:.0f} ms", static_cast<double>(us) * 1e-3);
}

std::string Loss(std::int32_t ppm) {
  return ppm < 0 ? "-" : fmt::format("{:.1f} %", static_cast<double>(ppm) * 1e-4);
}

/// Formats "0", or the counts by reason: "12 (10 stale, 2 over budget)".
std::string Drops(const Summary& summary, std::size_t i) {
  const std::pair<std::int64_t, const char*> reasons[] = {{summary.malformed[i], "malformed"},
                                                          {summary.stale[i], "stale"},
                                                          {summary.right[i], "without right"},
                                                          {summary.implausible[i], "implausible"},
                                                          {summary.budget[i], "over budget"}};
  std::string text;
  std::int64_t total = 0;
  for (const auto& [count, reason] : reasons) {
    total += count;
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? " (" : ", ", count, reason);
  }
  return std::to_string(total) + text + (text.empty() ? "" : ")");
}

double Seconds(std::int64_t ticks, int tick_hz) { return static_cast<double>(ticks) / tick_hz; }

std::string ClientJson(const Summary& s, std::size_t i, const std::string& name, int tick_hz) {
  const auto known = [](std::int32_t value) {
    return value < 0 ? std::string("null") : std::to_string(value);
  };
  return fmt::format(
      R"({{"name":{},"peer":{},"player":{},"joins":{},"rejoins":{},"time_s":{},"score":{},)"
      R"("bytes_in":{},"bytes_out":{},"rtt_us":{},"rtt_worst_us":{},"loss_ppm":{},)"
      R"("corrections":{},"dropped":{{"malformed":{},"stale":{},"right":{},"implausible":{},)"
      R"("budget":{}}},"hand_overs":{},"trust":"{}"}})",
      JsonText(name), s.peer[i], known(s.player[i]), s.joins[i], s.rejoins[i],
      JsonNumber(Seconds(s.present_ticks[i], tick_hz), 6), JsonNumber(double{s.score[i]}),
      s.bytes_in[i], s.bytes_out[i], known(s.rtt_us[i]), known(s.rtt_worst_us[i]),
      known(s.loss_ppm[i]), s.corrections[i], s.malformed[i], s.stale[i], s.right[i],
      s.implausible[i], s.budget[i], s.hand_overs_to[i], TrustStepName(s.trust[i]));
}

}  // namespace

std::vector<std::string> NamesOf(const Summary& summary) {
  std::vector<std::string> names(summary.peer.size());
  std::istringstream text(summary.names);
  for (std::string& name : names) text >> name;
  return names;
}

std::string SummaryTable(const Summary& s, int tick_hz) {
  std::string table = fmt::format(
      "session {} {}: {:.1f} s, {} ticks, {} late, {} edits, {} hand-overs, {} events{}\n",
      SessionName(s), HowEnded(s), Seconds(s.ticks, tick_hz), s.ticks, s.late_ticks, s.edits,
      s.hand_overs, s.events,
      s.events_dropped > 0 ? fmt::format(" and {} dropped", s.events_dropped) : "");
  if (s.peer.empty()) return table;
  const auto line = [](const auto&... cells) {
    return fmt::format(
        "  {:<16} {:>4} {:>5} {:>7} {:>5} {:>6} {:>7} {:>6} {:>8} {:>8} {:>9} {:>5}\n", cells...);
  };
  table += line("client", "peer", "joins", "time", "score", "rtt", "worst", "loss", "in", "out",
                "corrected", "drops");
  const std::vector<std::string> names = NamesOf(s);
  for (std::size_t i = 0; i < names.size(); ++i) {
    table += line(names[i] + (s.player[i] < 0 ? " (guest)" : ""), s.peer[i], s.joins[i],
                  fmt::format("{:.1f} s", Seconds(s.present_ticks[i], tick_hz)),
                  fmt::format("{:g}", s.score[i]), RoundTrip(s.rtt_us[i]),
                  RoundTrip(s.rtt_worst_us[i]), Loss(s.loss_ppm[i]), Amount(s.bytes_in[i]),
                  Amount(s.bytes_out[i]), s.corrections[i], Drops(s, i));
  }
  const std::size_t more = static_cast<std::size_t>(s.clients) - names.size();
  return more == 0 ? table : table + fmt::format("  and {} more\n", more);
}

std::string SummaryJson(const Summary& s, const std::string& room, const std::string& scene,
                        int tick_hz) {
  std::vector<std::string> clients;
  const std::vector<std::string> names = NamesOf(s);
  for (std::size_t i = 0; i < names.size(); ++i) {
    clients.push_back(ClientJson(s, i, names[i], tick_hz));
  }
  return fmt::format(
      R"({{"room":{},"scene":{},"session":"{}","ended":"{}","tick":{},"time_s":{},"ticks":{},)"
      R"("late_ticks":{},"edits":{},"hand_overs":{},"events":{},"events_dropped":{},)"
      R"("clients":{},"players":{}}})",
      JsonText(room), JsonText(scene), SessionName(s), HowEnded(s), s.tick,
      JsonNumber(Seconds(s.ticks, tick_hz), 6), s.ticks, s.late_ticks, s.edits, s.hand_overs,
      s.events, s.events_dropped, s.clients, JsonList(clients));
}

}  // namespace seam
