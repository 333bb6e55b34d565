/// What `buffer` takes off the server beside `central`, in virtual time: sessions of both in turn.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/measure/measure.h"
#include "common/measure/oracle.h"
#include "tests/lab/load/load.h"
#include "tests/lab/relief/bar_rows.h"
#include "tests/lab/relief/benches.h"
#include "tests/lab/relief/relief_scene.h"
#include "tests/lab/session.h"

namespace seam {
namespace {

constexpr int kPairs = 3;

struct ServerCase {
  const char* name;
  ReliefRoom room;
  double cpu_most;     // of `buffer` by `central`; 0: no bar
  double bytes_most;   // kB/s to a client; 0: no bar
  double client_most;  // us a tick of a client; 0: no bar
};

std::vector<ServerCase> ServerCases() {
  ReliefRoom crates, balls;
  crates.sleep = true;
  balls.things = ReliefThings::kBalls;
  balls.spacing = 36;
  ReliefRoom two = crates, nine = crates;
  two.players = 2;
  nine.players = 9;
  return {{"2 players, a car and 27 crates each", two, 0.5, 0, 0},
          {"9 players, the same", nine, 0, 0, 0},
          {"30 players, the same", crates, 0.2, 40, 683.0 / 5},
          {"30 players, a sled and 29 balls each", balls, 0.35, 25, 683.0 / 5}};
}

ClusterConfig ConfigOf(const ServerCase& of, bool central, std::int64_t seed, double seconds) {
  ClusterConfig config;
  config.scene = "relief";
  config.scene_text = ReliefText(of.room);
  config.mode = central ? "central" : "buffer";
  config.predict = central ? "all" : "";
  config.drive = Drive::kBot;
  config.publish = Publish::kNone;
  config.seed = seed;
  config.duration_s = seconds;
  return config;
}

double Median(std::vector<double> of) {
  std::sort(of.begin(), of.end());
  return of[of.size() / 2];
}

/// Of `buffer` beside `central`, medians over pairs.
struct Pairs {
  std::vector<double> ratio, buffer_us, central_us, client_us, kbps, central_kbps, split;
  double held_least = 1, awake_apart = 0;  // shares of what is awake
  SessionLoad last, last_central;

  void Add(const SessionLoad& buffer, const SessionLoad& central) {
    ratio.push_back(buffer.server_us / central.server_us);
    buffer_us.push_back(buffer.server_us);
    central_us.push_back(central.server_us);
    client_us.push_back(buffer.client_us);
    kbps.push_back(buffer.to_client_kbps);
    central_kbps.push_back(central.to_client_kbps);
    split.push_back(buffer.split_share);
    held_least = std::min(held_least, buffer.held_share);
    awake_apart = std::max(awake_apart, std::fabs(buffer.awake / central.awake - 1));
    last = buffer;
    last_central = central;
  }
};

void AddRows(const ServerCase& of, const Pairs& pairs, std::vector<BarRow>* rows) {
  const std::string given = fmt::format(
      "clients hold {:.0f} % (≥ 80); awake {:.0f} and {:.0f} of {} (10 % apart at most)",
      100 * pairs.held_least, pairs.last.awake, pairs.last_central.awake, pairs.last.bodies);
  const bool valid = pairs.held_least >= 0.8 && pairs.awake_apart <= 0.1;
  const auto add = [&](BarRow row) {
    row.given = given;
    row.valid = valid;
    rows->push_back(std::move(row));
  };
  const std::string name = of.name;
  const auto bar = [](double value, double most, const std::string& unit, const std::string& figure,
                      const std::string& detail) {
    if (most > 0) return AtMost(figure, value, most, unit, detail);
    return Printed(figure, Digits(value) + (unit.empty() ? "" : " " + unit) + " (" + detail + ")");
  };
  add(bar(Median(pairs.ratio), of.cpu_most, "", name + ": server CPU, buffer / central",
          fmt::format("{:.0f} of {:.0f} µs a tick", Median(pairs.buffer_us),
                      Median(pairs.central_us))));
  add(bar(Median(pairs.client_us), of.client_most, "µs", name + ": a client's tick", "CPU"));
  add(bar(Median(pairs.kbps), of.bytes_most, "kB/s", name + ": bytes to a client",
          fmt::format("central {}", Digits(Median(pairs.central_kbps)))));
  add(AtMost(name + ": touching pairs with two owners", 100 * Median(pairs.split), 8, "%"));
}

/// How far clients show the bodies of others from the oracle's, m.
double ErrorOf(const ServerCase& of, bool central, double seconds) {
  ClusterConfig config = ConfigOf(of, central, 1, seconds);
  config.publish = Publish::kAll;
  Cluster cluster(config);
  cluster.Run();
  RequireScripts(cluster.server());
  const Recording& recording = cluster.recording();
  return Measure(recording, ComputeOracle(recording)).error_others_m.value_or(NAN);
}

}  // namespace

TextTable ReliefServerBench(bool quick) {
  const double seconds = quick ? 2 : 4;
  std::vector<BarRow> rows;
  for (const ServerCase& of : ServerCases()) {
    const bool many = of.room.players > 9;  // each of whom simulates all of it in mode central
    if (quick && many) continue;
    Pairs pairs;
    // With many players central takes long: its one session stands beside all of buffer's.
    SessionLoad central;
    for (int seed = 1; seed <= (quick ? 1 : kPairs); ++seed) {
      const SessionLoad buffer = MeasureLoad(ConfigOf(of, false, seed, seconds));
      if (!many || seed == 1) central = MeasureLoad(ConfigOf(of, true, seed, seconds));
      pairs.Add(buffer, central);
    }
    AddRows(of, pairs, &rows);
    std::string error = Digits(ErrorOf(of, false, seconds)) + " m";
    if (!many) error += " (central " + Digits(ErrorOf(of, true, seconds)) + ")";
    rows.push_back(Printed(std::string(of.name) + ": error of others", error));
  }
  return TableOf(
      "server", "What it takes off the server, in virtual time", rows,
      fmt::format(
          "Sessions of {:.0f} s over `demo`, bots, players 30 m apart (with balls 36), in turn "
          "with "
          "`central --predict all`, which has the same interest and packets, after the first "
          "second: "
          "medians of {} pairs, with 30 players beside one session of it. CPU of all that the "
          "server does but the "
          "socket. The error counts what is far away as well, which is reckoned.",
          seconds, quick ? 1 : kPairs));
}

}  // namespace seam
