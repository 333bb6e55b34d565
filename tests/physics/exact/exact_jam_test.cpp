/// Bodies jammed from several sides gain no energy.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/measure/overlap.h"
#include "tests/physics/exact/exact_jams.h"

namespace seam {
namespace exact_jam_test {

double MassOf(const World& world) {
  double mass = 0;
  for (int body = 0; body < world.body_count(); ++body) mass += double{world.mass(body)};
  return mass;
}

/// Energy gains of a run, J/kg: the largest within a tick, and the total.
struct Gains {
  double tick = 0, all = 0;
};

Gains GainsOf(World* world, int ticks) {
  const double mass = MassOf(*world), begin = world->Energy();
  Gains gains;
  double last = begin;
  for (int i = 0; i < ticks; ++i) {
    world->Step();
    const double now = world->Energy();
    gains.tick = std::max(gains.tick, (now - last) / mass);
    gains.all = std::max(gains.all, (now - begin) / mass);
    if (!std::isfinite(now)) gains.all = INFINITY;
    last = now;
  }
  return gains;
}

/// Pushing the crates out of each other lifts them by half a metre at most: 5 J/kg.
void ExpectNoGain(JamPlace place, unsigned seed) {
  const auto world = ExactWorld(JamMaker(seed).Text(place));
  const Gains gains = GainsOf(world.get(), 60);
  EXPECT_LT(gains.tick, 1) << "J/kg in a tick, seed " << seed;
  EXPECT_LT(gains.all, 5) << "J/kg, seed " << seed;
}

void ExpectNoGain(JamPlace place) {
  for (unsigned seed = 1; seed <= 100; ++seed) ExpectNoGain(place, seed);
}

/// m/s: the fastest body in so many ticks.
double FastestOf(World* world, int ticks) {
  double most = 0;
  for (int i = 0; i < ticks; ++i) {
    world->Step();
    for (const BodyState& state : StatesOf(*world)) {
      const double speed = double{state.velocity.norm()};
      most = std::isfinite(speed) ? std::max(most, speed) : INFINITY;
    }
  }
  return most;
}

/// A press that moves its lower side from `high` to `low` and back in 4 s.
std::string PressText(double high, double low) {
  return PartText("press", "box = [3, 0.5]\nanchored = true\nposition = [0, " +
                               FloatDigits(high + 0.25) + "]") +
         "[[joint]]\nname = \"mover\"\nkind = \"kinematic\"\nb = \"press\"\nperiod = 4\n" +
         "path = [[0, 0], [0, " + FloatDigits(low - high) + "]]\n";
}

TEST(ExactJam, CratesJammedInAPitGainNoEnergy) { ExpectNoGain(JamPlace::kPit); }

TEST(ExactJam, CratesJammedBetweenTheRailsOfAWagonGainNoEnergy) { ExpectNoGain(JamPlace::kWagon); }

TEST(ExactJam, JointsHeldApartByAJamDoNotComeTogetherAtOnce) {
  // Closing their joints would lift all crates by 8 to 13 cm in a tick: after continuous collision
  // (114), in an ordinary substep (168, 382), or both (89).
  for (const unsigned seed : {89U, 114U, 168U, 377U, 382U}) ExpectNoGain(JamPlace::kPit, seed);
  for (const unsigned seed : {146U, 336U, 350U}) ExpectNoGain(JamPlace::kWagon, seed);
}

/// m: of so many jams after 3 s, the middle one of their deepest overlaps.
double MiddleOverlap(JamPlace place, unsigned jams) {
  std::vector<double> deepest;
  for (unsigned seed = 1; seed <= jams; ++seed) {
    const auto world = ExactWorld(JamMaker(seed).Text(place));
    OverlapMeter meter(world->scene(), world->composition());
    Steps(world.get(), 180);
    deepest.push_back(meter.Deepest(StatesOf(*world)));
  }
  std::nth_element(deepest.begin(), deepest.begin() + jams / 2, deepest.end());
  return deepest[jams / 2];
}

TEST(ExactJam, CratesThatOverlapByHalfComeApartAlthoughTheyAreJammed) {
  EXPECT_LT(MiddleOverlap(JamPlace::kWagon, 21), 0.05);
  EXPECT_LT(MiddleOverlap(JamPlace::kPit, 21), 0.25);
}

TEST(ExactJam, APressThatSqueezesJointedPlanksThrowsNothing) {
  // Two planks of 0.3 m, hinged; the press comes down to 0.2 m at 0.4 m/s and goes up again.
  const auto world = ExactWorld(std::string(kGround) + PressText(1, 0.2) +
                                PartText("plank",
                                         "box = [1, 0.3]\nposition = [-0.5, 0.16]\n"
                                         "repeat = {count = 2, step = [1, 0]}") +
                                HingeText("h", "plank.0", "plank.1", 0, 0.16));
  EXPECT_LT(FastestOf(world.get(), 240), 4);
  EXPECT_LT(Drift(*world), 1e-4);
}

TEST(ExactJam, APressOnRandomJamsThrowsNoBodyFar) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto world = ExactWorld(JamMaker(seed).Text(JamPlace::kPit, PressText(3, 1)));
    EXPECT_LT(FastestOf(world.get(), 150), 25) << "m/s, seed " << seed;
  }
}

TEST(ExactJam, AJamLeftToTheEngineDropsImpulsesItCannotCarry) {
  // Cost decides from tick to tick which solver takes these.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto world =
        SmallWorld(JamMaker(seed).Text(JamPlace::kWagon), "joints = \"auto\"\nsubsteps = 2\n");
    EXPECT_LT(GainsOf(world.get(), 60).tick, 5) << "J/kg in a tick, seed " << seed;
  }
}

TEST(ExactJam, AJamIsTheSameAfterABarrierAndAfterGoingBack) {
  for (const unsigned seed : {1U, 52U, 77U}) {
    const auto world = ExactWorld(JamMaker(seed).Text(JamPlace::kPit));
    Steps(world.get(), 10);
    const WorldSnapshot barrier = world->Barrier();
    Steps(world.get(), 20);
    const std::uint64_t first = world->Hash();
    ASSERT_TRUE(world->Restore(barrier).ok());
    Steps(world.get(), 20);
    EXPECT_EQ(world->Hash(), first) << seed;
  }
}

}  // namespace exact_jam_test
}  // namespace seam
