/// Real programs over real UDP on this machine: seam-server on one core, seam-swarm on another.

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "common/base/check.h"
#include "tests/lab/relief/bar_rows.h"
#include "tests/lab/relief/benches.h"
#include "tests/lab/relief/relief_scene.h"
#include "tests/lab/relief/swarm_figures.h"
#include "tests/support/child_process.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

constexpr int kPort = 17790, kMetrics = 17791;
constexpr double kTickHz = 60;
/// A swarm that needs more of its core, %, or is later, ms, drives its clients less than it says.
constexpr double kSwarmMost = 90, kLateMost = 16;

bool KeptUp(const SwarmFigures& figures) {
  return figures.swarm_cpu <= kSwarmMost && figures.client_late_ms <= kLateMost;
}

/// CPU time of a tick of the only room's server, us.
double ServerUs(const SwarmFigures& figures) { return figures.server_cpu * 1e4 / kTickHz; }

struct UdpCase {
  std::string scene;  // a file, or a name
  int clients = 2;
  int rooms = 1;
  std::vector<std::string> server;  // more of its flags
  double seconds = 8;
};

/// A program beside this one. Throws OperatorError when it is not there.
std::string BesideThis(const char* name) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / name;
  if (!fs::exists(program)) throw OperatorError(std::string(name) + ": not beside this program");
  return program.string();
}

/// A folder for scenes, gone with the object.
class SceneFolder {
 public:
  SceneFolder() : path_((fs::temp_directory_path() / "seam-relief-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw OperatorError(path_ + ": cannot be made");
  }
  ~SceneFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;
  /// Its path.
  std::string Write(const ReliefRoom& room) const {
    const std::string file = path_ + "/relief.toml";
    std::ofstream(file, std::ios::binary) << ReliefText(room);
    return file;
  }

 private:
  std::string path_;
};

std::vector<std::string> Pinned(int core, std::vector<std::string> argv) {
  if (core >= 0) argv.insert(argv.begin(), {"taskset", "-c", std::to_string(core)});
  return argv;
}

SwarmFigures Run(const UdpCase& of, bool pinned) {
  SwarmFigures figures;
  std::vector<std::string> server = {BesideThis("seam-server"), of.scene};
  for (const std::string& flag :
       {std::string("--port"), std::to_string(kPort), std::string("--bind"),
        std::string("127.0.0.1"), std::string("--metrics"), std::to_string(kMetrics),
        std::string("--lcm-url"), std::string("none"), std::string("--publish"),
        std::string("none"), std::string("--duration"), std::string("0"), std::string("--wait"),
        std::string("0")}) {
    server.push_back(flag);
  }
  server.insert(server.end(), of.server.begin(), of.server.end());
  std::vector<std::string> swarm = {BesideThis("seam-swarm"),
                                    "127.0.0.1:" + std::to_string(kPort),
                                    "--clients",
                                    std::to_string(of.clients),
                                    "--for",
                                    fmt::format("{:.0f}s", of.seconds),
                                    "--metrics",
                                    "127.0.0.1:" + std::to_string(kMetrics),
                                    "--threads",
                                    pinned ? "1" : "2",
                                    "--join-timeout",
                                    "60",
                                    "--quiet"};
  if (of.rooms > 1) {
    swarm.insert(swarm.end(), {"--room", "main", "--rooms", std::to_string(of.rooms)});
  }
  ChildProcess serving(Pinned(pinned ? 0 : -1, server));
  for (int i = 0; i < 200 && serving.output().find("Ctrl-C ends it") == std::string::npos; ++i) {
    if (serving.Wait(0)) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ChildProcess clients(Pinned(pinned ? 1 : -1, swarm));
  const bool ended = clients.Wait(static_cast<int>(of.seconds) + 120);
  if (!ended || clients.exit_status() != 0) {
    const std::string said = clients.output();
    figures.failed = "seam-swarm: " + said.substr(0, said.find('\n'));
  } else {
    figures = ReadSwarm(clients.output());
  }
  serving.Stop(SIGTERM);
  return figures;
}

std::string GivenOf(const SwarmFigures& figures) {
  return fmt::format(
      "clients hold {:.0f} % of {:.0f} moving (≥ 80), swarm {:.0f} % of its core "
      "(≤ {:.0f}), {:.1f} ms late at p99 (≤ {:.0f})",
      figures.held, figures.moving, figures.swarm_cpu, kSwarmMost, figures.client_late_ms,
      kLateMost);
}

/// Nothing was measured where a program did not do what it should.
void LeaveOut(const std::string& failed, BarRow* row) {
  if (failed.empty()) return;
  row->measured = "–";
  row->given = failed;
  row->valid = false;
}

/// `buffer` beside `central` in turn.
void AddRelief(const SceneFolder& files, int players, double most, int pairs, double seconds,
               std::vector<BarRow>* rows) {
  ReliefRoom room;
  room.players = players;
  room.sleep = true;  // else as many are awake in central alone: buffer's holders let what lies lie
  UdpCase of;
  of.scene = files.Write(room);
  of.clients = players;
  of.seconds = seconds;
  std::vector<double> ratios, buffer_us, central_us;
  SwarmFigures buffer, central;
  std::string failed;
  for (int pair = 0; pair < pairs; ++pair) {
    of.server = {};
    buffer = Run(of, true);
    of.server = {"--mode", "central", "--predict", "all"};
    central = Run(of, true);
    failed += buffer.failed + central.failed;
    ratios.push_back(ServerUs(buffer) / ServerUs(central));
    buffer_us.push_back(ServerUs(buffer));
    central_us.push_back(ServerUs(central));
  }
  for (std::vector<double>* all : {&ratios, &buffer_us, &central_us}) {
    std::sort(all->begin(), all->end());
  }
  const auto middle = static_cast<std::size_t>(pairs / 2);
  BarRow row = AtMost(
      fmt::format("{} players, a car and 27 crates each: server CPU, buffer / central", players),
      ratios[middle], most, "",
      fmt::format("{:.0f} of {:.0f} µs a tick, kernel included", buffer_us[middle],
                  central_us[middle]));
  if (most <= 0) row.must.clear();
  row.given = failed.empty() ? "buffer: " + GivenOf(buffer) +
                                   fmt::format("; central: swarm {:.0f} %", central.swarm_cpu)
                             : failed;
  row.valid = failed.empty() && buffer.held >= 80 && KeptUp(buffer) && KeptUp(central);
  LeaveOut(failed, &row);
  rows->push_back(std::move(row));
}

void AddCrowd(const std::string& scene, const std::string& name, int clients, double p99_ms,
              double seconds, std::vector<BarRow>* rows) {
  UdpCase of;
  of.scene = scene;
  of.clients = clients;
  of.seconds = seconds;
  of.server = {"--budget", "64kB/s"};
  const SwarmFigures figures = Run(of, true);
  const auto add = [&](BarRow row) {
    row.given = figures.failed.empty() ? GivenOf(figures) : figures.failed;
    row.valid = figures.failed.empty() && figures.held >= 80 && KeptUp(figures);
    LeaveOut(figures.failed, &row);
    rows->push_back(std::move(row));
  };
  add(AtMost(name + ": p99 of the server's ticks", figures.tick_p99_ms, p99_ms, "ms",
             fmt::format("{:.0f} % of a core, {} kB/s to each", figures.server_cpu,
                         Digits(figures.kbps))));
  add(AtMost(name + ": a client's tick", figures.client_us, 45, "µs", "CPU, with its datagrams"));
}

/// All programs on all cores, rooms of little physics: p99 of how late clients and rooms are.
void AddRooms(const SceneFolder& files, int clients, int rooms, double seconds,
              std::vector<BarRow>* rows) {
  ReliefRoom room;
  room.players = (clients + rooms - 1) / rooms;
  room.each = 2;
  room.things = ReliefThings::kBalls;
  room.sleep = true;
  UdpCase of;
  of.scene = files.Write(room);
  of.clients = clients;
  of.rooms = rooms;
  of.seconds = seconds;
  of.server = {"--rooms", std::to_string(rooms), "--workers", "2"};
  const SwarmFigures figures = Run(of, false);
  BarRow row = AtMost(
      fmt::format("{} clients in {} rooms, a sled and a ball each: p99 of their lateness", clients,
                  rooms),
      figures.client_late_ms, 16, "ms", fmt::format("rooms {} ms", Digits(figures.late_p99_ms)));
  row.given =
      figures.failed.empty()
          ? fmt::format(
                "swarm {:.0f} % and server {:.0f} % of a core, slowest clock "
                "{:.0f} %, {:.0f} rejoins (0)",
                figures.swarm_cpu, figures.server_cpu, figures.slowest_clock, figures.rejoins)
          : figures.failed;
  row.valid = figures.failed.empty() && figures.rejoins == 0;
  LeaveOut(figures.failed, &row);
  rows->push_back(std::move(row));
}

}  // namespace

TextTable ReliefUdpBench(bool quick) {
  const int pairs = quick ? 1 : 3;
  const double seconds = quick ? 3 : 6;
  const SceneFolder files;
  std::vector<BarRow> rows;
  if (std::thread::hardware_concurrency() < 2) throw OperatorError("udp: needs two cores");
  AddRelief(files, 2, 0.5, pairs, seconds, &rows);
  if (!quick) {
    AddRelief(files, 9, 0, pairs, seconds, &rows);
    AddRelief(files, 30, 0.2, pairs, seconds, &rows);
    AddCrowd("swarm", "swarm, 256 players", 256, 5, seconds, &rows);
    AddCrowd("swarm1000", "swarm1000, 1000 players", 1000, 12, seconds, &rows);
    ReliefRoom balls;
    balls.players = 256;
    balls.each = 5;
    balls.spacing = 20;
    balls.things = ReliefThings::kBalls;
    AddCrowd(files.Write(balls), "256 players, a sled and 4 balls each", 256, 5, seconds, &rows);
    AddRooms(files, 1000, 64, seconds, &rows);
    AddRooms(files, 512, 64, seconds, &rows);
  }
  AddRooms(files, quick ? 16 : 256, quick ? 2 : 64, seconds, &rows);
  return TableOf("udp", "Over UDP", rows,
                 fmt::format("seam-server pinned to one core and seam-swarm to another of this "
                             "machine, {:.0f} s each; rooms: not pinned.",
                             seconds));
}

}  // namespace seam
