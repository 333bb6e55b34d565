/// The two oracles, and the error of held inputs: exact physics without the
/// others' inputs.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/measure/limit/held_inputs.h"
#include "common/measure/measure.h"
#include "common/scene/expected.h"

namespace seam {
namespace measure_limit_test {

constexpr std::int64_t kTickUs = 16667;

/// Two sleds on a floor without friction, one of each player, each pushed along by its motor.
const char* const kSleds = R"(
gravity = [0, 0]
[[player]]
name = "ann"
vehicle = "a"
region = [[-100, -100], [-0.1, 100]]
[[player]]
name = "bob"
vehicle = "b"
region = [[0, -100], [100, 100]]
[[part]]
name = "a"
box = [1, 1]
position = [-5, 0]
[[part]]
name = "b"
box = [1, 1]
position = [5, 0]
[[thrust]]
name = "ta"
part = "a"
player = "ann"
force = [10, 0]
[[thrust]]
name = "tb"
part = "b"
player = "bob"
force = [10, 0]
)";

/// Both drive at full throttle, but that bob's lasts until `bob_until`. Every input comes to the
/// server `late_us` after its tick, one message for each.
Recording Drive(std::int64_t bob_until, std::int64_t late_us) {
  Recording recording;
  recording.room.scene_name = "sleds";
  recording.room.scene_text = kSleds;
  recording.room.tick_hz = 60;
  recording.last_tick = 200;
  for (std::int64_t tick = 0; tick <= 200; ++tick) {
    View& view = recording.views[0][tick];
    view.tick = tick;
    view.utime = 1000000 + tick * kTickUs;
    for (const int player : {0, 1}) {
      Inputs& inputs = recording.inputs[player][tick];
      inputs.player = player;
      inputs.first_tick = tick;
      inputs.utime = view.utime + late_us;
      inputs.drive = {static_cast<std::int8_t>(player == 1 && tick > bob_until ? 0 : 127)};
      inputs.lift = {0};
      inputs.buttons = {0};
    }
  }
  return recording;
}

/// Numbers of unknown ticks, at each of the ticks from 40 on.
std::set<std::int64_t> Ages(const Recording& recording, int of, int at) {
  const KnownInputs known = FindKnownInputs(recording);
  std::set<std::int64_t> ages;
  for (std::int64_t tick = 40; tick <= recording.last_tick; ++tick) {
    ages.insert(tick - known.at({of, at})[static_cast<std::size_t>(tick)]);
  }
  return ages;
}

using OfTicks = std::set<std::int64_t>;

TEST(KnownInputs, AreAsOldAsTheDelayToAndFromTheServer) {
  for (const int ticks : {0, 3, 12}) {
    const Recording recording = Drive(200, ticks * kTickUs);
    ASSERT_EQ(FindKnownInputs(recording).size(), 2u);
    EXPECT_EQ(Ages(recording, 0, 1), OfTicks{2 * ticks});
    EXPECT_EQ(Ages(recording, 1, 0), OfTicks{2 * ticks});
  }
}

TEST(KnownInputs, AreUnknownBeforeTheFirstArrives) {
  const auto known = FindKnownInputs(Drive(200, 3 * kTickUs)).at({1, 0});
  ASSERT_EQ(known.size(), 201u);
  EXPECT_EQ(known[5], -1);
  EXPECT_EQ(known[6], 0);
}

TEST(KnownInputs, IncludeTheClientsLeadDerivedFromTheRoundTrip) {
  // The input of tick t arrives two ticks before the server makes t, after four ticks of delay: the
  // clients are six ticks ahead. A state received after four more is displayed ten ticks later.
  Recording recording = Drive(200, -2 * kTickUs);
  for (const int peer : {1, 2}) {
    Stats stats;
    stats.rtt_us = 8 * kTickUs;
    recording.stats[peer] = {stats};
  }
  EXPECT_EQ(Ages(recording, 0, 1), OfTicks{8});
  EXPECT_EQ(Ages(recording, 1, 0), OfTicks{8});
}

TEST(KnownInputs, AgeWhileWaitingForTheNextMessage) {
  Recording recording = Drive(200, 3 * kTickUs);
  auto& bob = recording.inputs[1];  // only every fourth tick is said, with all before it
  for (auto piece = bob.begin(); piece != bob.end();) {
    piece = piece->first % 4 == 0 ? std::next(piece) : bob.erase(piece);
  }
  EXPECT_EQ(Ages(recording, 0, 1), OfTicks{6});
  EXPECT_EQ(Ages(recording, 1, 0), (OfTicks{6, 7, 8, 9}));
}

TEST(KnownInputs, AreUnknownWithoutTheServersViews) {
  Recording recording = Drive(200, kTickUs);
  recording.views.clear();
  EXPECT_TRUE(FindKnownInputs(recording).empty());
  EXPECT_FALSE(HeldInputsError(recording).has_value());
}

TEST(HeldInputs, IsExactlyZeroIfTheHeldInputsWereRight) {
  EXPECT_EQ(HeldInputsError(Drive(-1, 0)).value(), 0);  // bob never drives, and all is known
  Recording recording = Drive(200, 6 * kTickUs);
  recording.inputs.erase(0);  // ann does nothing at all, and her inputs are not on record
  recording.inputs[0] = Drive(-1, 6 * kTickUs).inputs[1];
  for (auto& [tick, piece] : recording.inputs[0]) piece.player = 0;
  recording.inputs[1] = Drive(-1, 6 * kTickUs).inputs[1];
  EXPECT_EQ(HeldInputsError(recording).value(), 0);
}

TEST(HeldInputs, IsTheEffectOfTheInputsWhileTheyAreUnknown) {
  // A sled of 1 kg under 10 N that is wrongly assumed to be driven, or not, for n ticks of 1/60 s
  // errs by h^2 10 n(n+1)/2. Both begin unseen; ann assumes bob's to be driven after he let go.
  const auto expected = [](std::int64_t until, std::int64_t age) {
    double sum = 0;
    int count = 0;
    const auto add = [&](std::int64_t wrong) {
      const double n = static_cast<double>(std::max<std::int64_t>(0, wrong));
      const double apart = 10 * n * (n + 1) / 2 / 3600;
      sum += apart * apart;
      ++count;
    };
    for (std::int64_t tick = 2; tick <= 200; tick += 2) {
      const std::int64_t known = tick - age;
      add(known < 0 ? tick : 0);                                  // ann's, seen by bob
      add(known < 0 ? tick : known <= until ? tick - until : 0);  // bob's, seen by ann
    }
    return std::sqrt(sum / count);
  };
  const Recording recording = Drive(95, 6 * kTickUs);
  EXPECT_NEAR(HeldInputsError(recording).value(), expected(95, 12), 2e-3 * expected(95, 12));
  EXPECT_NEAR(HeldInputsError(Drive(95, 12 * kTickUs)).value(), expected(95, 24),
              2e-3 * expected(95, 24));
}

TEST(HeldInputs, FindsASinglePressAtAnyTick) {
  // A press is unknown for twelve ticks: one in ten ticks would see it once or not at all.
  std::string scene = kSleds;
  const std::string bob = "vehicle = \"b\"";
  scene.replace(scene.find(bob), bob.size(),
                bob + "\nactions = [{button = 0, part = \"b\", impulse = [3, 0]}]");
  std::vector<double> limits;
  for (std::int64_t press = 100; press < 110; ++press) {
    Recording recording = Drive(-1, 6 * kTickUs);
    recording.room.scene_text = scene;
    recording.inputs.erase(0);
    recording.inputs[0] = Drive(-1, 6 * kTickUs).inputs[1];
    for (auto& [tick, piece] : recording.inputs[0]) piece.player = 0;
    for (auto& [tick, piece] : recording.inputs[1]) {
      if (tick >= press && tick < press + 6) piece.buttons = {1};
    }
    limits.push_back(HeldInputsError(recording).value());
  }
  const auto [least, most] = std::minmax_element(limits.begin(), limits.end());
  EXPECT_GT(*least, 0.02);
  EXPECT_LT(*most, 1.2 * *least);
}

TEST(HeldInputs, NeedsASecondPlayer) {
  Recording recording = Drive(95, 6 * kTickUs);
  recording.inputs.erase(1);
  EXPECT_FALSE(HeldInputsError(recording).has_value());
}

TEST(HeldInputs, IsFarBelowAMethodsErrorsInAScriptedCrash) {
  ClusterConfig config;
  config.scene = "crossing";
  config.mode = "strict";
  const Recording recording = RunCluster(config);
  const double limit = HeldInputsError(recording).value();
  EXPECT_GT(limit, 0);
  EXPECT_LT(limit, 0.1 * Measure(recording, ComputeOracle(recording)).error_rms_m);
}

TEST(Oracles, OnlyReplayingRulesAreJudgedByTheOracleWithBarriers) {
  Room room;
  room.send_hz = 20;
  room.tick_hz = 60;
  room.mode = "buffer";
  for (const NamedReconciler& rule : Reconcilers()) {
    room.reconcile = rule.name;
    EXPECT_EQ(JudgedByBarriers(room), rule.rolls_back) << rule.name;
    room.protocol = kProtocolVersion;
    EXPECT_EQ(JudgeOf(room).barrier_every, rule.rolls_back ? 2 : 0) << rule.name;
    room.protocol = 13;  // each send tick was a barrier
    EXPECT_EQ(JudgeOf(room).barrier_every, rule.rolls_back ? 3 : 0) << rule.name;
  }
  room.reconcile = "rollback";
  EXPECT_TRUE(JudgedByBarriers(room));
  for (const char* mode : {"central", "strict", "oracle", "nonsense"}) {
    room.mode = mode;
    EXPECT_FALSE(JudgedByBarriers(room)) << mode;
  }
}

TEST(Oracles, BarriersDoNotMoveFreeBodiesButMoveAChaoticWall) {
  const Recording sleds = Drive(95, 0);
  EXPECT_EQ(
      OracleDistance(sleds, ComputeOracle(sleds), ComputeOracle(sleds, WithBarriers(sleds.room))),
      0);
  ClusterConfig config;
  config.scene = "wall";
  config.mode = "oracle";
  config.impair = "perfect";
  const Recording wall = RunCluster(config);
  const Oracle plain = ComputeOracle(wall), rebuilt = ComputeOracle(wall, WithBarriers(wall.room));
  EXPECT_GT(OracleDistance(wall, plain, rebuilt), 0.001);
  EXPECT_EQ(OracleDistance(wall, rebuilt, ComputeOracle(wall, WithBarriers(wall.room))), 0);
}

TEST(Oracles, SearchForAContactOfTwoPlayersIfTheSceneExpectsOne) {
  Recording recording = Drive(0, 0);  // ann drives into bob's sled, which stands
  EXPECT_FALSE(ComputeOracle(recording).contact.has_value()) << "nobody asked";
  recording.room.scene_text = "expect = 'contact'\n" + std::string(kSleds);
  EXPECT_TRUE(ComputeOracle(recording).contact.value());
  recording.last_tick = 20;  // it is not there yet
  EXPECT_FALSE(ComputeOracle(recording).contact.value());
}

}  // namespace measure_limit_test
}  // namespace seam
