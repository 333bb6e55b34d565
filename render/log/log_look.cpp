/// seam-log: list, verify and stats.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "common/base/check.h"
#include "common/net/secret_file.h"
#include "common/record/damage.h"
#include "common/record/log_file.h"
#include "common/record/log_sessions.h"
#include "common/record/loss_timeline.h"
#include "render/log/log_check.h"
#include "render/log/log_commands.h"

namespace seam {
namespace {

/// A channel of a session.
struct ChannelSum {
  std::int64_t events = 0, bytes = 0, largest = 0;
  std::int64_t last_us = 0, pause_us = 0;  ///< the longest between two events
};

void PrintHead() {
  std::printf("%-12s %3s  %-16s  %-16s %-20s %9s  %-12s  %8s  %12s  %8s\n", "room", "#", "session",
              "scene", "method", "duration", "", "messages", "bytes", "events");
}

/// Returns the number of sessions. `head`: a line above the first.
int PrintSessions(const std::string& path, const std::string& room,
                  const std::map<std::int64_t, SessionSpan>& spans, bool head) {
  int number = 0;
  for (const LogSession& session : ListSessions(path, room)) {
    const auto found = spans.find(session.id);
    const SessionSpan span = found == spans.end() ? SessionSpan() : found->second;
    const Room& is = session.room;
    if (head && number == 0) PrintHead();
    const std::string method = is.mode + (is.reconcile.empty() ? "" : "/" + is.reconcile);
    std::printf(
        "%-12s %3d  %016llx  %-16s %-20s %7.1f s  ticks %lld..%lld  %8lld  %9.1f kB  %8lld\n",
        room.c_str(), ++number, static_cast<unsigned long long>(session.id), is.scene_name.c_str(),
        method.c_str(), static_cast<double>(span.us.length()) * 1e-6,
        static_cast<long long>(span.ticks.empty() ? 0 : span.ticks.first()),
        static_cast<long long>(span.ticks.empty() ? -1 : span.ticks.last()),
        static_cast<long long>(span.events), static_cast<double>(span.bytes) * 1e-3,
        static_cast<long long>(span.happened));
  }
  return number;
}

/// Returns what the line of a whole log says of its begin.
std::string AboutBegin(const LogCheck& check) {
  if (!check.begins_after) return "";
  return "; what precedes tick " + std::to_string(*check.begins_after + 1) + " is not in it";
}

}  // namespace

int RunLogList(const LogsCommand& command) {
  int status = 0;
  for (const std::string& path : command.logs) {
    const LogCheck check = CheckLog(path);
    std::printf("%s: %lld events, %.1f kB%s\n", path.c_str(), static_cast<long long>(check.events),
                static_cast<double>(check.bytes) * 1e-3, check.damaged() ? ", damaged" : "");
    int sessions = 0;
    for (const auto& [room, spans] : check.rooms) {
      sessions += PrintSessions(path, room, spans, sessions == 0);
    }
    if (sessions == 0) throw OperatorError(path + ": " + WhyNoRoom("", !check.rooms.empty()));
    status = check.damaged() ? 1 : status;
  }
  return status;
}

int RunLogVerify(const LogVerifyCommand& command) {
  int status = 0;
  std::optional<Secret> key;
  if (!command.log_key.empty()) key = ReadSecretFile("--log-key", command.log_key);

  for (const std::string& path : command.logs) {
    const LogCheck check = CheckLog(path, key ? &*key : nullptr);
    if (check.damaged()) {
      status = 1;
      for (const std::string& line : LinesOf(check)) {
        std::printf("%s: %s\n", path.c_str(), line.c_str());
      }
    } else if (check.missing > 0) {
      status = 1;
      std::printf(
          "%s: all %lld events are as they were written, but %lld messages are missing by "
          "their numbers\n",
          path.c_str(), static_cast<long long>(check.events),
          static_cast<long long>(check.missing));
    } else if (check.seals == 0) {
      std::printf("%s: all %lld events decode; it has no checksums\n", path.c_str(),
                  static_cast<long long>(check.events));
    } else {
      std::printf("%s: whole: %lld events, %lld checksums%s%s\n", path.c_str(),
                  static_cast<long long>(check.events), static_cast<long long>(check.seals),
                  key               ? ", all written with this key"
                  : check.keyed > 0 ? "; say --log-key to check that it is its writer's"
                                    : "",
                  AboutBegin(check).c_str());
    }
  }
  return status;
}

int RunLogStats(const LogStatsCommand& command) {
  const Recording recording = ReadRecording(command.log, command.room, command.session);
  ReportDamage("seam-log", command.log, recording);
  std::map<std::string, ChannelSum> sums;
  std::int64_t first_us = 0, last_us = 0, events = 0;
  LogReader reader(command.log);
  for (LogEvent event; reader.Next(&event);) {
    const bool ours = RoomOfChannel(event.channel) == recording.room.room &&
                      SessionOf(event.data).value_or(0) == recording.room.session;
    if (!ours) continue;
    ChannelSum& sum = sums[event.channel];
    if (sum.events++ > 0) {
      sum.pause_us = std::max(sum.pause_us, event.timestamp_us - sum.last_us);
    }
    sum.last_us = event.timestamp_us;
    const auto bytes =
        static_cast<std::int64_t>(kLogHeaderBytes + event.channel.size() + event.data.size());
    sum.bytes += bytes;
    sum.largest = std::max(sum.largest, bytes);
    first_us = events == 0 ? event.timestamp_us : std::min(first_us, event.timestamp_us);
    last_us = std::max(last_us, event.timestamp_us);
    ++events;
  }
  const double seconds = std::max(1e-6, static_cast<double>(last_us - first_us) * 1e-6);
  std::printf(command.csv ? "channel,events,events_per_s,bytes,bytes_per_s,largest_bytes,"
                            "longest_pause_s,missing\n"
                          : "%-32s %8s %9s %12s %10s %9s %9s %8s\n",
              "channel", "events", "1/s", "bytes", "bytes/s", "largest", "pause s", "missing");
  for (const auto& [channel, sum] : sums) {
    const auto gap = recording.gaps.find(channel);
    std::printf(command.csv ? "%s,%lld,%.2f,%lld,%.0f,%lld,%.3f,%lld\n"
                            : "%-32s %8lld %9.2f %12lld %10.0f %9lld %9.3f %8lld\n",
                channel.c_str(), static_cast<long long>(sum.events),
                static_cast<double>(sum.events) / seconds, static_cast<long long>(sum.bytes),
                static_cast<double>(sum.bytes) / seconds, static_cast<long long>(sum.largest),
                static_cast<double>(sum.pause_us) * 1e-6,
                static_cast<long long>(gap == recording.gaps.end() ? 0 : gap->second));
  }
  if (!command.csv) {
    const std::vector<Loss> losses = FindLosses(command.log, recording);
    const double hz = std::max(1, recording.room.tick_hz);
    const std::string strips =
        FormatLossStrips(losses, static_cast<double>(recording.last_tick) / hz);
    std::printf("\n%s%s", FormatLosses(losses).c_str(), strips.empty() ? "" : "\n");
    std::fputs(strips.c_str(), stdout);
  }
  return StatusAfterReading(0);
}

}  // namespace seam
