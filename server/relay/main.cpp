/// seam-relay: passes a room on to watchers. `seam-relay --help`.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "client/join_flags.h"
#include "client/progress_text.h"
#include "common/base/command_line.h"
#include "common/base/hex.h"
#include "common/base/process.h"
#include "common/base/progress_line.h"
#include "common/codec/version_line.h"
#include "common/fleet/room_watch.h"
#include "common/net/secret_file.h"
#include "common/net/udp.h"
#include "server/relay/relay.h"
#include "server/relay/upstream_lines.h"
#include "server/server_flags.h"

namespace {

using namespace seam;

struct Flags : JoinFlags {
  int port = 7778;
  std::string bind = "[::]";
  int watchers = 1000;
  std::string budget;  // "": kClientBytesPerS
  std::string play_at;
  std::string identity, token_key;
  double duration_s = 0;
  double join_s = 30;
  bool quiet = false;
};

void Define(Command& app, Flags& f) {
  app.Option("server", f.server, "host:port of the seam-server to watch (port 7777 if left out)");
  app.Option("--port", f.port, "UDP port for watchers").Range(1, 65535);
  app.Option("--bind", f.bind, "address to listen on (default: all, of IPv4 and IPv6)");
  app.Option("--watchers", f.watchers, "most watchers at a time").Range(1, 65535);
  app.Option("--budget", f.budget,
             "most that each watcher is sent, such as 64kB/s (default 256kB/s; 0: no limit)");
  app.Option("--play-at", f.play_at,
             "host:port at which players who come here are sent to join (default: the server's "
             "address)");
  app.Option("--name", f.name, "name under which it watches (default: guest, guest-2, ...)");
  DefineJoin(app, f);
  app.Option("--identity", f.identity,
             "keep the relay's key in this file (mode 0600; made if there is none), so that it is "
             "the same after a restart");
  app.Option("--token-key", f.token_key,
             "let in only those with a token that seam-token made with the key in this file");
  app.Option("--duration", f.duration_s, "seconds to run (0: until stopped)").Range(0.0, 1e6);
  app.Option("--join-timeout", f.join_s, "seconds to try to join the server, at first or again")
      .Range(0.1, 1e6);
  app.Switch("--quiet", f.quiet, "no progress line");
}

RelayConfig Configure(const Flags& f) {
  if (f.server.empty() && f.directory.empty()) {
    throw OperatorError("which server? for example: seam-relay 127.0.0.1:7777");
  }
  if (std::isnan(f.duration_s)) throw OperatorError("--duration must be a number of seconds");
  if (std::isnan(f.join_s)) throw OperatorError("--join-timeout must be a number of seconds");
  RelayConfig config;
  config.upstream = JoinConfig(f);
  config.limits.watchers = f.watchers;
  config.limits.bytes_per_s = f.budget.empty() ? kClientBytesPerS : ParseBudget(f.budget);
  if (!f.play_at.empty()) {
    const Address play_at = ParseAddress(f.play_at, 7777);
    if (play_at.port == 0) throw OperatorError("--play-at " + f.play_at + ": no server has port 0");
    config.play_at = ToString(play_at);
  }
  OsEntropy entropy;
  config.identity = std::make_shared<const KeyPair>(
      f.identity.empty() ? Secret(entropy) : KeepSecretFile("--identity", f.identity, entropy));
  if (!f.token_key.empty()) {
    config.token_key = std::make_shared<const Secret>(ReadSecretFile("--token-key", f.token_key));
  }
  return config;
}

/// Returns "the relay of main: 12 watchers, tick 345, 0.05 s behind".
std::string StateOf(const Relay& relay) {
  if (!relay.client().running()) return "joining " + ToString(relay.client().server());
  char text[120];
  std::snprintf(text, sizeof text, ": %d watchers, tick %lld, %.2f s behind its server",
                relay.watchers().ready(), static_cast<long long>(relay.client().replica()->tick()),
                relay.client().lag_us() * 1e-6);
  return "relay of " + relay.client().room().room + text;
}

int PassOn(const Flags& f) {
  const RelayConfig config = Configure(f);
  UdpNet upstream(kAnyAddress);
  UdpNet downstream(ParseAddress(f.bind, static_cast<std::uint16_t>(f.port)));
  OsEntropy entropy;
  std::unique_ptr<RoomWatch> rooms;
  if (!f.directory.empty()) rooms = std::make_unique<RoomWatch>(f.directory, f.fleet, f.room);
  Relay relay(config, upstream, downstream, entropy);
  StopOnSignals();
  std::fprintf(stderr, "seam-relay: joins %s, for watchers on %s\nseam-relay: its key is %s\n",
               ToString(config.upstream.server).c_str(), ToString(downstream.local()).c_str(),
               ToHex(config.identity->open.data(), config.identity->open.size()).c_str());
  const std::int64_t begin = SteadyClockUs();
  ProgressLine line(f.quiet);
  UpstreamLines upstream_lines;
  int most = 0;
  while (g_stop == 0 && !relay.closed() && relay.fatal().empty()) {
    const std::int64_t now = SteadyClockUs();
    const std::optional<FleetHolder> holder = rooms != nullptr ? rooms->newest() : std::nullopt;
    Address at;
    if (holder && ReadAddress(holder->address, &at)) relay.Suggest(at, holder->epoch);
    if (rooms != nullptr) relay.SuggestStandby(rooms->standby());
    relay.Tick(now);
    most = std::max(most, relay.watchers().ready());
    const std::string told = upstream_lines.Next(relay.client());
    if (!told.empty()) {
      line.End();
      std::fprintf(stderr, "seam-relay: %s\n", told.c_str());
    }
    if (f.duration_s > 0 && static_cast<double>(now - begin) * 1e-6 > f.duration_s) break;
    if (static_cast<double>(relay.joining_us(now)) * 1e-6 > f.join_s) {
      relay.Shutdown(now, "the relay has lost its server");
      throw OperatorError(
          (relay.client().sessions() == 0 ? "no answer from " : "lost the server ") +
          ToString(relay.client().server()) + "; gave up after " + SecondsText(f.join_s) +
          " s (--join-timeout)");
    }
    if (line.Due(now)) line.Show(now, StateOf(relay) + "; Ctrl-C stops");
    const std::int64_t wake = std::min(relay.next_tick_us(now), now + 20000);
    downstream.Wait(std::max<std::int64_t>(0, wake - SteadyClockUs()), upstream.fd());
  }
  line.End();
  relay.Shutdown(SteadyClockUs(), relay.closed() ? "the server closed the room" : "the relay ends");
  if (!relay.fatal().empty()) throw OperatorError(relay.fatal());
  const Stats& s = relay.watchers().stats();
  std::fprintf(stderr,
               "seam-relay: %s; %d watchers at most; %lld datagrams to them, %lld from them, %lld "
               "bad\n",
               relay.closed() ? "the server closed the room" : "left", most,
               static_cast<long long>(s.datagrams_out), static_cast<long long>(s.datagrams_in),
               static_cast<long long>(s.dropped_malformed + s.dropped_right + s.dropped_budget));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{"seam-relay",
                         "seam-relay: pass a room on to many watchers",
                         VersionLine("seam-relay"),
                         "",
                         {}};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { Define(app, flags); }, [&] { return PassOn(flags); });
}
