/// seam-lab relief: its rooms have the stated size, and its verdicts are right.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "common/base/check.h"
#include "common/physics/world.h"
#include "tests/lab/load/load.h"
#include "tests/lab/relief/bar_rows.h"
#include "tests/lab/relief/relief_scene.h"
#include "tests/lab/relief/swarm_figures.h"
#include "tests/lab/report/report.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_relief_test {

TEST(LabRelief, ARoomHasTheRequestedPlayersAndBodies) {
  for (const ReliefThings things : {ReliefThings::kCrates, ReliefThings::kBalls}) {
    for (const int players : {1, 2, 30}) {
      for (const int each : {4, 15, 30}) {
        ReliefRoom room;
        room.players = players;
        room.each = each;
        room.things = things;
        const Scene scene = ParseScene(ReliefText(room), "relief.toml");
        EXPECT_EQ(scene.players.size(), static_cast<std::size_t>(players));
        EXPECT_EQ(World(scene).body_count(), players * each);
      }
    }
  }
}

TEST(LabRelief, CarsRunIntoCratesAndBallsBounce) {
  for (const ReliefThings things : {ReliefThings::kCrates, ReliefThings::kBalls}) {
    ReliefRoom room;
    room.players = 2;
    room.things = things;
    ClusterConfig config;
    config.scene = "relief";
    config.scene_text = ReliefText(room);
    config.drive = Drive::kScript;
    config.keep = false;
    config.duration_s = 4;
    Cluster cluster(config);
    cluster.RunToTick(60);
    std::vector<float> before;
    const World& world = cluster.server().replica().world();
    for (int body = 0; body < world.body_count(); ++body) {
      before.push_back(world.Read(body).position.x());
    }
    cluster.Run();
    int moved = 0;
    double up = 0;
    for (int body = 0; body < world.body_count(); ++body) {
      const Vec2 at = world.Read(body).position;
      moved += std::fabs(at.x() - before[static_cast<std::size_t>(body)]) > 0.5f ? 1 : 0;
      up += double{at.y()} / world.body_count();
    }
    if (things == ReliefThings::kCrates) {
      EXPECT_GE(moved, 2 * 6) << "both cars of three bodies, and crates in front of them";
    } else {
      EXPECT_GT(up, 1) << "balls lie on the ground";
    }
  }
}

TEST(LabRelief, VerdictsAreMetMissedOrNotValid) {
  BarRow met = AtMost("a", 0.2, 0.2, ""), missed = AtMost("b", 0.21, 0.2, "m");
  BarRow nothing = AtMost("c", std::numeric_limits<double>::quiet_NaN(), 1, "");
  BarRow without = AtMost("d", 0.1, 0.2, "");
  without.given = "nobody held anything";
  without.valid = false;
  const TextTable table =
      TableOf("x", "X", {met, missed, nothing, without, Printed("e", "5 m")}, "");
  EXPECT_EQ(table.name, "relief-x");
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[0].back(), "met");
  EXPECT_EQ(table.rows[1].back(), "missed");
  EXPECT_EQ(table.rows[1][1], "0.21 m");
  EXPECT_EQ(table.rows[1][2], "≤ 0.2 m");
  EXPECT_EQ(table.rows[2].back(), "missed");
  EXPECT_EQ(table.rows[3].back(), "not valid");
  EXPECT_EQ(table.rows[3][3], "nobody held anything");
  EXPECT_EQ(table.rows[4].back(), "–");
}

TEST(LabRelief, TheReportHasATableOfVerdicts) {
  const LabWorkspace files;
  std::filesystem::create_directory(files / "relief");
  files.Write("relief/server.csv",
              "figure,measured,must,precondition,verdict,valid\na,1,2,,met,\n");
  files.Write("relief/server.txt", "What it takes off\nA note.\n");
  const Section section = ReliefSection(files / "relief");
  ASSERT_EQ(section.items.size(), 1u);
  const auto& table = std::get<TextTable>(section.items[0]);
  EXPECT_EQ(table.name, "relief-server");
  EXPECT_EQ(table.title, "What it takes off");
  EXPECT_EQ(table.command, "seam-lab relief server");
  EXPECT_EQ(table.header.back(), "verdict");
  EXPECT_TRUE(ReliefSection(files / "nowhere").items.empty());
}

TEST(LabRelief, RefusesASwarmReportWithoutTheServersLoad) {
  EXPECT_THROW(ReadSwarm("client cpu: 5.0 us a tick\nserver: not heard\n"), OperatorError);
  EXPECT_THROW(ReadSwarm(""), OperatorError);
}

}  // namespace lab_relief_test
}  // namespace seam
