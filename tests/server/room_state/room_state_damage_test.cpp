/// Damaged bytes of a room are refused in one line, and never crash; saving is quick.

#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "common/base/random.h"
#include "tests/support/arena.h"
#include "tests/support/lone_room.h"

namespace seam {
namespace room_state_damage_test {

/// A room with edits, rest, joints, a seat and a script: some of everything that is saved.
Bytes Rich() {
  LoneRoom room(Arena());
  room.StepTo(110);
  return room.Save();
}

TEST(RoomStateDamage, TruncatedBytesAreRefused) {
  const Bytes good = Rich();
  for (std::size_t size = 0; size < good.size(); size += 1 + size / 40) {
    LoneRoom loaded(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)),
                    "buffer");
    ASSERT_TRUE(loaded.server == nullptr) << size;
    ASSERT_EQ(loaded.status.why().find("this is no saved room: "), 0u) << loaded.status.why();
  }
}

TEST(RoomStateDamage, FlippedBitsAreRefused) {
  const Bytes good = Rich();
  Random random(11);
  for (int i = 0; i < 3000; ++i) {
    Bytes bad = good;
    bad[random.Next() % bad.size()] ^= static_cast<std::uint8_t>(1u << random.Next() % 8);
    Status status;
    ASSERT_TRUE(SavedRoom::Read(bad, &status) == nullptr);
    ASSERT_FALSE(status.ok());
    ASSERT_EQ(status.why().find('\n'), std::string::npos);
  }
}

/// Bytes that are changed and signed may be accepted, if all that they say is possible; then the
/// room runs. Nothing crashes.
void Attack(const Bytes& good, int times, std::uint64_t seed) {
  Random random(seed);
  int refused = 0, accepted = 0;
  for (int i = 0; i < times; ++i) {
    Bytes bad = good;
    const int changes = 1 + static_cast<int>(random.Next() % 3);
    for (int c = 0; c < changes; ++c) {
      const std::size_t at = 24 + random.Next() % (bad.size() - 24);
      const std::uint64_t how = random.Next() % 4;
      if (how == 0) bad[at] = 0xff;
      if (how == 1) bad[at] = 0;
      if (how >= 2) bad[at] ^= static_cast<std::uint8_t>(1u << random.Next() % 8);
    }
    if (random.Chance(0.1)) bad.resize(24 + random.Next() % (bad.size() - 24));
    SignSavedRoom(&bad);
    LoneRoom loaded(bad, "buffer");
    if (loaded.server == nullptr) {
      ++refused;
      ASSERT_FALSE(loaded.status.ok());
      ASSERT_EQ(loaded.status.why().find('\n'), std::string::npos) << loaded.status.why();
      continue;
    }
    ++accepted;
    for (int t = 0; t < 3; ++t) loaded.Step();
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(refused, times / 10);
  EXPECT_GT(accepted, 0);
}

TEST(RoomStateDamage, SignedDamageNeverCrashes) {
  const Bytes good = Rich();
  for (const std::uint64_t seed : {1, 14, 31, 58}) Attack(good, 500, seed);
}

TEST(RoomStateDamage, SignedDamageOfBondsSeatsAndWaterNeverCrashes) {
  for (const char* scene : {"dockside", "gluehouse", "ragdolls"}) {
    LoneRoom room(LoadScene("scenes/" + std::string(scene) + ".toml"));
    room.StepTo(100);
    Attack(room.Save(), 200, 2);
  }
}

/// There in a program under the address sanitizer alone. The macro __SANITIZE_ADDRESS__ says only
/// how this file was compiled; the copy is made by others.
extern "C" void __asan_init() __attribute__((weak));

/// A sanitizer makes the copy fifteen times slower, and not the tick, which is the engine's.
bool TimesCount() { return __asan_init == nullptr; }

/// CPU time of this thread.
template <typename F>
double Milliseconds(F work) {
  const auto now_ms = [] {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
  };
  const double begin = now_ms();
  work();
  return now_ms() - begin;
}

/// Cost of saving a room.
struct Cost {
  double copy_ms = 1e9, tick_ms = 1e9;  // the best of five
  std::size_t bytes = 0, in_the_tick = 0;  // written in all, and of these in the tick
};

Cost CostAt(LoneRoom* room, std::int64_t tick) {
  room->StepTo(tick);
  Cost cost;
  std::size_t copied = 0;
  for (int i = 0; i < 5; ++i) {
    cost.tick_ms = std::min(cost.tick_ms, Milliseconds([&] { room->Step(); }));
    while (room->server->tick() % BarrierEvery(60) != 0) room->Step();  // as RoomKeeper does
    StateDraft copy;
    cost.copy_ms = std::min(
        cost.copy_ms, Milliseconds([&] { copy = room->server->CopyState(room->now_us, copied); }));
    cost.in_the_tick = copied = copy.size();
    cost.bytes = RoomState::Finish(std::move(copy)).size();
  }
  return cost;
}

TEST(RoomStateDamage, SavingCostsNoMoreThanAFewTicks) {
  LoneRoom room(LoadScene("scenes/swarm.toml"));
  double busy_tick_ms = 0;
  for (const std::int64_t tick : {30, 400, 900}) {  // all things fall; they have fallen; they lie
    const Cost cost = CostAt(&room, tick);
    const int bodies = room.server->replica().world().body_count();
    ASSERT_GE(bodies, 1000);
    std::printf("%d bodies, tick %lld: %.2f ms, a tick %.2f ms, %zu bytes, %zu in it\n", bodies,
                static_cast<long long>(tick), cost.copy_ms, cost.tick_ms, cost.bytes,
                cost.in_the_tick);
    busy_tick_ms = std::max(busy_tick_ms, cost.tick_ms);
    if (TimesCount()) {
      EXPECT_LT(cost.copy_ms, 10 * busy_tick_ms);
    }
    EXPECT_LT(cost.in_the_tick, cost.bytes / 4);
    EXPECT_LT(cost.bytes, static_cast<std::size_t>(bodies) * 8000);
  }
}

}  // namespace room_state_damage_test
}  // namespace seam
