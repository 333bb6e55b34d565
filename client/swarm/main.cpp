/// seam-swarm: many clients against one server, as a load test. `seam-swarm --help`.

#include <time.h>

#include <algorithm>
#include <cstdio>

#include "client/swarm/report.h"
#include "client/swarm/swarm.h"
#include "client/top/loads.h"
#include "common/base/command_line.h"
#include "common/base/process.h"
#include "common/base/huge_pages.h"
#include "common/base/names.h"
#include "common/base/progress_line.h"
#include "common/codec/version_line.h"

namespace {

using namespace seam;

struct Flags {
  std::string server;
  int clients = 1;
  std::string drive = "bot";
  std::string for_text = "60s";
  std::string room;
  int rooms = 1;
  int threads = 1;
  double join_s = 30;
  std::string metrics;
  std::string lcm_url = "none";
  bool quiet = false;
};

void Define(Command& app, Flags& f) {
  app.Option("server", f.server, "host:port of seam-server (port 7777 if left out)");
  app.Option("--clients", f.clients, "how many; each is a player of its room's scene, in order")
      .Range(1, 65535);
  app.Option("--drive", f.drive, "bot | none | script (each plays its own player's script)")
      .OneOf({"bot", "none", "script"});
  app.Option("--for", f.for_text, "how long to measure, from when all have joined: 60s, 5m");
  app.Option("--room", f.room, "the room to join (default: the server's first)");
  app.Option("--rooms", f.rooms, "spread over the rooms NAME-1 to NAME-N of --room NAME")
      .Range(1, 4096);
  app.Option("--threads", f.threads, "threads that run the clients").Range(1, 256);
  app.Option("--join-timeout", f.join_s, "seconds until all must have joined").Range(0.1, 1e6);
  app.Option("--metrics", f.metrics, "host:port of the server's page: its figures too");
  app.Option("--lcm-url", f.lcm_url, "LCM bus: the server's figures too (default: none)");
  app.Switch("--quiet", f.quiet, "no progress line");
}

/// Parses "60s", "5m", "90" into seconds.
double Seconds(const std::string& text) {
  std::size_t used = 0;
  double seconds = -1;
  try {
    seconds = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  const std::string unit = text.substr(std::min(used, text.size()));
  if (unit == "m") seconds *= 60;
  const bool good = used > 0 && (unit.empty() || unit == "s" || unit == "m");
  if (!good || !(seconds > 0) || seconds > 1e6) {
    throw OperatorError("--for takes a time as 60s or 5m, not \"" + text + "\"");
  }
  return seconds;
}

SwarmConfig Configure(const Flags& f) {
  SwarmConfig config;
  config.server = ParseAddress(f.server, 7777);
  config.clients = f.clients;
  config.threads = f.threads;
  if (f.drive == "none") config.drive = Drive::kNone;
  if (f.drive == "script") config.drive = Drive::kScript;
  if (!f.room.empty() && !IsName(f.room)) {
    throw OperatorError("--room takes 1 to 32 letters, digits, - or _");
  }
  config.rooms = {f.room};
  if (f.rooms > 1) {
    config.rooms.clear();
    for (int r = 0; r < f.rooms; ++r) {
      config.rooms.push_back(RoomName(f.room.empty() ? "main" : f.room, r, f.rooms));
    }
  }
  return config;
}

void Doze() {
  const timespec moment{0, 20000000};
  nanosleep(&moment, nullptr);
}

/// Time for members that have waited for others to catch up, us.
constexpr std::int64_t kCatchUpUs = 1000000;

/// Waits until all clients simulate. False if stopped by a signal.
bool WaitUntilJoined(const Flags& f, const Swarm& swarm, ProgressLine* line) {
  const std::int64_t begin_us = SteadyClockUs();
  while (swarm.running() < f.clients) {
    if (g_stop != 0) return false;
    const std::int64_t now_us = SteadyClockUs();
    if (!swarm.Fatal().empty()) throw OperatorError(swarm.Fatal());
    if (static_cast<double>(now_us - begin_us) * 1e-6 > f.join_s) {
      throw OperatorError(std::to_string(swarm.running()) + " of " + std::to_string(f.clients) +
                          " clients play after --join-timeout; a room begins when as many "
                          "players are there as its server waits for (--wait)");
    }
    if (line->Due(now_us)) line->Show(now_us, std::to_string(swarm.running()) + " have joined");
    Doze();
  }
  const std::int64_t settled_us = SteadyClockUs() + kCatchUpUs;
  while (SteadyClockUs() < settled_us && g_stop == 0) Doze();
  return g_stop == 0;
}

int RunSwarm(const Flags& f) {
  if (f.server.empty()) {
    throw OperatorError("which server? for example: seam-swarm 127.0.0.1:7777 --clients 8");
  }
  const double seconds = Seconds(f.for_text);
  const SwarmConfig config = Configure(f);
  std::unique_ptr<Loads> loads;
  if (!f.metrics.empty()) {
    (void)ParseAddress(f.metrics, 9464);
    loads = LoadsOnPage(f.metrics);
  } else if (f.lcm_url != "none") {
    loads = LoadsOnBus(f.lcm_url);
  }
  StopOnSignals();
  Swarm swarm(config);
  ProgressLine line(f.quiet);
  swarm.Start();
  ServerLoads told;
  if (WaitUntilJoined(f, swarm, &line)) {
    const std::int64_t begin_us = SteadyClockUs();
    swarm.BeginToMeasure(begin_us);
    if (loads != nullptr) told.before = loads->TakeNow(begin_us);
    const auto end_us = begin_us + static_cast<std::int64_t>(seconds * 1e6);
    for (std::int64_t now_us = begin_us; now_us < end_us; now_us = SteadyClockUs()) {
      if (g_stop != 0 || swarm.closed() || !swarm.Fatal().empty()) break;
      if (loads != nullptr) {
        for (RoomLoad& load : loads->Take(now_us)) {
          if (load.load.utime == 0) load.load.utime = now_us;
          told.meanwhile.push_back(std::move(load));
        }
      }
      if (line.Due(now_us)) {
        line.Show(now_us, std::to_string(swarm.running()) + " play, " +
                              std::to_string((end_us - now_us) / 1000000) + " s to go");
      }
      Doze();
    }
    if (loads != nullptr) told.after = loads->TakeNow(SteadyClockUs());
  }
  line.End();
  const std::string fatal = swarm.Fatal();
  swarm.Finish(SteadyClockUs());
  if (!fatal.empty()) throw OperatorError(fatal);
  std::printf("%s", SwarmReport(swarm, told).c_str());
  if (loads != nullptr && told.meanwhile.empty() && !loads->trouble().empty()) {
    PrintError("seam-swarm", loads->trouble());
  }
  if (swarm.closed()) {
    PrintError("seam-swarm", "the server closed the room");
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{"seam-swarm", "seam-swarm: many clients against one seam-server",
                         VersionLine("seam-swarm"), ""};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { Define(app, flags); },
      [&] {
        if (flags.threads == 1) UseHugePages(argv);
        return RunSwarm(flags);
      });
}
