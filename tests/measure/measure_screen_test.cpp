/// Point displacement, ownership of bodies and the bodies counted, with analytic answers.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/measure/screen/screen.h"
#include "common/sync/edits/edit_order.h"
#include "tests/support/made_recording.h"

namespace seam {
namespace measure_screen_test {

/// One moving assembly for each text of parts; all of a scene of two players.
Scene MakeScene(const std::string& parts) {
  return ParseScene(parts + R"(
[[player]]
name = "anna"
vehicle = "one"
[[player]]
name = "bob"
)",
                    "made.toml");
}

Extent ExtentOf(const std::string& parts) {
  const Scene scene = MakeScene(parts);
  return Extent(scene, Compose(scene).assemblies.front());
}

const char* const kBox = "[[part]]\nname = \"one\"\nbox = [3, 4]\n";
const char* const kDisc = "[[part]]\nname = \"one\"\ncircle = 0.5\n";

TEST(Extent, AShiftDisplacesEveryPointByItself) {
  for (const char* shape : {kBox, kDisc}) {
    EXPECT_DOUBLE_EQ(ExtentOf(shape).Displacement(DoublePose({3, 5}, 1), DoublePose({0, 1}, 1)), 5);
  }
}

TEST(Extent, AQuarterTurnOfABoxDisplacesItsCornersMost) {
  // A corner at 2.5 m moves along a chord of 2 sin(45 degrees) times that.
  EXPECT_NEAR(ExtentOf(kBox).Displacement(DoublePose({7, 1}, kPi / 2), DoublePose({7, 1}, 0)),
              2.5 * std::sqrt(2.0), 1e-12);
}

TEST(Extent, TheMaterialOfADiscTurnsThoughItsOutlineDoesNot) {
  const Extent disc = ExtentOf(kDisc);
  EXPECT_NEAR(disc.Displacement(DoublePose({0, 0}, 0.2), DoublePose({0, 0}, 0)), std::sin(0.1),
              1e-12);
  EXPECT_NEAR(disc.Displacement(DoublePose({1, 0}, kPi), DoublePose({0, 0}, 0)), 2, 1e-12);
  EXPECT_NEAR(disc.Displacement(DoublePose({0, 0}, 4 * kPi), DoublePose({0, 0}, 0)), 0, 1e-12);
}

TEST(Extent, IsTheLargestOverAllPointsOfTheShape) {
  // Points all over the box, by brute force, for turns and shifts of all sizes.
  const Extent box = ExtentOf(kBox);
  for (int k = 0; k < 20; ++k) {
    const DoublePose a({0.1 * k, -0.3 * k}, 0.37 * k), b({1, 2}, -0.11 * k);
    double most = 0;
    for (int i = -30; i <= 30; ++i) {
      for (int j = -30; j <= 30; ++j) {
        const Eigen::Vector2d p(1.5 * i / 30, 2.0 * j / 30);
        most = std::max(most,
                        (a.position + Turned(p, a.angle) - b.position - Turned(p, b.angle)).norm());
      }
    }
    EXPECT_NEAR(box.Displacement(a, b), most, 1e-9) << k;
  }
}

TEST(Extent, ABodyOfSeveralPartsReachesAsFarAsItsFarthestPart) {
  const Extent body = ExtentOf(R"(
[[part]]
name = "one"
box = [2, 2]
[[part]]
name = "ball"
circle = 0.5
position = [4, 0]
[[joint]]
kind = "weld"
name = "w"
a = "one"
b = "ball"
)");
  EXPECT_NEAR(body.radius(), 4.5, 1e-6);
  EXPECT_NEAR(body.Displacement(DoublePose({0, 0}, 0.1), DoublePose({0, 0}, 0)),
              2 * std::sin(0.05) * 4.5, 1e-6);
}

/// Bodies 3 and 7 of a made recording; 3 is a disc and anna's vehicle.
const char* const kParts = R"(
[[part]]
name = "ground"
box = [1, 1]
position = [0, -50]
anchored = true
repeat = {count = 3, step = [2, 0]}
[[part]]
name = "one"
circle = 0.5
[[part]]
name = "more"
box = [1, 1]
position = [0, -60]
anchored = true
repeat = {count = 3, step = [2, 0]}
[[part]]
name = "seven"
box = [1, 1]
position = [-5, 0]
[[player]]
name = "anna"
vehicle = "one"
[[player]]
name = "bob"
)";

Recording InRoom(Recording recording, const char* mode, const std::string& text = kParts) {
  recording.room.scene_name = "made";
  recording.room.scene_text = text;
  recording.room.mode = mode;
  return recording;
}

TEST(PointError, SeparatesOwnOthersAndServerByTheVehicle) {
  Recording run = InRoom(MakeRecording(3, 100, Moving(2)), "central");
  for (auto& [tick, view] : run.views[0]) view.x[0] += 0.5f;   // the server's
  for (auto& [tick, view] : run.views[1]) view.x[0] += 0.25f;  // anna's own
  for (auto& [tick, view] : run.views[2]) view.x[0] += 1;      // bob sees it
  const Measures m = Measure(run, MakeOracle(100, Moving(2)));
  EXPECT_DOUBLE_EQ(*m.error_server_m, 0.5 / std::sqrt(2));  // one of two bodies
  EXPECT_DOUBLE_EQ(*m.error_own_m, 0.25);                   // body 3 by anna
  EXPECT_DOUBLE_EQ(*m.error_others_m, 1 / std::sqrt(3));    // 7 by anna, 3 and 7 by bob
}

TEST(PointError, JudgesAllMethodsByTheSameBodiesUnderAnyAuthority) {
  for (const char* mode : {"buffer", "strict", "central"}) {
    Recording run = InRoom(MakeRecording(3, 100, Moving(2)), mode);
    for (auto& [tick, view] : run.views[2]) {
      view.x[1] += 0.5f;
      view.authority[1] = 2;
      view.role[1] = kRoleAuthority;
    }
    const Measures m = Measure(run, MakeOracle(100, Moving(2)));
    EXPECT_DOUBLE_EQ(*m.error_own_m, 0) << mode;
    EXPECT_DOUBLE_EQ(*m.error_others_m, 0.5 / std::sqrt(3)) << mode;
  }
}

TEST(PointError, ADiscThatIsTurnedWronglyIsInErrorThoughItIsInItsPlace) {
  Recording run = InRoom(MakeRecording(2, 100, Moving(2)), "central");
  for (auto& [tick, view] : run.views[1]) view.angle[0] += 1;
  const Measures m = Measure(run, MakeOracle(100, Moving(2)));
  EXPECT_EQ(m.error_rms_m, 0);
  EXPECT_NEAR(*m.error_own_m, std::sin(0.5), 1e-9);
}

TEST(PointError, IsEmptyWithoutClientsAndIgnoresAnglesWithoutAScene) {
  const Measures server = Measure(MakeRecording(1, 10, Moving(2)), MakeOracle(10, Moving(2)));
  EXPECT_FALSE(server.error_others_m || server.error_own_m);
  EXPECT_EQ(server.error_server_m, 0);
  Recording run = MakeRecording(2, 10, Moving(2));
  for (auto& [tick, view] : run.views[1]) view.angle[0] += 1;
  EXPECT_EQ(Measure(run, MakeOracle(10, Moving(2))).error_others_m, 0);
}

TEST(OwnBodies, AreThoseOfTheSeatThatThePlayerSitsOnWhileItSits) {
  const std::string text = std::string(kParts) + R"(
[[seat]]
name = "helm"
part = "seven"
button = 3
)";
  Recording run = InRoom(MakeRecording(3, 100, Moving(2)), "central", text);
  const auto sit = [](std::int32_t number, int player) {
    EditOrder order = ToOrder(Edit(SeatEdit{0, player}, EditCause::kOutside));
    order.number = number;
    return order;
  };
  run.edits[0] = sit(0, 1);
  run.edits[1] = sit(1, -1);
  const Scene scene = ParseScene(text, "made.toml");
  const RevisionHistory revisions(scene, run);
  OwnBodies own(run, &revisions);
  EXPECT_EQ(own.ByScene(0, 0), (std::vector<PartId>{3}));
  EXPECT_EQ(own.ByScene(0, 1), (std::vector<PartId>{}));
  EXPECT_EQ(own.ByScene(1, 1), (std::vector<PartId>{7}));
  EXPECT_EQ(own.ByScene(2, 1), (std::vector<PartId>{}));
}

TEST(Handover, ThePercentileOfTheGapsIsTheNearestRank) {
  // Body 3 changes hands between the peers at every fifth tick, 40 times, each time farther apart.
  Recording run = MakeRecording(2, 200, Moving(0));
  for (auto& [peer, views] : run.views) {
    for (auto& [tick, view] : views) {
      const int holder = static_cast<int>(tick / 5 % 2);
      view.authority[0] = static_cast<std::int16_t>(holder);
      view.role[0] = holder == peer ? kRoleAuthority : kRoleSecondary;
      if (peer == 1) view.x[0] += static_cast<float>(tick / 5);
    }
  }
  const Measures m = Measure(run, MakeOracle(200, Moving(0)));
  EXPECT_DOUBLE_EQ(*m.handover_gap_m, 40);
  EXPECT_DOUBLE_EQ(*m.handover_gap_p95_m, 38);
  EXPECT_EQ(m.handover_dv_p95_mps, 0);
}

/// Two players in mode central; the server makes a tick each 1000 us. Bob's view is 0.5 m off.
Recording Served() {
  Recording run = InRoom(MakeRecording(3, 10, Moving(2)), "central");
  run.room.predict = "all";
  for (auto& [tick, view] : run.views[0]) view.utime = 1000 * tick;
  for (auto& [tick, view] : run.views[2]) view.x[0] += 0.5f;
  return run;
}

Inputs DriveAt(std::int64_t tick, int drive, std::int64_t utime) {
  Inputs inputs;
  inputs.utime = utime;
  inputs.player = 0;
  inputs.first_tick = tick;
  inputs.drive = {static_cast<std::int8_t>(drive)};
  inputs.lift = {0};
  inputs.buttons = {0};
  return inputs;
}

TEST(Served, CountsInputsThatCameAfterTheirTickAndWereNotGuessed) {
  Recording run = Served();
  run.inputs[0][3] = DriveAt(3, 50, 2900);  // in time
  run.inputs[0][4] = DriveAt(4, 50, 6500);  // late, but held anyway
  run.inputs[0][5] = DriveAt(5, 70, 5001);  // late
  run.inputs[0][6] = DriveAt(6, 70, 7000);  // late, and tick 5 had come by then
  const Oracle oracle = MakeOracle(10, Moving(2));
  EXPECT_EQ(Measure(run, oracle).inputs_late, 1);
  run.room.mode = "buffer";
  run.room.reconcile = "rollback";
  EXPECT_EQ(Measure(run, oracle).inputs_late, 0) << "its peers go back";
  EXPECT_FALSE(Measure(run, oracle).error_served_m);
  run.room.reconcile = "fade";
  EXPECT_FALSE(Measure(run, oracle).inputs_late);
}

TEST(Served, ComparesClientsWithTheServerWhereverThatWent) {
  Recording run = Served();
  const Oracle oracle = MakeOracle(10, Moving(2));
  EXPECT_DOUBLE_EQ(*Measure(run, oracle).error_served_m, *Measure(run, oracle).error_others_m);
  for (int peer = 0; peer < 3; ++peer) {
    for (auto& [tick, view] : run.views[peer]) view.x[0] += 9;
  }
  EXPECT_NEAR(*Measure(run, oracle).error_served_m, 0.5 / std::sqrt(3), 1e-6);
  EXPECT_GT(*Measure(run, oracle).error_others_m, 4);
}

}  // namespace measure_screen_test
}  // namespace seam
