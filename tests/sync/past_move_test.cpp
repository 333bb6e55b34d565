/// A replay moves a body in the past by a state that was received. Where others are shown in the
/// past, the view comes to that tick later, and glides there as it does in the present.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/sync/quantize.h"
#include "tests/support/wired_replicas.h"

namespace seam {
namespace past_move_test {

const char* const kTwo = R"(
gravity = [0, 0]
[[player]]
name = "ann"
vehicle = "one"
[[player]]
name = "bob"
vehicle = "two"
[[part]]
name = "one"
circle = 0.5
velocity = [3, 0]
owner = "ann"
[[part]]
name = "two"
circle = 0.5
position = [0, 30]
owner = "bob"
)";

/// Bob's view of ann's disc after he received states of it that are `off` above its path, each some
/// ticks old: the most by which the way of one tick differs from that of the one before.
float JumpSeen(const std::vector<std::int64_t>& ages, float off) {
  const Scene scene = ParseScene(kTwo, "two.toml");
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.show_age_ticks = 12;
  WiredReplicas room(scene, config, 10, [](int, std::int64_t) { return Input{}; });
  room.StepTo(120);
  Replica& bob = room.at(2);
  const int disc = room.Body(2, "one");
  const auto seen = [&] {
    const View view = bob.MakeView();
    return Vec2(view.x[static_cast<std::size_t>(disc)], view.y[static_cast<std::size_t>(disc)]);
  };
  Vec2 before = seen();
  room.Step();
  Vec2 way = seen() - before;
  room.states_flow = false;
  float most = 0, first = off;
  for (int step = 0; step < 60; ++step) {
    for (std::size_t i = 0; i < ages.size(); ++i) {
      if (step != static_cast<int>(2 * i)) continue;
      States header;
      header.peer = 1;
      header.tick = bob.tick() - ages[i];
      BodyState state = bob.world().Read(disc);
      state.position -= static_cast<float>(ages[i]) / 60 * state.velocity;
      state.position.y() += std::exchange(first, -first / 2);
      WireBody body = Quantise(state);
      body.id = bob.world().id(disc);
      body.epoch = 1;
      for (const States& states : Pack(header, {body})) bob.Receive(states);
    }
    before = seen();
    room.Step();
    const Vec2 now = seen() - before;
    most = std::max(most, (now - way).norm());
    way = now;
  }
  EXPECT_NEAR(seen().y(), bob.world().Read(disc).position.y(), 0.01f) << "it has come there";
  EXPECT_GT(std::fabs(seen().y()), 0.3f);
  return most;
}

TEST(PastMove, TheViewGlidesOverACorrectionAheadOfItsMoment) {
  EXPECT_LT(JumpSeen({3}, 0.9f), 0.1f);
  EXPECT_LT(JumpSeen({6}, -2), 0.1f);
}

TEST(PastMove, TheViewGlidesOverSeveralCorrections) { EXPECT_LT(JumpSeen({4, 3, 4}, 0.9f), 0.15f); }

}  // namespace past_move_test
}  // namespace seam
