/// The number of bodies that a client's machine can step, from its reported load.

#include <gtest/gtest.h>

#include <functional>

#include "client/load_meter.h"
#include "server/authority/capacity_watch.h"
#include "server/authority/plan.h"

namespace seam {
namespace capacity_test {

constexpr int kPeer = 3;

/// A machine of which each body that is stepped needs this share, and which says so `late_us` late.
struct Machine {
  float each;
  int wanted;  // bodies there are for it
  std::int64_t late_us = 600000;

  /// Bodies stepped after so long, planned ten times a second.
  int After(std::int64_t end_us) {
    CapacityWatch watch;
    std::vector<int> steps;
    const auto late = static_cast<std::size_t>(late_us / 100000);
    for (std::int64_t now = 0; now <= end_us; now += 100000) {
      const int stepped = steps.empty() ? wanted : steps.back();
      const float load =
          steps.size() > late ? static_cast<float>(steps[steps.size() - late]) * each : -1;
      const int capacity = watch.Look(0, now, kPeer, load, [&] { return stepped; });
      steps.push_back(std::min(wanted, capacity));
    }
    return steps.back();
  }
};

TEST(CapacityWatch, ABusyMachineReachesItsCapacityWithinFiveSeconds) {
  for (const float times : {1.2f, 2.0f, 4.0f, 8.0f}) {
    Machine machine{times / 200, 200};
    const float load = static_cast<float>(machine.After(5000000)) * machine.each;
    EXPECT_GT(load, 0.5f) << times;
    EXPECT_LT(load, 1.25f) << times;
  }
}

TEST(CapacityWatch, AMachineThatKeepsUpIsNeverLimited) {
  EXPECT_EQ((Machine{0.95f / 200, 200}).After(5000000), 200);
}

TEST(CapacityWatch, ARelievedMachineGetsMoreUntilItIsUnlimited) {
  CapacityWatch watch;
  const auto steps = [] { return 50; };
  EXPECT_EQ(watch.Look(0, 1000000, kPeer, 2, steps), 20);
  EXPECT_EQ(watch.Look(0, 1100000, kPeer, 2, steps), 20) << "what it says is from before";
  int capacity = 20;
  for (std::int64_t now = 2000000; now < 30000000; now += 1000000) {
    const int next = watch.Look(0, now, kPeer, 0.2f, steps);
    EXPECT_GE(next, capacity);
    capacity = next;
  }
  EXPECT_EQ(capacity, PlayerView::kUnlimited);
}

TEST(CapacityWatch, BelongsToAPeerAndNotToAPlace) {
  CapacityWatch watch;
  const auto steps = [] { return 50; };
  ASSERT_LT(watch.Look(1, 1000000, kPeer, 2, steps), 50);
  EXPECT_EQ(watch.Look(1, 1100000, kPeer + 1, -1, steps), PlayerView::kUnlimited);
  EXPECT_EQ(watch.Look(0, 1100000, kPeer, -1, steps), PlayerView::kUnlimited);
}

TEST(LoadMeter, MeasuresTheShareOfTimeThatTicksNeed) {
  LoadMeter meter;
  EXPECT_EQ(meter.permille(), -1);
  std::int64_t cpu = 1;
  for (std::int64_t now = 0; now <= 2000000; now += 16667) {
    cpu += 5000;
    meter.Note(now, cpu, 1, 0, 16667);
  }
  EXPECT_NEAR(meter.permille(), 300, 15);
}

TEST(LoadMeter, MeasuresTheExcessOfAMachineThatCannotKeepUp) {
  LoadMeter meter;
  std::int64_t cpu = 1;
  for (std::int64_t now = 0; now <= 2000000; now += 50000) {  // all of it for a tick of 16.7 ms
    cpu += 50000;
    meter.Note(now, cpu, 1, 100000, 16667);
  }
  EXPECT_NEAR(meter.permille(), 3000, 150);
}

/// The meter's load after two seconds of calls with lateness `late_us` (of the time) and almost no
/// cost.
std::int16_t LoadOfLate(const std::function<std::int64_t(std::int64_t)>& late_us) {
  LoadMeter meter;
  std::int64_t cpu = 1;
  for (std::int64_t now = 0; now <= 2000000; now += 16667) {
    meter.Note(now, ++cpu, 1, late_us(now), 16667);
  }
  return meter.permille();
}

TEST(LoadMeter, GrowingLatenessIsOverloadAtAnyCpuTime) {
  EXPECT_EQ(LoadOfLate([](std::int64_t now) { return 20000 + now / 10; }), LoadMeter::kLateLoad);
  EXPECT_EQ(LoadOfLate([](std::int64_t) { return 80000; }), LoadMeter::kLateLoad)
      << "and whose are very late";
}

TEST(LoadMeter, ConstantOrShrinkingLatenessIsNoOverload) {
  EXPECT_LT(LoadOfLate([](std::int64_t) { return 25000; }), 10);
  EXPECT_LT(LoadOfLate([](std::int64_t now) { return 280000 - now / 10; }), 10);
  EXPECT_LT(LoadOfLate([](std::int64_t now) { return now / 200; }), 10) << "not by a tick yet";
}

TEST(LoadMeter, RareTicksAreOverload) {
  LoadMeter meter;
  std::int64_t cpu = 1;
  for (std::int64_t now = 0; now <= 4000000; now += 400000) {
    meter.Note(now, ++cpu, 20, 390000, 16667);
  }
  EXPECT_EQ(meter.permille(), LoadMeter::kLateLoad);
}

TEST(LoadMeter, ForgetsPastLateness) {
  LoadMeter meter;
  std::int64_t cpu = 1, now = 0;
  for (; now <= 2000000; now += 16667) meter.Note(now, ++cpu, 1, 80000, 16667);
  EXPECT_EQ(meter.permille(), LoadMeter::kLateLoad);
  for (; now <= 4000000; now += 16667) meter.Note(now, ++cpu, 1, 0, 16667);
  EXPECT_LT(meter.permille(), 10);
}

TEST(LoadMeter, IsUnknownWithoutCpuTime) {
  LoadMeter meter;
  for (std::int64_t now = 0; now <= 2000000; now += 16667) meter.Note(now, 0, 1, 20000, 16667);
  EXPECT_EQ(meter.permille(), -1);
}

}  // namespace capacity_test
}  // namespace seam
