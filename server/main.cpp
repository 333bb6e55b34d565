/// seam-server: a room over UDP. `seam-server --help`.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/base/command_line.h"
#include "common/base/find_scene.h"
#include "common/base/names.h"
#include "common/base/process.h"
#include "common/base/progress_line.h"
#include "common/codec/version_line.h"
#include "common/net/farewell.h"
#include "common/net/impair.h"
#include "common/net/udp.h"
#include "common/record/doctor.h"
#include "common/record/sink.h"
#include "common/record/trouble_report.h"
#include "common/sync/method.h"
#include "server/console.h"
#include "server/server.h"
#include "server/tick_times.h"

namespace {

using namespace seam;

struct Flags {
  std::string scene;
  int port = 7777;
  std::string bind = "0.0.0.0";
  std::string mode = "buffer";
  std::string reconcile;
  std::string predict;
  int input_delay_ticks = -1;  // -1: the scene's
  std::string impair = "perfect";
  std::int64_t seed = 1;
  int send_hz = 30;
  std::string room = "main";
  int wait = -1;
  double duration_s = -1;  // the scene's
  std::string record;
  bool force = false;
  std::string lcm_url;
  bool quiet = false;
  bool doctor = false;
};

std::string ProfilesText() {
  std::string text = "\nnetwork profiles (--impair), each way:\n";
  for (const ImpairProfile& p : Profiles()) text += "  " + p.name + ": " + p.about + "\n";
  text += "  or delay=50ms,jitter=10ms,loss=1%,...\nreconcilers (--reconcile, mode buffer):\n";
  for (const NamedReconciler& r : Reconcilers()) {
    text += "  " + std::string(r.name) + ": " + r.about + "\n";
  }
  return text;
}

void Define(CLI::App& app, Flags& f) {
  app.add_option("scene", f.scene, "scene file, or the name of a scene");
  app.add_option("--port", f.port, "UDP port")->check(CLI::Range(1, 65535));
  app.add_option("--bind", f.bind, "address to listen on");
  app.add_option("--mode", f.mode, "oracle | central | strict | buffer");
  app.add_option("--reconcile", f.reconcile, "rule for mode buffer (default rollback)");
  app.add_option("--predict", f.predict,
                 "what clients of mode central simulate ahead: own | all (default all)");
  app.add_option("--input-delay", f.input_delay_ticks,
                 "ticks from reading an input to its acting, at every peer (default: the scene's)")
      ->check(CLI::Range(0, kInputDelayTicksMax));
  app.add_option("--impair", f.impair, "impair the network in both directions by a profile");
  app.add_option("--seed", f.seed, "of impairments and bots")->check(CLI::Range(0, 1000000000));
  app.add_option("--send-hz", f.send_hz, "state messages per second")->check(CLI::Range(1, 240));
  app.add_option("--room", f.room, "name of the room in the channels");
  app.add_option("--wait", f.wait, "players to wait for (default: those of the scene; 0: none)")
      ->check(CLI::Range(0, 31));
  app.add_option("--duration", f.duration_s,
                 "seconds to run after tick 0 (0: until stopped; default: the scene's)")
      ->check(CLI::Range(0.0, 1e6));
  app.add_option("--record", f.record, "write the session's LCM log to this file too");
  app.add_flag("--force", f.force, "overwrite the --record file");
  app.add_option("--lcm-url", f.lcm_url, "LCM bus (default: LCM_DEFAULT_URL; none: no bus)");
  app.add_flag("--quiet", f.quiet, "no progress line, and not who comes and goes");
  app.add_flag("--doctor", f.doctor, "check that LCM works on this machine, and exit");
}

void CheckRoomName(const std::string& room) {
  const bool good = IsName(room);
  if (!good) throw OperatorError("--room takes 1 to 32 letters, digits, - or _");
}

/// The tick to stop after; 0: none. However short the duration, it is one.
std::int64_t LastTick(double duration_s, int tick_hz) {
  if (std::isnan(duration_s)) throw OperatorError("--duration must be a number of seconds");
  if (duration_s <= 0) return 0;
  return std::max<std::int64_t>(1, std::llround(duration_s * tick_hz));
}

/// How the session ends, for people.
std::string Ending(double duration_s) {
  if (duration_s <= 0) return "; Ctrl-C ends it";
  char text[80];
  std::snprintf(text, sizeof text, "; then %g s (--duration 0: until Ctrl-C)", duration_s);
  return text;
}

/// How many players tick 0 waits for.
int PlayersToWaitFor(const Flags& f, const Scene& scene) {
  const int players = static_cast<int>(scene.players.size());
  if (f.wait > players) {
    throw OperatorError("--wait " + std::to_string(f.wait) + ": " + f.scene + " has " +
                        std::to_string(players) + " player(s), so the room would never start");
  }
  return f.wait >= 0 ? f.wait : players;
}

/// "which scene? ..." with the names that would do.
std::string WhichScene() {
  std::string line = "which scene? for example: seam-server scenes/crossing.toml";
  const char* before = "; by name: ";
  for (const std::string& name : SceneNames()) {
    line += before + name;
    before = ", ";
  }
  return line;
}

/// "12.3 s: bob is gone: left; ..." for each of what has happened.
void PrintNews(Server& server, ProgressLine& line) {
  for (const std::string& news : server.TakeNews()) {
    line.End();
    char when[40] = "";
    if (server.started()) {
      const double now_s = static_cast<double>(std::max<std::int64_t>(0, server.tick())) /
                           server.scene().solver.tick_hz;
      std::snprintf(when, sizeof when, "%.1f s: ", now_s);
    }
    PrintError("seam-server", when + news);
  }
}

int Serve(const Flags& f) {
  if (f.scene.empty()) throw OperatorError(WhichScene());
  CheckRoomName(f.room);
  const Scene scene = LoadScene(FindScene(f.scene));
  ServerConfig config;
  config.sync = MakeSyncConfig(MethodNames{f.mode, f.reconcile, f.predict});
  config.sync.input_delay_ticks =
      f.input_delay_ticks >= 0 ? f.input_delay_ticks : scene.input_delay_ticks;
  config.sync.tick_hz = scene.solver.tick_hz;
  config.sync.send_hz = std::min(f.send_hz, scene.solver.tick_hz);
  config.sync.seed = f.seed;
  config.room = f.room;
  config.impair = f.impair;
  config.seed = f.seed;
  config.wait_players = PlayersToWaitFor(f, scene);
  const double duration_s = f.duration_s < 0 ? scene.duration_s : f.duration_s;
  const std::int64_t last_tick = LastTick(duration_s, scene.solver.tick_hz);
  const ImpairProfile profile = FindProfile(f.impair);

  Address local = ParseAddress(f.bind, static_cast<std::uint16_t>(f.port));
  UdpNet udp(local);
  ImpairedNet net(udp, profile, profile, static_cast<std::uint64_t>(f.seed));
  Sink sink(f.lcm_url, f.record, f.force, f.room);
  OsEntropy entropy;
  Server server(scene, config, net, sink, entropy);
  StopOnSignals();
  const std::string variant = VariantOf(NamesOf(config.sync));
  std::fprintf(stderr,
               "seam-server: %s, mode %s%s%s, network %s, on %s\n"
               "seam-server: waiting for %d player(s)%s\n",
               scene.name.c_str(), f.mode.c_str(), variant.empty() ? "" : " ", variant.c_str(),
               f.impair.c_str(), ToString(udp.local()).c_str(), config.wait_players,
               Ending(duration_s).c_str());
  ProgressLine line(f.quiet);
  TroubleReport recording("seam-server", "the room runs on");
  TickTimes tick_times;
  while (g_stop == 0 && (last_tick == 0 || server.tick() < last_tick)) {
    const std::int64_t now = SteadyClockUs();
    const std::int64_t ticks_before = server.tick();
    server.Tick(now, CpuUs());
    tick_times.Note(SteadyClockUs() - now, server.tick() - ticks_before);
    sink.Poll();
    for (const std::string& warning : server.TakeWarnings()) {
      line.End();
      PrintError("seam-server", warning);
    }
    recording.Look(sink.trouble(), line);
    if (!f.quiet) PrintNews(server, line);
    if (line.Due(now)) line.Show(now, ServerProgress(server, last_tick, tick_times));
    const std::int64_t wake = std::min({server.next_tick_us(), net.next_due_us(), now + 20000});
    udp.Wait(std::max<std::int64_t>(0, wake - SteadyClockUs()));
  }
  line.End();
  server.Shutdown(SteadyClockUs(), "the server stops");
  LetThrough(udp, net);
  sink.Poll();
  sink.Flush();
  recording.Look(sink.trouble(), line);
  const Stats& s = server.stats();
  std::fprintf(stderr,
               "seam-server: %lld ticks; dropped %lld malformed, %lld stale, %lld without right, "
               "%lld implausible, %lld over budget\n"
               "seam-server: %lld part(s) left the bounds; "
               "%lld stepped again, %lld replays deferred; %lld bus failures\n",
               static_cast<long long>(server.tick()), static_cast<long long>(s.dropped_malformed),
               static_cast<long long>(s.dropped_stale), static_cast<long long>(s.dropped_right),
               static_cast<long long>(s.dropped_implausible),
               static_cast<long long>(s.dropped_budget),
               static_cast<long long>(server.left_bounds()),
               static_cast<long long>(server.replica().ticks_stepped_again()),
               static_cast<long long>(server.replica().replays_deferred()),
               static_cast<long long>(sink.failures()));
  std::fputs(SessionSummary(server.accounts()).c_str(), stderr);
  return recording.End(sink.trouble());
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{
      "seam-server",
      "seam-server: one room of a distributed 2D world, over UDP and the LCM bus",
      VersionLine("seam-server"),
      ProfilesText(),
      {{"scene", SceneNames()}, {"--impair", ProfileNames()}, {"--reconcile", ReconcilerNames()}}};
  return RunCommandLine(
      text, argc, argv, [&](CLI::App& app) { Define(app, flags); },
      [&] {
        if (!flags.doctor) return Serve(flags);
        const DoctorReport report = RunDoctor(flags.lcm_url);
        for (const std::string& line : report.lines) std::printf("%s\n", line.c_str());
        return report.healthy ? 0 : 1;
      });
}
