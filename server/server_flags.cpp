#include "server/server_flags.h"

#include <cstdlib>

#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/base/limits.h"
#include "common/net/impair.h"
#include "common/sync/lease.h"
#include "common/sync/method.h"
#include "common/sync/publish.h"

namespace seam {
namespace {

constexpr int kRoomsMax = 4096;

}  // namespace

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

std::string WhichScene() {
  std::string line = "which scene? for example: seam-server scenes/crossing.toml";
  const char* before = "; by name: ";
  for (const std::string& name : SceneNames()) {
    line += before + name;
    before = ", ";
  }
  return line;
}

void DefineServerFlags(Command& app, ServerFlags& f) {
  app.Option("scene", f.scenes, "scene file, or the name of a scene; several: a room of each");
  app.Option("--port", f.port, "UDP port").Range(1, 65535);
  app.Option("--bind", f.bind, "address to listen on (default: all, of IPv4 and IPv6)");
  app.Option("--mode", f.mode,
             "oracle | central | strict | touch | buffer | lockstep | lockstep-adaptive | ggpo");
  app.Option("--reconcile", f.reconcile, "rule for mode buffer (default rollback)");
  app.Option("--predict", f.predict,
             "what clients of mode central simulate ahead: own | all (default all)");
  app.Option(
         "--input-delay", f.input_delay_ticks,
         "ticks from reading an input to its acting, at every peer (default: the scene's, or the "
         "mode's)")
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
  app.Option("--metrics-bind", f.metrics_bind,
             "numeric address of that page, such as 10.0.0.1 or :: (default: loopback); whoever "
             "reaches it can read it");
  app.Option("--metrics-rooms", f.metrics_rooms,
             "rooms on that page: all, or worst:N, the N latest ones");
  app.Option("--control", f.control_port,
             "let those who have the printed address change the room while it runs, at "
             "http://127.0.0.1:PORT (0: any that is free): network, input delay, show age, edits")
      .Range(0, 65535);
  app.Option("--identity", f.identity,
             "keep the server's key in this file (mode 0600; made if there is none), so that it is "
             "the same after a restart");
  app.Option("--token-key", f.token_key,
             "let in only those with a token that seam-token made with the key in this file");
  app.Option("--wait", f.wait, "players to wait for (default: those of the scene; 0: none)")
      .Range(0, kPlayersMax);
  app.Option("--duration", f.duration_s,
             "seconds to run after tick 0 (0: until stopped; default: the scene's)")
      .Range(0.0, 1e6);
  app.Option("--record", f.record,
             "write the session's LCM log to this file too; of several rooms FILE.NAME-1.lcm, ...");
  app.Option("--log-key", f.log_key,
             "key file (64 hex digits, mode 0600) with which logs are sealed: seam-log verify "
             "--log-key then finds what anybody else has changed");
  app.Option("--state", f.state,
             "keep the rooms in this folder: the log of each, and a snapshot each 5 s");
  app.Option("--resume", f.resume,
             "go on with the rooms in such a folder, and keep them there; takes no scene");
  app.Option("--segment-mb", f.segment_mb,
             "size at which the log of such a room goes on in another file, MB")
      .Range(0.01, 1e6);
  app.Option("--keep", f.keep,
             "remove what such a log has of longer ago, such as 7d, 12h or 30m (default: nothing)");
  app.Option("--drain-to", f.drain_to,
             "after SIGTERM send the clients to the server at this address, which goes on with the "
             "rooms (--resume); fleet: to one of the --directory");
  app.Option("--directory", f.directory,
             "take rooms by this directory of a fleet, file:FOLDER or etcd:HOST:PORT,...; with "
             "--resume also take over the rooms of servers that are gone (docs/fleet.md)");
  app.Switch("--standby", f.standby,
             "with --directory and --resume: keep a copy of other servers' rooms up to date, to go "
             "on at once with those of a server that dies");
  app.Option("--fleet", f.fleet, "name of the fleet in the directory");
  app.Option("--id", f.server_id, "name of this server in the directory (default: its address)");
  app.Option("--advertise", f.advertise,
             "address under which clients reach this server, for the directory (default: --bind)");
  app.Option("--capacity", f.capacity, "most rooms that it takes by the directory")
      .Range(1, kRoomsMax);
  app.Switch("--gateway", f.gateway,
             "have no rooms: send each client to the server of the --directory that has its room");
  app.Switch("--agones", f.agones,
             "tell the sidecar of an Agones pod that the server is ready, healthy and at its end");
  app.Option("--store", f.store,
             "put sessions, players, scores and events into this SQLite database (seam-log top)");
  app.Option("--events", f.events,
             "append the events of all rooms to this file, a line of JSON each, once a second");
  app.Option("--summary", f.summary,
             "write the sums of the sessions to this file at the end, as JSON");
  app.Switch("--force", f.force,
             "replace the files of --record and --summary, or the rooms of --state");
  app.Option("--lcm-url", f.lcm_url, "LCM bus (default: LCM_DEFAULT_URL; none: no bus)");
  app.Option("--trust", f.trust,
             "states that differ from the server's copies: off | watch (tell) | act (refuse)");
  app.Option("--publish", f.publish,
             "views on the bus: all | own (what it simulates) | none | auto (all in a room of "
             "at most " +
                 std::to_string(kPublishAllMost) + " bodies, else own)");
  app.Switch("--quiet", f.quiet, "no progress line, and not who comes and goes");
  app.Switch("--doctor", f.doctor, "check that LCM works on this machine, and exit");
}

}  // namespace seam
