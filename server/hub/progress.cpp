#include "server/hub/progress.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "common/base/command_line.h"
#include "common/base/json_text.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/record/events/summary_text.h"
#include "common/record/trouble_report.h"
#include "server/console.h"

namespace seam {
namespace {

/// Returns ", overloaded: runs at 47 % of its speed" if the clock is slowed, else "".
std::string Slowed(std::int32_t speed_ppm) {
  if (speed_ppm == kFullSpeedPpm) return "";
  return ", overloaded: runs at " + std::to_string(speed_ppm / 10000) + " % of its speed";
}

/// Requires that no worker thread runs the room.
std::string OneRoom(const HostedRoom& room) {
  const Server& server = room.server();
  return ServerProgress(server, room.last_tick(), room.tick_times()) + Slowed(server.speed_ppm());
}

/// Returns false after a line for the operator if the file cannot be written.
bool WriteSummaries(const Hub& hub, const std::string& path) {
  std::vector<std::string> sums;
  for (const auto& room : hub.rooms()) {
    for (const Summary& sum : room->summaries()) {
      sums.push_back("\n" + SummaryJson(sum, room->config().room, room->scene().name,
                                        room->config().sync.tick_hz));
    }
  }
  const std::string text = JsonList(sums) + "\n";
  std::FILE* const file = OpenPlainFile(path, FileUse::kReplace);
  bool good = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (file != nullptr) good = std::fclose(file) == 0 && good;
  if (!good) PrintError("seam-server", path + ": cannot be written: " + std::strerror(errno));
  return good;
}

}  // namespace

bool HasReport(const Hub& hub) {
  if (hub.lane_count() == 0) return true;
  const std::vector<RoomLoad> loads = hub.Loads();
  return std::any_of(loads.begin(), loads.end(),
                     [](const RoomLoad& room) { return room.load.ticks > 0; });
}

std::string HubProgress(const Hub& hub) {
  if (hub.lane_count() == 0 && hub.rooms().size() == 1) return OneRoom(*hub.rooms()[0]);
  int players = 0;
  std::int32_t tick_us = 0, late_us = 0, speed_ppm = kFullSpeedPpm;
  for (const RoomLoad& room : hub.Loads()) {
    const Load& load = room.load;
    players += load.players;
    tick_us = std::max(tick_us, load.tick_p99_us);
    late_us = std::max(late_us, load.late_p99_us);
    speed_ppm = std::min(speed_ppm, load.speed_ppm);
  }
  char line[160];
  std::snprintf(line, sizeof line,
                "%zu rooms, %d player(s), worst p99 tick %.1f ms, lateness %.1f ms, %d thread(s)",
                hub.rooms().size(), players, tick_us * 1e-3, late_us * 1e-3, hub.lane_count());
  return line + Slowed(speed_ppm);
}

int ReportEnd(const Hub& hub, const std::string& summary) {
  Stats sum;
  long long ticks = 0, left_bounds = 0, again = 0, deferred = 0, failures = 0;
  int status = 0;
  const TroubleReport recording("seam-server", "the room runs on");
  for (const auto& room : hub.rooms()) {
    const Server& server = room->server();
    const Stats& s = server.stats();
    ticks += server.tick();
    sum.dropped_malformed += s.dropped_malformed;
    sum.dropped_stale += s.dropped_stale;
    sum.dropped_right += s.dropped_right;
    sum.dropped_implausible += s.dropped_implausible;
    sum.dropped_budget += s.dropped_budget;
    left_bounds += server.left_bounds();
    again += server.replica().ticks_stepped_again();
    deferred += server.replica().replays_deferred();
    failures += room->sink().failures();
  }
  std::fprintf(stderr,
               "seam-server: %lld ticks; dropped %lld malformed, %lld stale, %lld without right, "
               "%lld implausible, %lld over budget\n"
               "seam-server: %lld part(s) left the bounds; "
               "%lld stepped again, %lld replays deferred; %lld bus failures\n",
               ticks, static_cast<long long>(sum.dropped_malformed),
               static_cast<long long>(sum.dropped_stale), static_cast<long long>(sum.dropped_right),
               static_cast<long long>(sum.dropped_implausible),
               static_cast<long long>(sum.dropped_budget), left_bounds, again, deferred, failures);
  for (const auto& room : hub.rooms()) {
    if (hub.rooms().size() > 1) std::fprintf(stderr, "room %s:\n", room->newest().room.c_str());
    for (const Summary& session : room->summaries()) {
      std::fputs(SummaryTable(session, room->config().sync.tick_hz).c_str(), stderr);
    }
    if (const RoomKeeper* keeper = room->keeper()) {
      std::fprintf(stderr, "seam-server: the last snapshot has %.1f kB; one took at most %.2f ms\n",
                   static_cast<double>(keeper->bytes()) * 1e-3,
                   static_cast<double>(keeper->longest_us()) * 1e-3);
    }
    status = std::max(status, recording.End(room->trouble()));
    if (room->server().script_stopped()) status = std::max(status, 1);
  }
  if (!summary.empty() && !WriteSummaries(hub, summary)) status = std::max(status, 1);
  return status;
}

}  // namespace seam
