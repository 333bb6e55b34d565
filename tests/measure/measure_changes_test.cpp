/// Measures of worlds whose bodies come, go, split and merge: by part, against arithmetic.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "common/measure/revisions.h"
#include "common/physics/world.h"
#include "common/sync/edits/edit_order.h"

namespace seam {
namespace measure_changes_test {

/// A bar of two boxes, the heavy one its root, that flies and turns; and a box on its own.
const char* const kScene = R"(
title = "Bar"
gravity = [0, 0]
duration = 2
[[part]]
name = "ground"
chain = [[-100, -50], [100, -50]]
[[part]]
name = "heavy"
box = [2, 1]
position = [0, 0]
velocity = [1, 0.5]
spin = 3
[[part]]
name = "light"
box = [1, 1]
position = [1.5, 0]
[[part]]
name = "alone"
box = [1, 1]
position = [10, 0]
velocity = [0, 1]
[[player]]
name = "ann"
region = [[-100, -100], [2, 100]]
[[player]]
name = "bob"
region = [[2, -100], [100, 100]]
[[joint]]
name = "glue"
kind = "glue"
a = "heavy"
b = "light"
strength = 10000
)";
constexpr PartId kHeavy = 1, kLight = 2, kAlone = 3, kFirstNew = 4;

Edit BreakGlue(EditCause cause) { return Edit(BreakEdit{0}, cause); }

Edit Insert(const std::string& name, double x, EditCause cause) {
  return Edit(InsertEdit{"[[part]]\nname = \"" + name + "\"\nbox = [1, 1]\nposition = [" +
                         std::to_string(x) + ", 20]\nvelocity = [0, 2]\n"},
              cause);
}

Edit Push(PartId part) { return Edit(PushEdit{part, {4, 0}}, EditCause::kOutside); }
Edit Remove(PartId part) { return Edit(RemoveEdit{part}, EditCause::kOutside); }

/// Edits, each with the tick after which it is made.
using Timed = std::vector<std::pair<std::int64_t, Edit>>;

View ViewOf(const World& world, int peer) {
  View view;
  view.peer = peer;
  view.tick = world.tick();
  view.revision = world.topology().revision();
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState state = world.Read(body);
    view.id.push_back(world.id(body));
    view.role.push_back(peer == 0 ? kRoleAuthority : kRoleSecondary);
    view.authority.push_back(0);
    view.x.push_back(state.position.x());
    view.y.push_back(state.position.y());
    view.angle.push_back(state.angle);
    view.vx.push_back(state.velocity.x());
    view.vy.push_back(state.velocity.y());
    view.spin.push_back(state.spin);
    view.age.push_back(0);
  }
  return view;
}

/// Two peers that show the same world, in which the edits are made.
Recording Simulate(const Timed& edits) {
  Recording recording;
  recording.room.scene_name = "bar";
  recording.room.scene_text = kScene;
  recording.room.mode = "oracle";
  World world(ParseScene(kScene, "bar.toml"));
  for (std::int64_t tick = 0; tick <= 100; ++tick) {
    if (tick > 0) world.Step();
    for (const auto& [when, edit] : edits) {
      if (when != tick) continue;
      EditOrder order = ToOrder(edit);
      order.tick = tick;
      order.number = world.topology().revision();
      recording.edits[order.number] = order;
      world.Apply({edit});
    }
    for (const int peer : {0, 1}) recording.views[peer][tick] = ViewOf(world, peer);
  }
  recording.last_tick = 100;
  return recording;
}

Timed Eventful() {
  return {{20, BreakGlue(EditCause::kOutside)},
          {20, Push(kLight)},
          {30, Insert("crate", 3, EditCause::kOutside)},
          {50, Remove(kAlone)}};
}

TEST(MeasureChanges, TheOracleRepeatsEditsFromOutside) {
  const Recording recording = Simulate(Eventful());
  for (const Oracle& oracle : {ComputeOracle(recording), OracleFromRecording(recording)}) {
    const Measures m = Measure(recording, oracle);
    EXPECT_EQ(m.compared, 2 * (20 * 2 + 10 * 3 + 20 * 4 + 51 * 3));
    EXPECT_EQ(m.error_max_m, 0);
    EXPECT_EQ(m.stutter_mps2, 0);
    EXPECT_EQ(m.lost.value(), 0);
    EXPECT_EQ(m.topology_lag_s.value(), 0);
    EXPECT_TRUE(m.penetration_m.has_value());
    EXPECT_FALSE(oracle.At(19, kFirstNew).has_value());
    EXPECT_TRUE(oracle.At(30, kFirstNew).has_value());
    EXPECT_TRUE(oracle.At(49, kAlone).has_value());
    EXPECT_FALSE(oracle.At(50, kAlone).has_value());
  }
}

TEST(MeasureChanges, APartWithinABodyMovesWithIt) {
  const Oracle oracle = ComputeOracle(Simulate({{90, BreakGlue(EditCause::kOutside)}}));
  // The bar turns about its centre of mass, 0.5 m from the heavy box: 2 kg at 0, 1 kg at 1.5 m.
  for (const std::int64_t tick : {0, 10, 55, 89}) {
    const double t = static_cast<double>(tick) / 60;
    const BodyState light = oracle.At(tick, kLight).value();
    const double angle = 3 * t;
    EXPECT_NEAR(light.angle, angle, 1e-4);
    EXPECT_NEAR(light.position.x(), 0.5 + t + std::cos(angle), 1e-3) << tick;
    EXPECT_NEAR(light.position.y(), 0.5 * t + std::sin(angle), 1e-3) << tick;
    EXPECT_TRUE(oracle.Together(tick, {kHeavy, kLight}));
  }
  EXPECT_FALSE(oracle.Together(90, {kHeavy, kLight}));
  EXPECT_TRUE(oracle.SameBody(10, 89, kLight));
  EXPECT_FALSE(oracle.SameBody(89, 90, kLight));
  EXPECT_FALSE(oracle.SameBody(89, 90, kHeavy));
  EXPECT_TRUE(oracle.SameBody(89, 90, kAlone));
}

TEST(MeasureChanges, TheOracleFindsBreaksByPhysicsItself) {
  // Nothing pulls at the glue: the oracle keeps it, and says where the parts of the bar are.
  const Recording recording = Simulate({{40, BreakGlue(EditCause::kPhysics)}});
  const Oracle oracle = ComputeOracle(recording);
  EXPECT_TRUE(oracle.Together(100, {kHeavy, kLight}));
  const Measures m = Measure(recording, oracle);
  EXPECT_EQ(m.compared, 2 * (40 * 2 + 61 * 3));
  // Free, the light box flies on with speed 3 rad/s * 1 m along its tangent; the oracle's turns.
  const double t = 1.0, turned = 3 * t;
  EXPECT_NEAR(m.error_max_m, std::hypot(std::cos(turned) - 1, std::sin(turned) - 3 * t), 0.02);
}

TEST(MeasureChanges, InsertedPartsAreMatchedByTheirNames) {
  const Recording recording = Simulate({{10, Insert("debris", -3, EditCause::kPhysics)},
                                        {20, Insert("crate", 3, EditCause::kOutside)},
                                        {60, Remove(kFirstNew + 1)}});
  const Oracle oracle = ComputeOracle(recording);
  EXPECT_FALSE(oracle.At(40, kFirstNew).has_value());  // the oracle knows no debris
  EXPECT_NEAR(oracle.At(40, kFirstNew + 1).value().position.x(), 3, 1e-6);
  EXPECT_FALSE(oracle.At(60, kFirstNew + 1).has_value());
  EXPECT_LT(Measure(recording, oracle).error_max_m, 1e-6);  // a body made anew is rounded anew
}

TEST(MeasureChanges, NoSecondDifferenceIsTakenAcrossAChangeOfBody) {
  for (const bool changes : {false, true}) {
    Timed edits;
    if (changes) edits.push_back({50, BreakGlue(EditCause::kOutside)});
    Recording recording = Simulate(edits);
    const Oracle oracle = ComputeOracle(recording);
    for (auto& [tick, view] : recording.views[1]) {
      if (tick >= 50) view.x[0] += 0.1f;  // the bar's root snaps to where the change puts it
    }
    const Measures m = Measure(recording, oracle);
    EXPECT_NEAR(m.error_max_m, 0.1, 1e-3);
    if (changes) {
      EXPECT_LT(m.stutter_mps2, 0.1);
    } else {
      EXPECT_GT(m.stutter_mps2, 10);
    }
    EXPECT_EQ(m.seam_stutter_mps2.value() > 10, !changes);
  }
}

TEST(MeasureChanges, ALateEditIsALagAndAMissingBodyIsLost) {
  Recording recording = Simulate(Eventful());
  for (std::int64_t tick = 20; tick < 65; ++tick) {  // peer 1 hears of the break 45 ticks late
    View& late = recording.views[1][tick];
    late = recording.views[1][19];
    late.tick = tick;
  }
  View& wrong = recording.views[0][80];
  wrong.id.erase(wrong.id.begin());
  const Measures m = Measure(recording, ComputeOracle(recording));
  EXPECT_NEAR(m.topology_lag_s.value(), 44.0 / 60, 1e-9);
  EXPECT_EQ(m.lost.value(), 1);
  EXPECT_FALSE(Measure(Simulate({}), ComputeOracle(Simulate({}))).lost.has_value());
  recording = Simulate(Eventful());
  recording.edits.erase(0);  // the log lacks it: no view after it can be judged
  EXPECT_EQ(Measure(recording, ComputeOracle(recording)).lost.value(), 0);
}

TEST(MeasureChanges, ASessionUnderLossLosesNoBody) {
  ClusterConfig config;
  config.scene_text = kScene;
  config.reconcile = "retrospect";
  config.impair = "4g";
  config.show_age_ticks = 0;  // the error is that of the present
  Cluster cluster(config);
  cluster.RunToTick(40);
  cluster.server().Order(BreakGlue(EditCause::kOutside));
  cluster.RunToTick(60);
  cluster.server().Order(Insert("crate", 3, EditCause::kOutside));
  cluster.Run();
  const Recording& recording = cluster.recording();
  const Measures m = Measure(recording, ComputeOracle(recording));
  EXPECT_EQ(recording.edits.size(), 2u);
  EXPECT_EQ(m.lost.value(), 0);
  EXPECT_GT(m.topology_lag_s.value(), 0);
  EXPECT_LT(m.topology_lag_s.value(), 1);
  // A break a tenth of a second late sends the light box off at 3 m/s in a direction 0.3 rad wrong.
  EXPECT_LT(m.error_max_m, 1.5);
}

TEST(MeasureChanges, ARevisionIsTheSameAtEveryRequest) {
  std::vector<Edit> edits;
  for (int i = 0; i < 300; ++i) {  // more than are kept
    edits.push_back(Insert("n" + std::to_string(i), i, EditCause::kOutside));
  }
  edits.push_back(Push(kAlone));
  const Scene scene = ParseScene(kScene, "bar.toml");
  const RevisionHistory revisions(scene, edits);
  EXPECT_EQ(revisions.Key(301), 300);  // a push changes no body
  for (const int wanted : {300, 10, 299, 0, 150, 10, 1000}) {
    EXPECT_EQ(revisions.At(wanted)->ids.size(),
              2u + static_cast<std::size_t>(std::min(wanted, 300)));
  }
  EXPECT_TRUE(revisions.SameBody(0, 300, kLight));
}

TEST(Changes, ALongRoomsEditsAreAllReadAndADamagedNumberCostsNoMemory) {
  Recording recording;
  const EditOrder push = ToOrder(Edit(PushEdit{0, {1, 0}, 0}));
  for (std::int32_t n = 0; n < 100000; ++n) recording.edits[n] = push;
  EXPECT_EQ(EditsOf(recording).size(), 100000u);
  recording.edits[INT32_MAX] = push;
  EXPECT_EQ(EditsOf(recording).size(), 100000u);
  Recording damaged;
  damaged.edits[1000000000] = push;
  EXPECT_TRUE(EditsOf(damaged).empty());
}

}  // namespace measure_changes_test
}  // namespace seam
