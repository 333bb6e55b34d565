/// seam-client: one player (or spectator) of a room, over UDP. `seam-client --help`.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "client/client.h"
#include "client/cpu_throttle.h"
#include "client/input_lines.h"
#include "client/join_flags.h"
#include "client/key_file.h"
#include "client/keyboard.h"
#include "client/lcm_link.h"
#include "client/progress_text.h"
#include "client/terminal_view.h"
#include "common/base/command_line.h"
#include "common/base/nearest.h"
#include "common/base/process.h"
#include "common/base/progress_line.h"
#include "common/codec/version_line.h"
#include "common/fleet/room_watch.h"
#include "common/net/farewell.h"
#include "common/net/impair.h"
#include "common/net/udp.h"
#include "common/record/sink.h"
#include "common/record/trouble_report.h"
#include "common/scene/lcm/lcm_tables.h"

namespace {

using namespace seam;

struct Flags : JoinFlags {
  bool watch = false;
  bool show = false;
  std::string drive = "none";
  std::string inputs;  // "": none
  std::string hint;
  std::string impair = "perfect";
  std::int64_t seed = 1;
  std::string smooth = "on";
  int show_age = -1;  // ticks; -1: the scene's
  double duration_s = 0;
  double join_s = 10;
  double throttle = 1;
  std::string key;
  std::string record;
  bool force = false;
  std::string lcm_url;
  std::string publish = "auto";
  bool quiet = false;
};

void Define(Command& app, Flags& f) {
  app.Option("server", f.server, "host:port of seam-server (port 7777 if left out)");
  app.Option("--name", f.name, "player of the scene to be");
  app.Switch("--watch", f.watch, "only look on, as a guest or under --name");
  app.Switch("--show", f.show, "draw the world in this terminal (--drive keyboard does that too)");
  app.Option("--drive", f.drive,
             "none | bot | keyboard | lcm (the scene's [[lcm.drive]]) | lcm:CHANNEL | name of the "
             "player whose script to play");
  app.Option("--inputs", f.inputs,
             "drive by the lines DRIVE LIFT BUTTONS of this file or pipe (-: standard input), as "
             "seam-view --drive prints them; the keyboard may drive too");
  app.Option("--hint", f.hint, "show this text beside the keys, in the terminal's view");
  app.Option("--impair", f.impair, "impair this client's network, both directions");
  app.Option("--seed", f.seed, "of the impairment").Range(0, 1000000000);
  app.Option("--smooth", f.smooth,
             "hide corrections in the view: on | off | rate in 1/s, 1 to 60 (on: 10)")
      .OneOfOrRange({"on", "off"}, kSmoothRateMin, kSmoothRateMax);
  app.Option("--show-age", f.show_age,
             "show others' bodies at most so many ticks ago, as far as they are known (default: "
             "the scene's show_age; 0: in the present)")
      .Range(0, kShowAgeTicksMax);
  app.Option("--duration", f.duration_s, "seconds to run (0: until stopped)").Range(0.0, 1e6);
  app.Option("--join-timeout", f.join_s, "seconds to try to join, at first or again")
      .Range(0.1, 1e6);
  app.Option("--cpu-throttle", f.throttle,
             "be a machine that is so many times slower: the server gives it less to simulate")
      .Range(1.0, 100.0);
  app.Option("--key", f.key,
             "keep the secret of our place in this file (mode 0600): after a restart the "
             "place, with its car, is ours again at once");
  DefineJoin(app, f);
  app.Option("--record", f.record, "write an LCM log of the bus to this file");
  app.Switch("--force", f.force, "replace the --record file");
  app.Option("--lcm-url", f.lcm_url, "LCM bus (default: LCM_DEFAULT_URL; none: no bus)");
  app.Option("--publish", f.publish,
             "views on the bus: all | own (what it simulates) | none | auto (all in a room of "
             "at most " +
                 std::to_string(kPublishAllMost) + " bodies, else own)");
  app.Switch("--quiet", f.quiet, "no progress line");
}

/// Refuses a misspelt --drive before anything starts, as far as no player can have that name: short
/// words may well be players' names, which only the server knows.
void CheckDrive(const Flags& f) {
  if (f.watch && (f.drive != "none" || !f.inputs.empty())) {
    throw OperatorError("--watch drives nothing: not with --drive or --inputs");
  }
  if (!f.inputs.empty() && f.drive != "none" && f.drive != "keyboard") {
    throw OperatorError("--inputs goes with --drive keyboard or alone");
  }
  if (f.inputs == "-" && f.drive == "keyboard") {
    throw OperatorError("--inputs -: standard input is the keyboard");
  }
  if (f.drive != "keyboard" && f.drive != f.name && !NearestName(f.drive, {"keyboard"}).empty()) {
    throw OperatorError("--drive " + f.drive + ": there is none, bot, keyboard or a player's name" +
                        DidYouMean(f.drive, {"keyboard"}));
  }
  if (f.drive.rfind("lcm:", 0) != 0) return CheckName("--drive", f.drive);
  const Status channel = CheckLcmChannel(f.drive.substr(4));
  if (!channel.ok()) throw OperatorError("--drive lcm:CHANNEL: " + channel.why());
}

/// Returns the channel to drive by, "": the scene's; nullopt: other inputs are asked for.
std::optional<std::string> LcmDriveOf(const Flags& f) {
  if (f.drive == "lcm") return "";
  if (f.drive.rfind("lcm:", 0) == 0) return f.drive.substr(4);
  return std::nullopt;
}

ClientConfig Configure(const Flags& f) {
  if (f.token.empty() && f.name.empty() && !f.watch) {
    throw OperatorError("who are you? --name PLAYER, one of the scene's; or --watch");
  }
  CheckDrive(f);
  if (std::isnan(f.duration_s)) throw OperatorError("--duration must be a number of seconds");
  if (std::isnan(f.throttle)) throw OperatorError("--cpu-throttle must be a number");
  if (std::isnan(f.join_s)) throw OperatorError("--join-timeout must be a number of seconds");
  ClientConfig config = JoinConfig(f);
  config.watch = f.watch;
  config.smooth_rate = ParseSmoothRate(f.smooth);
  if (f.show_age >= 0) config.show_age_ticks = f.show_age;
  config.publish = ParsePublish(f.publish);
  config.shows = f.show || f.drive == "keyboard";
  if (!f.inputs.empty()) {
    config.drive = Drive::kLive;
  } else if (f.drive == "bot") {
    config.drive = Drive::kBot;
  } else if (f.drive == "keyboard" || LcmDriveOf(f)) {
    config.drive = Drive::kLive;
  } else if (f.drive != "none") {
    config.drive = Drive::kScript;
    config.script_of = f.drive;
  }
  return config;
}

/// Help for the keyboard.
const char* const kKeys = "keys: arrows or WASD drive and lift, space and 0-9 press, q quits";

/// Time for which a line of the server stays on the screen, us.
constexpr std::int64_t kNoticeUs = 4000000;

/// Adds the inputs of two sources: axes of the first that moves them, buttons of both.
Input Both(const Input& a, const Input& b) {
  Input both = a;
  if (both.drive == 0) both.drive = b.drive;
  if (both.lift == 0) both.lift = b.lift;
  both.buttons = static_cast<std::int16_t>(a.buttons | b.buttons);
  return both;
}

/// Says why a client is not in a room.
std::string NotIn(const Client& client) {
  if (!client.why_refused().empty()) return "the server refuses: " + client.why_refused();
  return (client.sessions() == 0 ? "no answer from " : "lost the server ") +
         ToString(client.server());
}

int Play(const Flags& f) {
  if (f.server.empty() && f.directory.empty()) {
    throw OperatorError("which server? for example: seam-client 127.0.0.1:7777");
  }
  ClientConfig config = Configure(f);
  std::unique_ptr<KeyFile> key_file;
  if (!f.key.empty()) key_file = std::make_unique<KeyFile>(f.key);
  if (key_file != nullptr) config.key = key_file->key();
  const ImpairProfile profile = FindProfile(f.impair);
  std::unique_ptr<Keyboard> keyboard;
  if (f.drive == "keyboard") keyboard = std::make_unique<Keyboard>();
  std::unique_ptr<InputLines> lines;
  if (!f.inputs.empty()) lines = std::make_unique<InputLines>(f.inputs);
  std::unique_ptr<TerminalView> view;
  const bool shown = f.show || (keyboard != nullptr && isatty(1) != 0 && !f.quiet);
  if (shown) view = std::make_unique<TerminalView>();
  if (keyboard != nullptr && !shown) std::fprintf(stderr, "seam-client: %s\n", kKeys);
  UdpNet udp(kAnyAddress);
  ImpairedNet net(udp, profile, profile, static_cast<std::uint64_t>(f.seed) + 7);
  Sink sink(f.lcm_url, f.record, f.force, f.room.empty() ? "main" : f.room);
  std::unique_ptr<LcmLink> lcm;
  if (LcmDriveOf(f)) {
    if (sink.bus() == nullptr) throw OperatorError("--drive lcm: not with --lcm-url none");
    lcm = std::make_unique<LcmLink>(*sink.bus(), *LcmDriveOf(f));
  }
  OsEntropy entropy;
  std::unique_ptr<RoomWatch> rooms;
  if (!f.directory.empty()) rooms = std::make_unique<RoomWatch>(f.directory, f.fleet, config.room);
  Client client(config, net, sink, entropy);
  const std::string hint = f.hint.empty() ? "" : "; " + f.hint;
  StopOnSignals();
  const std::int64_t begin = SteadyClockUs();
  CpuThrottle throttle(f.throttle);
  ProgressLine line(f.quiet);
  TroubleReport recording("seam-client", "the game goes on");
  std::string notice, waiting;
  Status followed;
  std::int64_t notice_until_us = 0;
  while (g_stop == 0 && !client.closed() && client.fatal().empty() && followed.ok()) {
    const std::int64_t now = SteadyClockUs();
    if (lcm != nullptr) {
      client.SetLiveInput(lcm->Read(now));
    } else if (config.drive == Drive::kLive) {
      const Input keys = keyboard != nullptr ? keyboard->Poll(now, client.running()) : Input();
      client.SetLiveInput(lines != nullptr ? Both(keys, lines->Poll()) : keys);
      if (keyboard != nullptr && keyboard->quit()) break;
    }
    const std::optional<FleetHolder> holder = rooms != nullptr ? rooms->newest() : std::nullopt;
    Address at;
    if (holder && ReadAddress(holder->address, &at)) client.Suggest(at, holder->epoch);
    if (rooms != nullptr) client.SuggestStandby(rooms->standby());
    client.Tick(now, static_cast<std::int64_t>(static_cast<double>(CpuUs()) * f.throttle));
    throttle.Slow();
    if (key_file != nullptr && client.key() != key_file->key()) key_file->Write(client.key());
    if (lcm != nullptr) followed = lcm->Follow(client);
    sink.Poll();
    recording.Look(sink.trouble(), line);
    const std::string told = client.TakeNotice();
    if (!told.empty()) {
      notice = told;
      notice_until_us = client.running() ? now + kNoticeUs : 0;
      waiting = told;
    }
    if (!told.empty() && view == nullptr) {
      line.End();
      std::fprintf(stderr, "seam-client: %s\n", told.c_str());
    }
    if (lcm != nullptr) lcm->Report("seam-client", line);
    const double elapsed_s = static_cast<double>(now - begin) * 1e-6;
    if (f.duration_s > 0 && elapsed_s > f.duration_s) {
      if (client.sessions() > 0) break;
      throw OperatorError((waiting.empty() ? NotIn(client) : waiting) + " (--duration " +
                          SecondsText(f.duration_s) + ")");
    }
    if (static_cast<double>(client.joining_us(now)) * 1e-6 > f.join_s) {
      if (rooms != nullptr && !holder && f.server.empty())
        throw OperatorError("--directory " + f.directory + ": " + rooms->trouble());
      throw OperatorError(NotIn(client) + "; gave up after " + SecondsText(f.join_s) +
                          " s (--join-timeout)");
    }
    const std::string state = client.running() ? ProgressText(client, elapsed_s)
                                               : WaitingText(client, waiting, elapsed_s);
    if (view != nullptr && view->Due(now)) {
      const std::string keys = (keyboard != nullptr ? kKeys : "Ctrl-C stops") + hint;
      view->Show(now, client, state, now < notice_until_us ? notice : keys);
    }
    if (view == nullptr && line.Due(now)) line.Show(now, state + "; Ctrl-C stops");
    const std::int64_t wake = std::min({client.next_tick_us(now), net.next_due_us(), now + 20000});
    const int other = keyboard != nullptr ? keyboard->fd() : lines != nullptr ? lines->fd() : -1;
    udp.Wait(std::max<std::int64_t>(0, wake - SteadyClockUs()), other);
  }
  line.End();
  view.reset();
  if (client.fatal().empty() || client.peer() >= 0) client.Shutdown(SteadyClockUs());
  DrainNetwork(udp, net);
  if (!client.fatal().empty()) throw OperatorError(client.fatal());
  if (!followed.ok()) throw OperatorError(followed.why());
  sink.Flush();
  recording.Look(sink.trouble(), line);
  const Stats& s = client.stats();
  const Replica* const replica = client.replica();
  std::fprintf(stderr,
               "seam-client: %s; %lld datagrams in, %lld out, %lld bad, %lld stale bodies\n"
               "seam-client: %lld corrections, %lld stepped again, %lld replays deferred; %lld bus "
               "failures\n",
               client.closed() ? "the server closed the room" : "left",
               static_cast<long long>(s.datagrams_in), static_cast<long long>(s.datagrams_out),
               static_cast<long long>(s.dropped_malformed), static_cast<long long>(s.dropped_stale),
               static_cast<long long>(client.corrections()),
               static_cast<long long>(replica == nullptr ? 0 : replica->ticks_stepped_again()),
               static_cast<long long>(replica == nullptr ? 0 : replica->replays_deferred()),
               static_cast<long long>(sink.failures()));
  return recording.End(sink.trouble());
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{
      "seam-client",
      "seam-client: simulate and show one player's part of a room",
      VersionLine("seam-client"),
      "",
      {{"--impair", ProfileNames()}, {"--drive", {"none", "bot", "keyboard", "lcm"}}}};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { Define(app, flags); }, [&] { return Play(flags); });
}
