/// What an operator installs: the service, the alerts and the dashboard do what docs/operations.md
/// says.

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/base/check.h"
#include "common/base/json_text.h"
#include "common/base/plain_file.h"
#include "common/net/http_page.h"
#include "common/record/load_page.h"
#include "server/metrics_page.h"
#include "tests/support/in_namespace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace operations_test {

constexpr const char* kDeploy = "server/deploy/";
constexpr double kPatience = 30;

std::string TextOf(const std::string& path) {
  const std::string text = ReadPlainFile(path, 1 << 20);
  EXPECT_FALSE(text.empty()) << path;
  return text;
}

/// Returns the words of `text` that begin with one of `prefixes`.
std::set<std::string> WordsWith(const std::string& text, const std::vector<std::string>& prefixes) {
  std::set<std::string> words;
  const auto part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && part(text[end])) ++end;
    const std::string word = text.substr(at, end - at);
    for (const std::string& prefix : prefixes) {
      if (word.rfind(prefix, 0) == 0 && word != prefix) words.insert(word);
    }
    at = end + 1;
  }
  return words;
}

/// A server's page has a metric with a HELP line for each of them.
TEST(Operations, AlertsAndDashboardAskForMetricsThatTheServerHas) {
  RoomLoad room;
  room.room = "main";
  const std::string page = WriteLoadPage({room}) + ProcessMetrics() + "# HELP seam_directory_up \n";
  std::set<std::string> asked = WordsWith(
      TextOf(std::string(kDeploy) + "rules.yml") + TextOf(std::string(kDeploy) + "dashboard.json"),
      {"seam_", "process_"});
  ASSERT_GT(asked.size(), 15u);
  for (std::string name : asked) {
    const std::size_t bucket = name.rfind("_bucket");
    if (bucket != std::string::npos) name.erase(bucket);
    EXPECT_NE(page.find("# HELP " + name + " "), std::string::npos) << name;
  }
}

TEST(Operations, EachAlertHasARowThatSaysWhatToDo) {
  const std::string rules = TextOf(std::string(kDeploy) + "rules.yml");
  const std::string page = TextOf("docs/operations.md");
  int alerts = 0;
  for (const std::string& name : WordsWith(rules, {"Seam"})) {
    EXPECT_NE(page.find("| `" + name + "` | "), std::string::npos) << name;
    ++alerts;
  }
  EXPECT_EQ(alerts, 11);
}

TEST(Operations, AlertsFireInTroubleAndNotInHealth) {
  Program version({"promtool", "--version"});
  if (!version.Wait(kPatience) || version.status() != 0) {
    GTEST_SKIP() << "no promtool: apt install prometheus";
  }
  Program test({"promtool", "test", "rules", "rules_test.yml"}, Root() / kDeploy);
  EXPECT_TRUE(test.Wait(kPatience) && test.status() == 0) << test.Story();
  // And the test can fail: a threshold that never holds.
  const Workspace folder;
  std::string rules = TextOf(std::string(kDeploy) + "rules.yml");
  const std::string threshold = "seam_distrusted > 0";
  rules.replace(rules.find(threshold), threshold.size(), "seam_distrusted > 9");
  folder.Write("rules.yml", rules);
  folder.Write("rules_test.yml", TextOf(std::string(kDeploy) + "rules_test.yml"));
  Program spoilt({"promtool", "test", "rules", "rules_test.yml"}, folder.path());
  EXPECT_TRUE(spoilt.Wait(kPatience) && spoilt.status() != 0) << spoilt.Story();
}

TEST(Operations, TheUnitIsOneThatSystemdTakes) {
  const Workspace folder;
  folder.Write("seam-server@x.service", TextOf(std::string(kDeploy) + "seam-server@.service"));
  Program verify({"systemd-analyze", "verify", folder / "seam-server@x.service"});
  if (!verify.Wait(kPatience) || verify.status() == 127) GTEST_SKIP() << "no systemd-analyze";
  EXPECT_EQ(verify.errors(), "") << verify.Story();
}

/// Returns the command of the unit as systemd hands it to the shell, for these programs and rooms.
std::vector<std::string> Start(const std::string& state, const std::string& wait = "0") {
  const std::string unit = TextOf(std::string(kDeploy) + "seam-server@.service");
  const std::string key = "ExecStart=/bin/sh -ec '";
  const std::size_t begin = unit.find(key) + key.size();
  std::string command = unit.substr(begin, unit.find("'\n", begin) - begin);
  const std::string program = "/usr/local/bin/seam-server";
  command.replace(command.find(program), program.size(), BuiltProgram("seam-server"));
  return {"env",
          "STATE_DIRECTORY=" + state,
          "SCENES=" + (Root() / "scenes/crossing.toml").string(),
          "OPTIONS=--wait " + wait +
              " --duration 0 --bind 127.0.0.1 --port 7841 --metrics 9475 "
              "--metrics-bind 127.0.0.2 --events " +
              state + "/events.json",
          "/bin/sh",
          "-ec",
          command};
}

class Service : public InNamespace {};

/// The second start finds the room of the first, killed one.
TEST_F(Service, TheUnitBeginsARoomAndGoesOnWithIt) {
  SEAM_INSIDE_ONLY();
  const Workspace state;
  std::int64_t tick = 0;
  for (int life = 0; life < 3; ++life) {
    Program server(Start(state.path()));
    ASSERT_TRUE(server.WaitForErrors("its key is", kPatience)) << server.Story();
    std::vector<RoomLoad> rooms;
    std::string page;
    for (int i = 0; i < 300 && (rooms.empty() || rooms[0].load.tick < tick + 60); ++i) {
      usleep(100000);
      const Status status = FetchPage("127.0.0.2:9475", 1000000, &page);
      if (status.ok()) rooms = ReadLoadPage(page);
    }
    ASSERT_EQ(rooms.size(), 1u) << server.Story();
    EXPECT_GE(rooms[0].load.tick, tick + 60) << "life " << life << ": " << server.Story();
    tick = rooms[0].load.tick;
    EXPECT_NE(page.find("process_resident_memory_bytes "), std::string::npos);
    EXPECT_NE(page.find("seam_build_info{version=\""), std::string::npos);
    std::string none;
    EXPECT_FALSE(FetchPage("127.0.0.1:9475", 1000000, &none).ok()) << "only where it was bound";
    server.Signal(life == 1 ? SIGTERM : SIGKILL);
    ASSERT_TRUE(server.Wait(kPatience)) << server.Story();
  }
  const std::string events = ReadPlainFile(state / "events.json", 1 << 20);
  EXPECT_NE(events.find("{\"room\":\"main\",\"scene\":\"crossing\",\"tick\":"), std::string::npos)
      << events;
  EXPECT_NE(events.find("\"kind\":\"started\""), std::string::npos) << events;
  EXPECT_NE(events.find("\"kind\":\"resumed\""), std::string::npos) << events;
}

TEST_F(Service, TheUnitBeginsARoomThatEndedBeforeItsFirstTick) {
  SEAM_INSIDE_ONLY();
  const Workspace state;
  for (const int end : {SIGTERM, SIGKILL, SIGTERM}) {
    Program server(Start(state.path(), "2"));  // nobody comes
    ASSERT_TRUE(server.WaitForErrors("Ctrl-C ends it", kPatience)) << server.Story();
    server.Signal(end);
    ASSERT_TRUE(server.Wait(kPatience)) << server.Story();
  }
}

TEST(MetricsPage, TheLatestOfManyRoomsAreShown) {
  std::vector<RoomLoad> rooms(5);
  for (int i = 0; i < 5; ++i) {
    rooms[static_cast<std::size_t>(i)].room = "r" + std::to_string(i);
    rooms[static_cast<std::size_t>(i)].load.late_p99_us = i * 7 % 5;
  }
  const std::vector<RoomLoad> worst = WorstRooms(rooms, 2);
  ASSERT_EQ(worst.size(), 2u);
  EXPECT_EQ(worst[0].room + worst[1].room, "r2r4");
  EXPECT_EQ(WorstRooms(rooms, 9).size(), 5u);
}

TEST(MetricsPage, WrongFlagsAreOneLineEach) {
  const auto failure = [](int port, const std::string& bind, const std::string& rooms) {
    ServerFlags flags;
    flags.metrics_port = port;
    flags.metrics_bind = bind;
    flags.metrics_rooms = rooms;
    try {
      const MetricsPage page(flags);
    } catch (const OperatorError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(failure(0, "", "all"), "");
  for (const char* rooms : {"", "worst", "worst:", "worst:0", "worst:-1", "worst:1x", "some"}) {
    EXPECT_NE(failure(9476, "", rooms).find("--metrics-rooms takes"), std::string::npos) << rooms;
  }
  EXPECT_NE(failure(0, "::", "all").find("are for the page of --metrics"), std::string::npos);
  EXPECT_NE(failure(9476, "here", "all").find("cannot serve a page at here port 9476"),
            std::string::npos);
  EXPECT_NE(failure(9476, "192.0.2.77", "all").find("cannot serve a page at"), std::string::npos);
}

}  // namespace operations_test
}  // namespace seam
