/// seam-server: one room or several over UDP. `seam-server --help`.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "common/base/command_line.h"
#include "common/base/find_scene.h"
#include "common/base/limits.h"
#include "common/base/names.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/base/progress_line.h"
#include "common/codec/version_line.h"
#include "common/net/impair.h"
#include "common/net/udp.h"
#include "common/record/doctor.h"
#include "common/sync/method.h"
#include "server/hub/hub.h"
#include "server/hub/progress.h"

namespace {

using namespace seam;

constexpr int kRoomsMax = 4096;
/// Time between two polls for requests of the metrics page, us.
constexpr std::int64_t kPageUs = 5000;

struct Flags {
  std::vector<std::string> scenes;
  int port = 7777;
  std::string bind = "0.0.0.0";
  std::string mode = "buffer";
  std::string reconcile;
  std::string predict;
  int input_delay_ticks = -1;  // -1: the scene's
  std::string impair = "perfect";
  std::int64_t seed = 1;
  int send_hz = 30;
  std::string budget;  // "": kClientBytesPerS
  std::string room = "main";
  int wait = -1;
  double duration_s = -1;  // the scene's
  std::string record;
  bool force = false;
  std::string lcm_url;
  std::string publish = "all";
  bool quiet = false;
  bool doctor = false;
  int rooms = 0;  // 0: one for each scene
  int workers = 0;
  std::string bus_rooms = "first";
  int metrics_port = 0;
};

/// Parses bytes a second: "64kB/s", "64000". Throws OperatorError.
double ParseBudget(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  std::string unit = end;
  if (unit.size() >= 2 && unit.substr(unit.size() - 2) == "/s") unit.resize(unit.size() - 2);
  double factor = 0;
  if (unit.empty() || unit == "B") factor = 1;
  if (unit == "kB") factor = 1e3;
  if (unit == "MB") factor = 1e6;
  const bool good = end != text.c_str() && factor > 0 && number >= 0 && number * factor <= 1e12;
  if (good) return number * factor;
  throw OperatorError("--budget takes bytes a second, such as 64kB/s, 1MB/s or 64000; 0: no limit");
}

std::string ProfilesText() {
  std::string text = "\nnetwork profiles (--impair), each way:\n";
  for (const ImpairProfile& p : Profiles()) text += "  " + p.name + ": " + p.about + "\n";
  text += "  or delay=50ms,jitter=10ms,loss=1%,...\nreconcilers (--reconcile, mode buffer):\n";
  for (const NamedReconciler& r : Reconcilers()) {
    text += "  " + std::string(r.name) + ": " + r.about + "\n";
  }
  return text;
}

void Define(Command& app, Flags& f) {
  app.Option("scene", f.scenes, "scene file, or the name of a scene; several: a room of each");
  app.Option("--port", f.port, "UDP port").Range(1, 65535);
  app.Option("--bind", f.bind, "address to listen on");
  app.Option("--mode", f.mode, "oracle | central | strict | buffer");
  app.Option("--reconcile", f.reconcile, "rule for mode buffer (default rollback)");
  app.Option("--predict", f.predict,
             "what clients of mode central simulate ahead: own | all (default all)");
  app.Option("--input-delay", f.input_delay_ticks,
             "ticks from reading an input to its acting, at every peer (default: the scene's)")
      .Range(0, kInputDelayTicksMax);
  app.Option("--impair", f.impair, "impair the network in both directions by a profile");
  app.Option("--seed", f.seed, "of impairments and bots").Range(0, 1000000000);
  app.Option("--send-hz", f.send_hz, "state messages per second").Range(1, kSendHzMax);
  app.Option("--budget", f.budget,
             "most that each client is sent, such as 64kB/s (default 256kB/s; 0: no limit)");
  app.Option("--room", f.room, "name of the room in the channels; of several: NAME-1, NAME-2, ...");
  app.Option("--rooms", f.rooms, "rooms (default: one for each scene); scenes take turns")
      .Range(1, kRoomsMax);
  app.Option("--workers", f.workers, "threads that run several rooms (default: one per core)")
      .Range(1, 256);
  app.Option("--bus-rooms", f.bus_rooms, "of several rooms, which are on the LCM bus")
      .OneOf({"first", "all", "none"});
  app.Option("--metrics", f.metrics_port,
             "serve what the rooms cost to Prometheus, at http://127.0.0.1:PORT/metrics")
      .Range(1, 65535);
  app.Option("--wait", f.wait, "players to wait for (default: those of the scene; 0: none)")
      .Range(0, kPlayersMax);
  app.Option("--duration", f.duration_s,
             "seconds to run after tick 0 (0: until stopped; default: the scene's)")
      .Range(0.0, 1e6);
  app.Option("--record", f.record,
             "write the session's LCM log to this file too; of several rooms FILE.NAME-1.lcm, ...");
  app.Switch("--force", f.force, "replace the --record file");
  app.Option("--lcm-url", f.lcm_url, "LCM bus (default: LCM_DEFAULT_URL; none: no bus)");
  app.Option("--publish", f.publish,
             "views on the bus: all | own (what it simulates) | none | auto (all in a room of "
             "at most " +
                 std::to_string(kPublishAllMost) + " bodies, else own)");
  app.Switch("--quiet", f.quiet, "no progress line, and not who comes and goes");
  app.Switch("--doctor", f.doctor, "check that LCM works on this machine, and exit");
}

void CheckRoomName(const std::string& room, int rooms) {
  const bool good = IsName(RoomName(room, rooms - 1, rooms)) && IsName(room);
  if (!good) throw OperatorError("--room takes 1 to 32 letters, digits, - or _");
}

/// Returns the tick to stop after; 0: none. At least one tick for any positive duration.
std::int64_t LastTick(double duration_s, int tick_hz) {
  if (std::isnan(duration_s)) throw OperatorError("--duration must be a number of seconds");
  if (duration_s <= 0) return 0;
  return std::max<std::int64_t>(1, std::llround(duration_s * tick_hz));
}

double DurationOf(const Flags& f, const Scene& scene) {
  return f.duration_s < 0 ? scene.duration_s : f.duration_s;
}

/// Describes the end of the session for people.
std::string Ending(double duration_s) {
  if (duration_s <= 0) return "; Ctrl-C ends it";
  char text[80];
  std::snprintf(text, sizeof text, "; then %g s (--duration 0: until Ctrl-C)", duration_s);
  return text;
}

/// Returns the number of players that tick 0 waits for.
int PlayersToWaitFor(const Flags& f, const std::string& name, const Scene& scene) {
  const int players = static_cast<int>(scene.players.size());
  if (f.wait > players) {
    throw OperatorError("--wait " + std::to_string(f.wait) + ": " + name + " has " +
                        std::to_string(players) + " player(s), so the room would never start");
  }
  return f.wait >= 0 ? f.wait : players;
}

/// Returns "which scene? ..." with the names of known scenes.
std::string WhichScene() {
  std::string line = "which scene? for example: seam-server scenes/crossing.toml";
  const char* before = "; by name: ";
  for (const std::string& name : SceneNames()) {
    line += before + name;
    before = ", ";
  }
  return line;
}

/// Returns the name of a room's log: "out/log.lcm" for one room, "out/log.main-1.lcm" for several.
std::string LogOf(const std::string& record, const std::string& room, int rooms) {
  if (record.empty() || rooms == 1) return record;
  const std::string ending = ".lcm";
  const bool has = record.size() > ending.size() &&
                   record.compare(record.size() - ending.size(), ending.size(), ending) == 0;
  const std::string stem = has ? record.substr(0, record.size() - ending.size()) : record;
  return stem + "." + room + ending;
}

RoomPlan MakePlan(const Flags& f, const std::string& scene_name, int index, int rooms) {
  RoomPlan plan;
  plan.scene = LoadScene(FindScene(scene_name));
  const Scene& scene = plan.scene;
  ServerConfig& config = plan.config;
  config.sync = MakeSyncConfig(MethodNames{f.mode, f.reconcile, f.predict});
  config.sync.input_delay_ticks =
      f.input_delay_ticks >= 0 ? f.input_delay_ticks : scene.input_delay_ticks;
  config.sync.tick_hz = scene.solver.tick_hz;
  config.sync.send_hz = std::min(f.send_hz, scene.solver.tick_hz);
  config.sync.seed = f.seed + index;
  config.room = RoomName(f.room, index, rooms);
  config.impair = f.impair;
  config.publish = ParsePublish(f.publish);
  if (!f.budget.empty()) config.client_bytes_per_s = ParseBudget(f.budget);
  config.seed = f.seed + index;
  config.wait_players = PlayersToWaitFor(f, scene_name, scene);
  plan.last_tick = LastTick(DurationOf(f, scene), scene.solver.tick_hz);
  plan.profile = FindProfile(f.impair);
  const bool on_bus = rooms == 1 || f.bus_rooms == "all" || (f.bus_rooms == "first" && index == 0);
  plan.lcm_url = on_bus ? f.lcm_url : "none";
  plan.record = LogOf(f.record, config.room, rooms);
  plan.force = f.force;
  if (!plan.record.empty()) RequireOutput(plan.record, plan.force, {FindScene(scene_name)});
  plan.alone = rooms == 1;
  plan.news = !f.quiet;
  return plan;
}

int Serve(const Flags& f) {
  if (f.scenes.empty()) throw OperatorError(WhichScene());
  const int rooms = f.rooms > 0 ? f.rooms : static_cast<int>(f.scenes.size());
  CheckRoomName(f.room, rooms);
  if (f.workers > 0 && rooms == 1) throw OperatorError("--workers: one room has one thread");
  std::vector<RoomPlan> plans;
  for (int r = 0; r < rooms; ++r) {
    plans.push_back(MakePlan(f, f.scenes[static_cast<std::size_t>(r) % f.scenes.size()], r, rooms));
  }
  UdpNet udp(ParseAddress(f.bind, static_cast<std::uint16_t>(f.port)));
  std::unique_ptr<HttpPage> page;
  if (f.metrics_port > 0) {
    page = std::make_unique<HttpPage>(static_cast<std::uint16_t>(f.metrics_port));
  }
  Hub hub(plans, udp);
  StopOnSignals();
  const int workers = f.workers > 0 ? f.workers : CoreCount();
  if (rooms > 1) hub.Start(std::min(workers, rooms));
  const SyncConfig& sync = plans[0].config.sync;
  const std::string variant = VariantOf(NamesOf(sync));
  const std::string what = rooms == 1 ? plans[0].scene.name : std::to_string(rooms) + " rooms";
  std::fprintf(stderr,
               "seam-server: %s, mode %s%s%s, network %s, on %s\n"
               "seam-server: waiting for %d player(s)%s%s\n",
               what.c_str(), f.mode.c_str(), variant.empty() ? "" : " ", variant.c_str(),
               f.impair.c_str(), ToString(udp.local()).c_str(), plans[0].config.wait_players,
               rooms == 1 ? "" : " in the first", Ending(DurationOf(f, plans[0].scene)).c_str());
  ProgressLine line(f.quiet);
  std::int64_t page_us = 0;
  while (g_stop == 0 && !hub.done()) {
    const std::int64_t now = SteadyClockUs();
    hub.Poll(now);
    if (page != nullptr && now - page_us >= kPageUs) {
      page_us = now;
      page->Poll(now, [&] { return WriteLoadPage(hub.Loads()); });
    }
    for (const std::string& news : hub.TakeReports()) {
      line.End();
      PrintError("seam-server", news);
    }
    if (line.Due(now) && HasReport(hub)) line.Show(now, HubProgress(hub));
    hub.Wait();
  }
  line.End();
  hub.Close();
  return ReportEnd(hub);
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{
      "seam-server",
      "seam-server: rooms of a distributed 2D world, over UDP and the LCM bus",
      VersionLine("seam-server"),
      ProfilesText(),
      {{"scene", SceneNames()}, {"--impair", ProfileNames()}, {"--reconcile", ReconcilerNames()}}};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { Define(app, flags); },
      [&] {
        if (!flags.doctor) return Serve(flags);
        const DoctorReport report = RunDoctor(flags.lcm_url);
        for (const std::string& line : report.lines) std::printf("%s\n", line.c_str());
        return report.healthy ? 0 : 1;
      });
}
