/// The small parts of common/sync, each against its contract.

#include <gtest/gtest.h>

#include <cmath>

#include "client/clock_filter.h"
#include "common/base/check.h"
#include "common/base/random.h"
#include "common/sync/inputs/input_source.h"
#include "common/sync/inputs/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/quantize.h"
#include "common/sync/smoother.h"
#include "common/sync/snapshots.h"
#include "tests/support/quantised.h"

namespace seam {
namespace sync_parts_test {

TEST(Quantize, IsIdempotentAndBothEndsHoldTheSameNumbers) {
  Random random(7);
  std::vector<WireBody> bodies;
  std::vector<BodyState> states;
  for (int i = 0; i < 400; ++i) {
    BodyState b;
    b.position = Vec2(static_cast<float>(random.Uniform(-500, 500)),
                      static_cast<float>(random.Uniform(-500, 500)));
    b.angle = static_cast<float>(random.Uniform(-50, 50));
    b.velocity = Vec2(static_cast<float>(random.Uniform(-100, 100)),
                      static_cast<float>(random.Uniform(-100, 100)));
    b.spin = static_cast<float>(random.Uniform(-90, 90));
    const BodyState q = Quantised(b);
    const BodyState qq = Quantised(q);
    EXPECT_EQ(q.position, qq.position);
    EXPECT_EQ(q.angle, qq.angle);
    EXPECT_EQ(q.velocity, qq.velocity);
    EXPECT_EQ(q.spin, qq.spin);
    EXPECT_LE((q.position - b.position).cwiseAbs().maxCoeff(), kPositionQuantum * 0.51f);
    EXPECT_LE(std::fabs(q.spin - b.spin), kVelocityQuantum * 0.51f);
    WireBody wire = Quantise(b);
    wire.id = i;
    wire.epoch = i % 5;
    bodies.push_back(wire);
    states.push_back(q);
  }
  std::size_t seen = 0;
  for (const States& s : Pack(States{}, bodies)) {
    ASSERT_LE(s.id.size(), kStatesBodiesMax);
    for (std::size_t i = 0; i < s.id.size(); ++i, ++seen) {
      const BodyState& sent = states[static_cast<std::size_t>(s.id[i])];
      EXPECT_EQ(s.epoch[i], s.id[i] % 5);
      // The receiver's own copy is less than half a turn away.
      const BodyState got = Unpack(s, i, sent.angle + 2.5f);
      EXPECT_EQ(got.position, sent.position);
      EXPECT_EQ(got.angle, sent.angle);
      EXPECT_EQ(got.velocity, sent.velocity);
      EXPECT_EQ(got.spin, sent.spin);
    }
  }
  EXPECT_EQ(seen, bodies.size());
}

BodyState State(float x, float vx, float angle) {
  BodyState state;
  state.position.x() = x;
  state.velocity.x() = vx;
  state.angle = angle;
  return state;
}

TEST(Smoother, TheViewsVelocityIsContinuousAndItReturnsLikeACriticallyDampedSpring) {
  const BodyTable bodies(1, 0);
  Smoother smoother(bodies, kSmoothRate);
  smoother.Moved(0, State(0.1f, 0, 0));
  const float dt = 1 / 60.0f;
  for (int frame = 1; frame <= 60; ++frame) {
    smoother.Advance(0, dt, 100);
    const float t = static_cast<float>(frame) * dt;  // x = x0 (1 + w t) exp(-w t), w = 10/s
    EXPECT_NEAR(smoother.offset(0).x(), -0.1f * (1 + 10 * t) * std::exp(-10 * t), 1e-5f);
  }
}

TEST(Smoother, HalfOfAJumpOfVelocityIsHidden) {
  const BodyTable bodies(1, 0);
  Smoother smoother(bodies, kSmoothRate);
  smoother.Moved(0, State(0, 2, 0));
  smoother.Advance(0, 1e-4f, 100);
  EXPECT_NEAR(smoother.offset(0).x() / 1e-4f, -1, 2e-3f);
}

TEST(Smoother, ACorrectionDoesNotMoveTheViewAtOnceAndIsForgottenInTime) {
  const BodyTable bodies(1, 0);
  Smoother smoother(bodies, kSmoothRate);
  smoother.Moved(0, State(0.5f, 0, 0.1f));
  EXPECT_FLOAT_EQ(smoother.offset(0).x(), -0.5f);
  float last = 0.5f;
  for (int frame = 0; frame < 240; ++frame) {
    smoother.Advance(0, 1 / 60.0f, 0);
    const float size = smoother.offset(0).norm();
    EXPECT_LE(size, last);
    EXPECT_LE(last - size, 4.01f / 60) << "the glide has a speed limit";
    last = size;
  }
  EXPECT_LT(last, 1e-3f);
  EXPECT_LT(std::fabs(smoother.angle_offset(0)), 1e-3f);
}

TEST(Smoother, DoesNothingWhenOff) {
  const BodyTable bodies(1, 0);
  Smoother smoother(bodies, 0);
  smoother.Moved(0, State(0.5f, 1, 0.1f));
  smoother.Advance(0, 1 / 60.0f, 0);
  EXPECT_EQ(smoother.offset(0).norm(), 0);
}

TEST(ClockFilter, FindsTheOffsetUnderOneSidedJitterAndThenNeverJumps) {
  Random random(3);
  ClockFilter clock;
  const std::int64_t offset = 98765432;
  std::int64_t now = 1000;
  std::int64_t last = -1;
  std::int64_t last_now = 0;
  for (int i = 0; i < 400; ++i) {
    const auto there = static_cast<std::int64_t>(50000 + random.Exponential(10000));
    const auto back = static_cast<std::int64_t>(50000 + random.Exponential(10000));
    clock.AddSample(now, now + there + offset, now + there + back);
    now += there + back;
    for (int step = 0; step < 10; ++step) {
      now += 5000;
      const std::int64_t t = clock.ServerTime(now);
      if (clock.settled() && last >= 0) {
        EXPECT_GE(t, last) << "time ran backwards";
        const std::int64_t passed = now - last_now;
        EXPECT_LE(std::llabs(t - last - passed), passed / 500 + 1) << i;
      }
      last = clock.settled() ? t : -1;
      last_now = now;
    }
  }
  EXPECT_LT(std::llabs(clock.ServerTime(now) - now - offset), 3000);
  // The server's clock steps by five seconds: followed by slewing alone.
  std::int64_t before = clock.ServerTime(now);
  for (int i = 0; i < 100; ++i) {
    now += 100000;
    clock.AddSample(now - 100000, now - 50000 + offset + 5000000, now);
    const std::int64_t t = clock.ServerTime(now);
    EXPECT_LE(t - before, 100000 + 5001);
    EXPECT_GE(t - before, 100000 - 5001);
    before = t;
  }
}

TEST(ClockFilter, IgnoresAnswersFromBeforeTheQuestion) {
  ClockFilter clock;
  clock.AddSample(100, 5, 50);
  EXPECT_EQ(clock.rtt_min_us(), -1);
}

TEST(InputTrack, HoldsInputsBeyondTheNewestButReportsNoPressThere) {
  InputTrack track;
  track.Note(9, Input{});
  track.Note(10, Input{100, -5, 3});
  EXPECT_EQ(track.At(8), Input{});
  EXPECT_EQ(track.At(10), (Input{100, -5, 3}));
  EXPECT_EQ(track.At(15), (Input{100, -5, 3}));
  EXPECT_EQ(track.PressedAt(10), 3);
  EXPECT_EQ(track.PressedAt(11), 0) << "held, as far as is known";
  EXPECT_EQ(track.TakePresses(15), 3);
  EXPECT_EQ(track.TakePresses(16), 0);
}

TEST(InputTrack, APressMovesToItsTickWhenLateInputsFillTheGap) {
  InputTrack track;
  track.Note(2, Input{});
  track.Note(6, Input{0, 0, 1});
  EXPECT_EQ(track.PressedAt(6), 1);
  track.Note(4, Input{0, 0, 1});
  EXPECT_EQ(track.PressedAt(4), 1);
  EXPECT_EQ(track.PressedAt(6), 0);
}

TEST(InputTrack, ReportsEachPressOnceEvenWhenItComesLate) {
  InputTrack track;
  track.Note(1, Input{0, 0, 0});
  EXPECT_EQ(track.TakePresses(1), 0);
  track.Note(2, Input{0, 0, 1});
  track.Note(3, Input{0, 0, 1});
  track.Note(4, Input{0, 0, 2});
  EXPECT_EQ(track.TakePresses(6), 3) << "late, and two of them";
  EXPECT_EQ(track.TakePresses(7), 0);
  track.Note(7, Input{0, 0, 2});
  EXPECT_EQ(track.TakePresses(7), 0) << "still held";
}

TEST(InputTrack, ExportsTheNewestRunOfTicks) {
  InputTrack track;
  for (std::int64_t t = 0; t < 30; ++t) track.Note(t, Input{static_cast<std::int8_t>(t), 0, 0});
  const Inputs out = track.Export(4, 16);
  EXPECT_EQ(out.player, 4);
  EXPECT_EQ(out.first_tick, 14);
  ASSERT_EQ(out.drive.size(), 16u);
  EXPECT_EQ(out.drive.back(), 29);
  InputTrack other;
  other.Note(out);
  EXPECT_EQ(other.At(20), (Input{20, 0, 0}));
}

TEST(BotInput, IsAFunctionOfSeedPlayerAndTickAlone) {
  int differ = 0;
  for (std::int64_t t = 0; t < 600; ++t) {
    EXPECT_EQ(BotInput(5, 0, t, 60), BotInput(5, 0, t, 60));
    differ += BotInput(5, 0, t, 60) == BotInput(6, 0, t, 60) ? 0 : 1;
  }
  EXPECT_GT(differ, 300);
}

TEST(Snapshots, ReckonWithAnAccelerationThatLasts) {
  const BodyTable bodies(1, 0);
  Snapshots snapshots(bodies);
  const float dt = 1 / 60.0f;
  // Brakes at 6 m/s^2 from 20 m/s at tick 0: v = 20 - 6 t, x = 20 t - 3 t^2.
  for (const std::int64_t tick : {0, 3, 6}) {
    const float t = static_cast<float>(tick) * dt;
    snapshots.Add(0, tick, State(20 * t - 3 * t * t, 20 - 6 * t, 0));
  }
  const BodyState at = snapshots.Extrapolate(0, 18, dt, 1);  // 0.2 s on
  EXPECT_NEAR(at.position.x(), 20 * 0.3f - 3 * 0.09f, 1e-4f);
  EXPECT_NEAR(at.velocity.x(), 20 - 6 * 0.3f, 1e-4f);
  // Beyond 0.3 s it moves on with the velocity it has then.
  const BodyState late = snapshots.Extrapolate(0, 36, dt, 1);
  EXPECT_NEAR(late.velocity.x(), 20 - 6 * 0.4f, 1e-4f);
  EXPECT_NEAR(late.position.x(), 20 * 0.4f - 3 * 0.16f + 0.2f * late.velocity.x(), 1e-4f);
}

TEST(Snapshots, ReckonAnImpactWithoutItsAcceleration) {
  const BodyTable bodies(1, 0);
  Snapshots snapshots(bodies);
  snapshots.Add(0, 0, State(0, 10, 0));
  snapshots.Add(0, 2, State(0, -5, 0));
  EXPECT_NEAR(snapshots.Extrapolate(0, 14, 1 / 60.0f, 1).position.x(), -5 * 0.2f, 1e-5f);
}

/// A blade that its motor brings to 0.99 m/s within a tick was reckoned to gain 9 m/s.
TEST(Snapshots, ReckonASingleStartOrImpactWithoutItsAcceleration) {
  const float dt = 1 / 60.0f;
  for (const float speed : {0.99f, 0.3f, -0.6f}) {
    const BodyTable bodies(1, 0);
    Snapshots snapshots(bodies);
    snapshots.Add(0, 0, State(0, 0, 0));
    snapshots.Add(0, 2, State(0, speed, 0));
    EXPECT_NEAR(snapshots.Extrapolate(0, 20, dt, 1).velocity.x(), speed, 1e-6f) << "as first heard";
    snapshots.Add(0, 4, State(0, speed, 0));
    EXPECT_NEAR(snapshots.Extrapolate(0, 20, dt, 1).velocity.x(), speed, 1e-6f);
    snapshots.Add(0, 6, State(0, 0.1f, 0));
    EXPECT_NEAR(snapshots.Extrapolate(0, 20, dt, 1).velocity.x(), 0.1f, 1e-6f) << "struck";
    snapshots.Add(0, 8, State(0, speed, 0));
    EXPECT_NEAR(snapshots.Extrapolate(0, 20, dt, 1).velocity.x(), speed, 1e-6f) << "and back";
  }
}

TEST(Snapshots, TheNewestIsTheLastThatIsKeptAndCarriedOver) {
  BodyTable bodies(2, 0);
  Snapshots snapshots(bodies);
  EXPECT_FALSE(snapshots.has(0));
  for (int tick = 1; tick <= 200; ++tick) {  // around its ring, twice
    snapshots.Add(0, tick, State(static_cast<float>(tick), 0, 0));
    EXPECT_EQ(snapshots.newest(0).position.x(), static_cast<float>(tick));
  }
  snapshots.ForgetAfter(0, 150);
  EXPECT_EQ(snapshots.newest_tick(0), 150);
  EXPECT_EQ(snapshots.newest(0).position.x(), 150);
  BodyRemap change;
  change.bodies.resize(1);
  change.bodies[0].body = 0;
  change.bodies[0].root = {2, 0};
  bodies.Renumber(change);
  EXPECT_EQ(snapshots.newest(0).position.x(), 152);
  EXPECT_EQ(snapshots.At(0, 149)->position.x(), 151);
  snapshots.ForgetAfter(0, 0);
  EXPECT_FALSE(snapshots.has(0));
}

TEST(Snapshots, KeepThreeSecondsAndLittleMoreOfSparseStates) {
  constexpr std::int64_t kSeconds = 60;
  const BodyTable bodies(2, 0);
  Snapshots snapshots(bodies);
  for (std::int64_t tick = 0; tick <= 100 * kSeconds; tick += 2) {
    snapshots.Add(0, tick, BodyState());
    if (tick % kSeconds == 0) snapshots.Add(1, tick, BodyState());
  }
  EXPECT_NE(snapshots.At(0, 97 * kSeconds), nullptr);
  EXPECT_EQ(snapshots.At(0, 96 * kSeconds), nullptr);
  EXPECT_NE(snapshots.At(1, 92 * kSeconds), nullptr);
  EXPECT_EQ(snapshots.At(1, 86 * kSeconds), nullptr);
}

TEST(Mode, NamesAreCheckedAndReconcilersBelongToBuffer) {
  EXPECT_EQ(MakeSyncConfig("buffer", "").reconcile_name, "rollback");
  EXPECT_EQ(MakeSyncConfig("strict", "").reconcile, nullptr);
  EXPECT_THROW(MakeSyncConfig("strict", "fade"), OperatorError);
  EXPECT_THROW(MakeSyncConfig("locksteps", ""), OperatorError);
  for (const std::string& mode : ModeNames()) {
    EXPECT_EQ(FindPolicy(mode, "", false)->mode(), mode);
  }
  for (const char* name : {"", "locksteps", "Oracle", "buffer "}) {
    EXPECT_EQ(FindPolicy(name, "", false), nullptr) << name;
  }
}

}  // namespace sync_parts_test
}  // namespace seam
