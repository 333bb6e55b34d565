/// Rooms in worker threads: one that holds its thread does not hold up the others.

#include "server/hub/lanes.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>

#include "common/base/process.h"

namespace seam {
namespace lanes_test {

constexpr std::int64_t kPeriodUs = 16667;

/// A room with ticks of `busy_us`, asleep or at work; records the lateness of its runs.
class Metronome : public Runnable {
 public:
  explicit Metronome(std::int64_t busy_us = 0, bool spins = false)
      : busy_us_(busy_us), spins_(spins), due_us_(SteadyClockUs() + kPeriodUs) {}
  void Run(std::int64_t now_us) override {
    EXPECT_FALSE(inside_.exchange(true)) << "two threads in one room";
    const std::int64_t late_us = now_us - due_us_;
    if (late_us >= 0) {
      worst_late_us_ = std::max<std::int64_t>(worst_late_us_, late_us);
      if (late_us > kPeriodUs) ++late_ticks_;
      ++ticks_;
      due_us_ = std::max(due_us_ + kPeriodUs, now_us - 10 * kPeriodUs);
      const std::int64_t busy_us = busy_us_, end_us = SteadyClockUs() + busy_us;
      if (busy_us > 0 && !spins_) usleep(static_cast<useconds_t>(busy_us));
      while (spins_ && SteadyClockUs() < end_us) {
      }
    }
    inside_ = false;
  }
  std::int64_t due_us() const override { return due_us_; }
  void SetBusy(std::int64_t us) { busy_us_ = us; }
  std::int64_t worst_late_us() const { return worst_late_us_; }
  /// Ticks that came more than a tick late, and all.
  int late_ticks() const { return late_ticks_; }
  int ticks() const { return ticks_; }

 private:
  std::atomic<std::int64_t> busy_us_;
  const bool spins_;
  std::atomic<std::int64_t> due_us_;
  std::atomic<bool> inside_{false};
  std::atomic<std::int64_t> worst_late_us_{0};
  std::atomic<int> late_ticks_{0}, ticks_{0};
};

/// Waits until it is so; a busy machine takes longer.
template <class Condition>
bool WaitFor(const Condition& condition) {
  for (int i = 0; i < 6000 && !condition(); ++i) usleep(10000);
  return condition();
}
void WaitForTicks(const Metronome& room, int ticks) {
  (void)WaitFor([&] { return room.ticks() >= ticks; });
}

/// A room that blocks beside three others; returns how many threads they have in the end.
int ThreadsBesideOneThatBlocks(int workers) {
  Metronome sleepy(150000), a, b, c;
  int threads = 0;
  {
    Lanes lanes({&sleepy, &a, &b, &c}, workers);
    for (Metronome* room : {&a, &b, &c}) WaitForTicks(*room, 120);
    threads = lanes.lane_count();
  }
  EXPECT_GT(sleepy.ticks(), 5);
  for (const Metronome* room : {&a, &b, &c}) {
    EXPECT_GE(room->ticks(), 120);
    // A part for the machine's own doings, which may be many; without a thread of their own they
    // would be late in nine ticks of ten.
    EXPECT_LT(room->late_ticks(), room->ticks() / 2)
        << workers << " worker(s), worst " << room->worst_late_us() << " us";
  }
  return threads;
}

TEST(Lanes, ARoomThatBlocksDelaysNoOtherByMoreThanATick) {
  for (const int workers : {1, 2}) {
    // A machine that stops in the middle of a call makes that room a slow one, too.
    int threads = 0;
    for (int time = 0; time < 4 && threads != workers + 1; ++time) {
      threads = ThreadsBesideOneThatBlocks(workers);
    }
    EXPECT_EQ(threads, workers + 1) << "it has a thread of its own, and no more";
  }
}

TEST(Lanes, ARoomThatIsCalmAgainSharesAThread) {
  Metronome sleepy(50000), a;
  Lanes lanes({&sleepy, &a}, 1);
  EXPECT_TRUE(WaitFor([&] { return lanes.lane_count() == 2; }));
  sleepy.SetBusy(0);
  EXPECT_TRUE(WaitFor([&] { return lanes.lane_count() == 1; }));
  const int before = sleepy.ticks();
  WaitForTicks(sleepy, before + 5);
  EXPECT_GE(sleepy.ticks(), before + 5) << "it is still run";
}

/// A room that is never due by itself.
class Sleeper : public Runnable {
 public:
  void Run(std::int64_t) override { ++runs; }
  std::int64_t due_us() const override { return INT64_MAX; }
  std::atomic<int> runs{0};
};

TEST(Lanes, AWokenRoomRuns) {
  Sleeper room, other;
  Lanes lanes({&room, &other}, 2);
  usleep(20000);
  EXPECT_EQ(room.runs, 0);
  lanes.Wake(0);
  EXPECT_TRUE(WaitFor([&] { return room.runs > 0; }));
  EXPECT_EQ(room.runs, 1);
  EXPECT_EQ(other.runs, 0);
}

TEST(Lanes, AHeldRoomRestsWhileTheOthersRun) {
  Metronome held, other;
  Lanes lanes({&held, &other}, 1);
  WaitForTicks(held, 5);
  lanes.Hold(0);
  const int ticks = held.ticks(), others = other.ticks();
  lanes.Wake(0);
  WaitForTicks(other, others + 10);
  EXPECT_EQ(held.ticks(), ticks);
  EXPECT_GE(other.ticks(), others + 10);
  lanes.Free(0);
  WaitForTicks(held, ticks + 5);
  EXPECT_GE(held.ticks(), ticks + 5);
}

}  // namespace lanes_test
}  // namespace seam
