/// Edits found by physics act at the same tick as without a network, on every peer that replays.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "common/scene/scene.h"
#include "common/sync/edits/edit_order.h"
#include "server/edits/edit_log.h"

namespace seam {
namespace edit_tick_test {

Recording Break(const std::string& impair, std::int64_t seed) {
  ClusterConfig config;
  config.scene = "gluehouse";
  config.reconcile = "rollback";
  config.impair = impair;
  config.seed = seed;
  config.duration_s = 2.9;  // before the pieces meet
  config.show_age_ticks = 0;  // the error is that of the present
  return RunCluster(config);
}

/// Largest error of any body in any peer's last view, m.
double Last(const Recording& recording, const Oracle& oracle) {
  double worst = 0;
  for (const auto& [peer, views] : recording.views) {
    const auto& [tick, view] = *views.rbegin();
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      const std::optional<BodyState> truth = oracle.At(tick, view.id[i]);
      if (!truth) return 1e9;
      const Vec2 at(view.x[i], view.y[i]);
      worst = std::max(worst, static_cast<double>((at - truth->position).norm()));
    }
  }
  return worst;
}

/// A break waits for all inputs of its tick, also for those of players that drive nothing moving
/// and would have nothing to send.
TEST(EditTick, AnIdlePlayerDoesNotDelayABreak) {
  const Recording recording = Break("perfect", 1);
  const Oracle oracle = ComputeOracle(recording, WithBarriers(recording.room));
  ASSERT_GE(oracle.spans.size(), 2u);
  const auto broke = static_cast<std::int64_t>(oracle.spans[1].first_row);
  for (const auto& [tick, view] : recording.views.at(0)) {
    if (view.revision == 0) continue;
    EXPECT_GE(tick, broke);
    EXPECT_LE(tick, broke + 3);
    return;
  }
  FAIL() << "nothing broke";
}

TEST(EditTick, GlueBreaksAtTheOraclesTickOnAnyNetwork) {
  for (const std::string impair : {"4g", "delay=200ms"}) {
    const Recording recording = Break(impair, 1);
    const Oracle oracle = ComputeOracle(recording, WithBarriers(recording.room));
    ASSERT_GE(recording.edits.size(), 30u) << impair << ": the ball breaks the house";
    ASSERT_GE(oracle.spans.size(), 2u);
    const auto first = static_cast<std::size_t>(oracle.spans[1].edits);
    ASSERT_GE(first, 30u);
    std::size_t n = 0;
    for (const auto& [number, order] : recording.edits) {
      if (n == first) break;
      EXPECT_EQ(order.tick, static_cast<std::int64_t>(oracle.spans[1].first_row)) << impair;
      EXPECT_EQ(KeyOf(ToEdit(order)), KeyOf(oracle.edits[n])) << impair << ": edit " << number;
      ++n;
    }
    for (const auto& [peer, views] : recording.views) {
      EXPECT_EQ(views.rbegin()->second.revision, recording.views.at(0).rbegin()->second.revision)
          << impair << ": peer " << peer;
    }
    if (impair != "4g") continue;
    EXPECT_LT(Last(recording, oracle), 0.02) << impair << ": everybody has gone back";
  }
}

const char* const kGlued = R"(
duration = 5
[[part]]
name = "brick"
box = [1, 1]
position = [0, 9]
repeat = {count = [4, 1], step = [1, 1], glue = 100}
)";

/// A server's log and copy.
struct Room {
  explicit Room(const char* rule)
      : scene(ParseScene(kGlued, "glued.toml")),
        config(MakeSyncConfig("buffer", rule)),
        replica(scene, config, 0, -1),
        authority(scene, config, replica),
        log(replica.world(), authority, 60) {}

  std::int64_t TickOf(std::int32_t joint, std::int64_t found) {
    EXPECT_TRUE(log.Add(Edit(BreakEdit{joint}), found));
    const EditLog::Batch batch = log.OrderPending(0);
    EXPECT_EQ(batch.orders.size(), 1u);
    return batch.orders.at(0).tick;
  }

  Scene scene;
  SyncConfig config;
  Replica replica;
  AuthorityManager authority;
  EditLog log;
};

TEST(EditTick, AnEditIsOrderedForTheTickThatFoundItIfPossible) {
  Room room("rollback");
  for (int i = 0; i < 100; ++i) room.replica.Step();
  EXPECT_EQ(room.TickOf(0, 90), 90);
  EXPECT_EQ(room.TickOf(1, 80), 90) << "not before the last that was ordered";
  EXPECT_TRUE(room.log.Add(Edit(BreakEdit{2}), 101));
  EXPECT_TRUE(room.log.OrderPending(0).orders.empty()) << "not in the future";
  room.replica.Step();
  EXPECT_EQ(room.log.OrderPending(0).orders.at(0).tick, 101);
  Room late("rollback");
  for (int i = 0; i < 100; ++i) late.replica.Step();
  EXPECT_EQ(late.TickOf(0, 30), 100) << "too long ago";
}

TEST(EditTick, AnEditFromOutsideThatCutsOffThePastWaitsForTheInputsOfItsTick) {
  Room room("rollback");
  const Edit removed(RemoveEdit{0}, EditCause::kOutside);
  const Edit push(PushEdit{1, {1, 0}}, EditCause::kOutside);
  const auto ordered = [&room](std::int64_t complete) {
    room.log.NoteComplete(complete);
    return room.log.OrderPending(0).orders;
  };
  for (int i = 0; i < 100; ++i) room.replica.Step();
  EXPECT_TRUE(room.log.Add(push));
  EXPECT_EQ(ordered(80).at(0).tick, 100) << "a replay repeats a push: it waits for nothing";
  EXPECT_TRUE(room.log.Add(removed));
  EXPECT_TRUE(room.log.Add(push));
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(ordered(room.replica.tick() - 20).empty()) << "the push keeps its place";
    room.replica.Step();
  }
  EXPECT_TRUE(ordered(100).empty()) << "other peers do not know them yet";
  const std::vector<EditOrder> both = ordered(110);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].tick, 100);
  EXPECT_EQ(KeyOf(ToEdit(both[0])), KeyOf(removed));
  EXPECT_EQ(both[1].tick, 100);
}

TEST(EditTick, AnEditFromOutsideWaitsNoLongerThanReplaysReach) {
  Room room("rollback");
  for (int i = 0; i < 100; ++i) room.replica.Step();
  EXPECT_TRUE(room.log.Add(Edit(RemoveEdit{0}, EditCause::kOutside)));
  room.log.NoteComplete(80);
  for (int i = 0; i < 60; ++i) {
    EXPECT_TRUE(room.log.OrderPending(0).orders.empty()) << i;
    room.replica.Step();
  }
  EXPECT_EQ(room.log.OrderPending(0).orders.size(), 1u);
}

EditOrder BreakAt(std::int32_t joint, std::int32_t number, std::int64_t tick) {
  EditOrder order = ToOrder(Edit(BreakEdit{joint}));
  order.number = number;
  order.tick = tick;
  return order;
}

TEST(EditTick, ALateEditActsAsIfItHadComeInTime) {
  Room early("rollback"), late("rollback");
  for (int i = 0; i < 61; ++i) {
    // Off the ticks of barriers, too.
    if (i == 21) {
      EXPECT_TRUE(early.replica.Queue(BreakAt(0, 0, 21)));
    }
    if (i == 24) {
      EXPECT_TRUE(early.replica.Queue(BreakAt(2, 1, 24)));
    }
    if (i == 40) {
      EXPECT_TRUE(late.replica.Queue(BreakAt(0, 0, 21)));
      EXPECT_TRUE(late.replica.Queue(BreakAt(2, 1, 24)));
    }
    early.replica.Step();
    late.replica.Step();
  }
  EXPECT_EQ(early.replica.world().body_count(), 3);
  EXPECT_EQ(late.replica.world().composition().hash, early.replica.world().composition().hash);
  EXPECT_EQ(late.replica.world().Hash(), early.replica.world().Hash()) << "bit for bit";
}

TEST(EditTick, AnEditOfAFutureTickWaitsForItUnderEveryRule) {
  for (const char* rule : {"rollback", "retrospect"}) {
    Room room(rule);
    for (int i = 0; i < 20; ++i) room.replica.Step();
    ASSERT_TRUE(room.replica.Queue(BreakAt(0, 0, 22)));
    for (int tick = 21; tick <= 22; ++tick) {
      room.replica.Step();
      EXPECT_EQ(room.replica.revision(), 0) << rule << " after " << tick;
    }
    room.replica.Step();
    EXPECT_EQ(room.replica.revision(), 1) << rule;
    ASSERT_TRUE(room.replica.Queue(BreakAt(1, 1, 1000000)));
    room.replica.Step();
    EXPECT_EQ(room.replica.revision(), 2) << rule << ": what is far off is not believed";
  }
}

const char* const kDriven = R"(
duration = 5
[[player]]
name = "ann"
vehicle = "cart"
[[part]]
name = "floor"
chain = [[-90, 0], [90, 0]]
[[part]]
name = "cart"
box = [2, 0.5]
position = [0, 0.26]
[[part]]
name = "crate"
box = [0.5, 0.5]
position = [3, 0.26]
repeat = {count = 3, step = [0.7, 0]}
[[thrust]]
name = "jet"
part = "cart"
force = [30, 0]
player = "ann"
[[seat]]
name = "bench"
part = "crate.2"
button = 3
)";

EditOrder OrderedAt(const AnyEdit& edit, std::int32_t number, std::int64_t tick) {
  EditOrder order = ToOrder(Edit(edit, EditCause::kOutside));
  order.number = number;
  order.tick = tick;
  return order;
}

TEST(EditTick, AReplayRepeatsEditsThatKeepTheSetOfBodies) {
  const Scene scene = ParseScene(kDriven, "driven.toml");
  const SyncConfig config = MakeSyncConfig("buffer", "rollback");
  Replica early(scene, config, 0, -1), late(scene, config, 0, -1);
  for (Replica* replica : {&early, &late}) {
    for (int m = 0; m < replica->authority().count(); ++m) {
      replica->authority().Set(m, AuthorityRecord());
    }
    replica->RolesChanged();
  }
  const auto drive = [](Replica* replica, std::int64_t from, std::int64_t to) {
    for (std::int64_t t = from; t <= to; ++t) {
      Input input;
      input.drive = t <= 20 ? 127 : -127;
      replica->RecordInput(0, t, input);
    }
  };
  for (std::int64_t tick = 1; tick <= 90; ++tick) {
    drive(&early, tick, tick);
    if (tick <= 20) drive(&late, tick, tick);
    if (tick == 60) drive(&late, 21, 60);
    if (tick > 60) drive(&late, tick, tick);
    for (Replica* replica : {&early, &late}) {
      if (tick == 31) {
        ASSERT_TRUE(replica->Queue(OrderedAt(PushEdit{2, {0, 3}, 0}, 0, 30)));
      }
      if (tick == 41) {
        ASSERT_TRUE(replica->Queue(OrderedAt(SeatEdit{0, 0}, 1, 40)));
      }
      replica->Step();
    }
    if (tick == 59) {
      EXPECT_NE(late.world().Hash(), early.world().Hash()) << "not known yet";
    }
  }
  EXPECT_EQ(late.world().Hash(), early.world().Hash()) << "bit for bit";
  EXPECT_EQ(late.revision(), 2) << "a repeated edit is not another one";
  EXPECT_EQ(late.world().scene().seats[0].player, 0);
}

TEST(EditTick, IgnoresStatesOfASenderThatLackedAnEarlierEdit) {
  const Scene scene = ParseScene(kDriven, "driven.toml");
  const SyncConfig config = MakeSyncConfig("buffer", "rollback");
  Replica server(scene, config, 0, -1), client(scene, config, 1, 0);
  for (Replica* replica : {&server, &client}) {
    for (int m = 0; m < replica->authority().count(); ++m) {
      AuthorityRecord record;
      record.epoch = 1;
      record.authority = 1;
      record.secondaries.Add(0);
      replica->authority().Set(m, record);
    }
    replica->RolesChanged();
  }
  int before = 0, stale = 0;
  for (std::int64_t tick = 1; tick <= 60; ++tick) {
    if (tick == 31) {
      ASSERT_TRUE(server.Queue(OrderedAt(PushEdit{2, {0, 9}, 0}, 0, 30)));
    }
    server.Step();
    Input input;
    input.drive = 127;
    client.RecordInput(0, tick, input);
    client.Step();
    for (const States& states : client.TakeStates()) {
      const Received received = server.Receive(states);
      (states.tick <= 30 ? before : stale) += states.tick <= 30 ? received.used : received.stale;
      if (states.tick > 30) {
        EXPECT_EQ(received.used, 0);
      }
    }
  }
  EXPECT_GT(before, 0);
  EXPECT_GT(stale, 0);
}

TEST(EditTick, EditsThatDependOnInputsWaitForThemAndEqualTheOracles) {
  for (const std::int64_t seed : {8, 12}) {
    ClusterConfig config;
    config.scene = "gluehouse";
    config.reconcile = "rollback";
    config.impair = "4g";
    config.seed = seed;
    config.duration_s = 5.6;  // pieces break, meet and join
    const Recording recording = RunCluster(config);
    const Oracle oracle = ComputeOracle(recording, WithBarriers(recording.room));
    ASSERT_GE(oracle.edits.size(), 50u);
    std::size_t n = 0;
    for (const auto& [number, order] : recording.edits) {
      ASSERT_LT(n, oracle.edits.size()) << "seed " << seed;
      ASSERT_EQ(KeyOf(ToEdit(order)), KeyOf(oracle.edits[n++]))
          << "seed " << seed << ": edit " << number << " of tick " << order.tick;
    }
    EXPECT_GE(n + 2, oracle.edits.size()) << "the last may still be under way";
  }
}

}  // namespace edit_tick_test
}  // namespace seam
