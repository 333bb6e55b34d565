/// seam-swarm, seam-top and servers of one room and several, with real processes over loopback.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <map>

#include "common/net/http_page.h"
#include "common/record/load_page.h"
#include "common/record/recording.h"
#include "tests/lab/relief/swarm_figures.h"
#include "tests/support/in_namespace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace swarm_test {

using Words = std::vector<std::string>;

/// The longest that anything is waited for, s; a busy machine takes its time.
constexpr double kPatience = 90;

class SwarmProgram : public InNamespace {
 protected:
  /// A server at a port of its own, with its page at the port 100 above.
  std::unique_ptr<Program> Serve(int port, Words words) {
    words.insert(words.begin(), BuiltProgram("seam-server"));
    const Words rest = {"--port",
                        std::to_string(port),
                        "--bind",
                        "127.0.0.1",
                        "--lcm-url",
                        "none",
                        "--duration",
                        "0",
                        "--quiet",
                        "--metrics",
                        std::to_string(port + 100)};
    words.insert(words.end(), rest.begin(), rest.end());
    auto server = std::make_unique<Program>(words);
    EXPECT_TRUE(server->WaitForErrors("Ctrl-C ends it", kPatience)) << server->Story();
    return server;
  }
  static std::unique_ptr<Program> Swarm(int port, const Words& words) {
    Words all = {BuiltProgram("seam-swarm"), "127.0.0.1:" + std::to_string(port), "--quiet"};
    all.insert(all.end(), words.begin(), words.end());
    return std::make_unique<Program>(all);
  }
  static std::vector<RoomLoad> Loads(int port) {
    std::string page;
    const Status status = FetchPage("127.0.0.1:" + std::to_string(port + 100), 5000000, &page);
    EXPECT_TRUE(status.ok()) << status.why();
    return ReadLoadPage(page);
  }
  Workspace folder_;
};

/// The first number that follows `before` in `text`; -1: none.
double NumberAfter(const std::string& text, const std::string& before) {
  const std::size_t at = text.find(before);
  return at == std::string::npos ? -1 : std::atof(text.c_str() + at + before.size());
}

TEST_F(SwarmProgram, FourClientsPlayForThreeSecondsAndLeaveCleanly) {
  SEAM_INSIDE_ONLY();
  const auto server = Serve(17500, {"playground"});
  const auto swarm = Swarm(17500, {"--clients", "4", "--drive", "bot", "--for", "3s", "--threads",
                                   "2", "--metrics", "127.0.0.1:17600"});
  ASSERT_TRUE(swarm->Wait(kPatience));
  EXPECT_EQ(swarm->status(), 0) << swarm->Story();
  const std::string said = swarm->output();
  EXPECT_NE(said.find("swarm: 4 client(s) in 1 room(s), scene playground, mode buffer"),
            std::string::npos)
      << said;
  // Three seconds of four clients are 720 ticks; a busy machine may give them a second more or
  // less.
  EXPECT_GT(NumberAfter(said, "ms of "), 480) << said;
  EXPECT_LT(NumberAfter(said, "ms of "), 1100) << said;
  EXPECT_GT(NumberAfter(said, "client load: "), 0) << "they tell what they use\n" << said;
  EXPECT_GT(NumberAfter(said, "client bytes: in "), 0.5) << said;
  EXPECT_GT(NumberAfter(said, "moving: clients hold "), 80) << said;
  EXPECT_GT(NumberAfter(said, "server: tick p50 "), 0) << said;
  const std::string tick = said.substr(said.find("server: tick p50 "));
  const Regex whole(
      "server: tick p50 [0-9.]+ ms, p99 [0-9.]+ ms, [0-9.]+ ms in the worst second,.*");
  EXPECT_TRUE(whole.Matches(tick.substr(0, tick.find('\n')))) << said;
  EXPECT_GT(NumberAfter(tick, ", p99 "), 0) << said;
  EXPECT_EQ(NumberAfter(said, "server room: "), 1) << said;
  const SwarmFigures figures = ReadSwarm(said);
  EXPECT_EQ(figures.held, NumberAfter(said, "moving: clients hold "));
  EXPECT_GT(figures.moving, 1) << said;
  EXPECT_GT(figures.tick_p99_ms, 0) << said;
  EXPECT_GT(figures.server_cpu, 0) << said;
  EXPECT_GT(figures.swarm_cpu, 0) << said;
  EXPECT_GT(figures.client_us, 0) << said;
  EXPECT_EQ(figures.rejoins, 0) << said;
  EXPECT_GT(figures.slowest_clock, 0) << said;
  // The clients are gone at once: they said goodbye.
  std::vector<RoomLoad> loads = Loads(17500);
  for (int i = 0; i < 30 && !loads.empty() && loads[0].load.clients > 0; ++i) {
    usleep(100000);
    loads = Loads(17500);
  }
  ASSERT_EQ(loads.size(), 1u);
  EXPECT_EQ(loads[0].load.clients, 0);
  EXPECT_GT(loads[0].tick.count, 120) << "each of its ticks is counted";
  EXPECT_EQ(loads[0].late.count, loads[0].tick.count);
  EXPECT_GT(loads[0].tick.sum_us, 0);
  server->Signal(SIGINT);
  EXPECT_TRUE(server->Wait(kPatience));
  EXPECT_EQ(server->status(), 0) << server->Story();
}

/// All of a file, "" if there is none.
std::string Contents(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(SwarmProgram, ItsHeapIsOnHugePagesIfTheSystemHasAny) {
  SEAM_INSIDE_ONLY();
  const std::string offered = Contents("/sys/kernel/mm/transparent_hugepage/enabled");
  if (offered.empty() || offered.find("[never]") != std::string::npos) GTEST_SKIP() << offered;
  const auto server = Serve(17507, {"playground"});
  const auto swarm = Swarm(17507, {"--clients", "4", "--for", "3s", "--threads", "1"});
  const std::string of = "/proc/" + std::to_string(swarm->pid()) + "/";
  double huge_kb = 0;
  for (int i = 0; i < 10 * kPatience && huge_kb <= 0 && !swarm->Wait(0.1); ++i) {
    huge_kb = NumberAfter(Contents(of + "smaps_rollup"), "AnonHugePages:");
  }
  EXPECT_GT(huge_kb, 0) << swarm->Story();
  EXPECT_EQ(Contents(of + "comm"), "seam-swarm\n") << "it was started anew under its name";
  ASSERT_TRUE(swarm->Wait(kPatience));
  EXPECT_EQ(swarm->status(), 0) << swarm->Story();
}

TEST_F(SwarmProgram, MoreClientsThanPlayersNoServerAndWrongTimesAreOneLineEach) {
  SEAM_INSIDE_ONLY();
  const auto server = Serve(17501, {"crossing"});
  const std::pair<Words, std::string> cases[] = {
      {{"--clients", "5"},
       "seam-swarm: --clients 5: room main would get 5, but its scene crossing has 2 player(s)\n"},
      {{"--clients", "2", "--room", "nowhere"},
       "seam-swarm: the server refuses: there is no such room here: the room is main\n"},
      {{"--for", "soon"}, "seam-swarm: --for takes a time as 60s or 5m, not \"soon\"\n"},
      {{"--for", "-3s"}, "seam-swarm: --for takes a time as 60s or 5m, not \"-3s\"\n"},
      {{"--clients", "1", "--join-timeout", "2"},
       "seam-swarm: 0 of 1 clients play after --join-timeout; a room begins when as many players "
       "are there as its server waits for (--wait)\n"}};
  for (const auto& [words, line] : cases) {
    const auto swarm = Swarm(17501, words);
    ASSERT_TRUE(swarm->Wait(kPatience)) << line;
    EXPECT_EQ(swarm->status(), 2) << line;
    EXPECT_EQ(swarm->errors(), line);
    EXPECT_EQ(swarm->output(), "");
  }
  const auto nobody = Swarm(17502, {});
  ASSERT_TRUE(nobody->Wait(kPatience));
  EXPECT_EQ(nobody->errors(), "seam-swarm: no answer from 127.0.0.1:17502 within 10 s\n");
}

TEST_F(SwarmProgram, CtrlCEndsItWithItsReportAndItsClientsSayGoodbye) {
  SEAM_INSIDE_ONLY();
  const auto server = Serve(17503, {"crossing"});
  const auto swarm = Swarm(17503, {"--clients", "2", "--for", "10m"});
  for (int i = 0; i < 600; ++i) {
    const std::vector<RoomLoad> loads = Loads(17503);
    if (!loads.empty() && loads[0].load.tick > 60) break;
    usleep(100000);
  }
  swarm->Signal(SIGINT);
  ASSERT_TRUE(swarm->Wait(kPatience));
  EXPECT_EQ(swarm->status(), 0) << swarm->Story();
  EXPECT_NE(swarm->output().find("client lateness: p50 "), std::string::npos) << swarm->Story();
  std::vector<RoomLoad> loads = Loads(17503);
  for (int i = 0; i < 30 && loads[0].load.clients > 0; ++i) {
    usleep(100000);
    loads = Loads(17503);
  }
  EXPECT_EQ(loads[0].load.clients, 0);
}

TEST_F(SwarmProgram, SixRoomsOfTwoScenesAreFilledRecordedAndShown) {
  SEAM_INSIDE_ONLY();
  const std::string log = folder_ / "rooms.lcm";
  const auto server = Serve(17504, {"crossing", "headon", "--rooms", "6", "--workers", "2",
                                    "--room", "hall", "--record", log});
  const auto swarm =
      Swarm(17504, {"--clients", "12", "--room", "hall", "--rooms", "6", "--for", "4s"});
  Program top({BuiltProgram("seam-top"), "127.0.0.1:17604", "--times", "2"});
  ASSERT_TRUE(swarm->Wait(kPatience));
  EXPECT_EQ(swarm->status(), 0) << swarm->Story();
  ASSERT_TRUE(top.Wait(kPatience));
  EXPECT_EQ(top.status(), 0) << top.Story();
  std::map<std::string, Load> loads;
  for (const RoomLoad& load : Loads(17504)) loads[load.room] = load.load;
  ASSERT_EQ(loads.size(), 6u);
  server->Signal(SIGTERM);
  ASSERT_TRUE(server->Wait(kPatience));
  EXPECT_EQ(server->status(), 0) << server->Story();
  for (int r = 1; r <= 6; ++r) {
    const std::string room = "hall-" + std::to_string(r);
    SCOPED_TRACE(room);
    EXPECT_NE(top.output().find(room), std::string::npos) << top.output();
    EXPECT_GT(loads[room].tick, 120);
    // Each log is of its own room, from the beginning.
    const Recording recording = ReadRecording(folder_ / ("rooms." + room + ".lcm"));
    EXPECT_EQ(recording.room.room, room);
    EXPECT_EQ(recording.room.scene_name, r % 2 == 1 ? "crossing" : "headon");
    EXPECT_EQ(recording.room.seed, r);
    EXPECT_GT(recording.last_tick, 120);
    EXPECT_GE(recording.loads.size(), 3u);
    EXPECT_EQ(recording.foreign + recording.undecodable, 0);
  }
}

}  // namespace swarm_test
}  // namespace seam
