/// Required abilities of active characters, on starts that no search has seen (searches number
/// theirs from 1001): the bars of docs/lab.md.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "tests/lab/gait/ability.h"
#include "tests/support/character_world.h"

namespace seam {
namespace character_ability_test {

/// Counts the trials with a group that begins with one of these words.
struct Tally {
  int good = 0, count = 0;
  std::vector<double> figures;  // of the good ones
  std::string failed;           // starts
  double median() {
    std::sort(figures.begin(), figures.end());
    return figures.empty() ? 0 : figures[figures.size() / 2];
  }
};

/// Starts `first` to `last` of an ability with the gains built in, those of other groups left out.
Tally TryFrom(int first, const char* ability, int last, const std::string& group = "") {
  Tally tally;
  for (int start = first; start <= last; ++start) {
    const GaitTrial trial =
        FindAbility(ability)->run({"substeps = 4", ""}, CharacterGains{}, start);
    if (trial.group.find(group) == std::string::npos) continue;
    ++tally.count;
    tally.good += trial.good ? 1 : 0;
    if (trial.good) tally.figures.push_back(trial.figure);
    if (!trial.good) tally.failed += " " + std::to_string(start);
  }
  return tally;
}

/// From start 1 on.
Tally Try(const char* ability, int last, const std::string& group = "") {
  return TryFrom(1, ability, last, group);
}

TEST(CharacterAbility, LandsARunningJumpUprightAtThreeDrivesAndEightPhases) {
  Tally jumps = Try("jump", 24);
  EXPECT_GE(jumps.good, 23) << jumps.failed;
  ASSERT_EQ(jumps.count, 24);
  EXPECT_GE(*std::min_element(jumps.figures.begin(), jumps.figures.end()), 0.25)
      << "m of the soles";
}

/// Legs that swing forwards for the landing turn the torso the other way: 11 of 60 fell.
TEST(CharacterAbility, LandsRunningJumpsAtFullDriveFromOtherStarts) {
  Tally jumps = TryFrom(60001, "jump", 60120, "drive 1");
  ASSERT_EQ(jumps.count, 60);
  EXPECT_GE(jumps.good, 58) << jumps.failed;
}

TEST(CharacterAbility, KeepsItsFeetUnderAShoveOfOneNewtonSecondPerKilogram) {
  const Tally standing = Try("shove", 48, "standing"), walking = Try("shove", 48, "walking");
  const Tally running = Try("shove", 48, "running");
  ASSERT_EQ(standing.count, 16);
  EXPECT_EQ(standing.good, 16) << standing.failed;
  EXPECT_GE(walking.good, 15) << walking.failed;
  EXPECT_GE(running.good, 12) << running.failed;
}

TEST(CharacterAbility, ClimbsAndDescendsStairsOfFifteenAndTwentyCentimetres) {
  const Tally low = Try("stairs", 24, "15 cm"), high = Try("stairs", 24, "20 cm");
  ASSERT_EQ(low.count, 12);
  EXPECT_GE(low.good, 11) << low.failed;
  EXPECT_GE(high.good, 9) << high.failed;
}

/// When the knee of the bearing leg yields, its ankle must not turn the foot over the edge: at 20
/// cm it fell in 16 of 60. And the heel must not come down on the edge of the stair that it leaves:
/// it fell in 7 to 19 of 60.
TEST(CharacterAbility, DescendsOtherFlightsOfTwelveToTwentyCentimetres) {
  std::map<std::string, Tally> flights;
  for (int start = 20001; start <= 20240; ++start) {
    const GaitTrial trial =
        FindAbility("descent")->run({"substeps = 4", ""}, CharacterGains{}, start);
    Tally& flight = flights[trial.group];
    ++flight.count;
    flight.good += trial.good ? 1 : 0;
    if (!trial.good) flight.failed += " " + std::to_string(start);
  }
  for (const auto& [stairs, least] : {std::pair("12 cm down", 58), std::pair("15 cm down", 58),
                                      std::pair("18 cm down", 57), std::pair("20 cm down", 55)}) {
    const Tally& down = flights[stairs];
    ASSERT_EQ(down.count, 60);
    EXPECT_GE(down.good, least) << stairs << down.failed;
  }
}

TEST(CharacterAbility, DescendsSixStairsOfTwentyCentimetres) {
  const Tally down = TryFrom(20001, "stairs", 20144, "20 cm down");
  ASSERT_EQ(down.count, 36);
  EXPECT_GE(down.good, 32) << down.failed << ", where 22 were good";
}

TEST(CharacterAbility, GetsUpFromFrontAndBackOnSlopesOfTenAndSeventeenDegrees) {
  for (const char* side : {"front", "back"}) {
    Tally up;
    for (const char* slope : {"+10", "-10", "+17", "-17"}) {
      const Tally one = Try("rise", 60, slope + std::string(" degrees, ") + side);
      up.good += one.good;
      up.count += one.count;
      up.failed += one.failed;
      up.figures.insert(up.figures.end(), one.figures.begin(), one.figures.end());
    }
    ASSERT_EQ(up.count, 24);
    EXPECT_GE(up.good, 22) << side << up.failed;
    EXPECT_LE(up.median(), side[0] == 'f' ? 2 : 3) << side;
  }
}

TEST(CharacterAbility, SwimsAtEachDriveWithTheHeadAboveTheWater) {
  std::map<std::string, Tally> of;
  for (int start = 7001; start <= 7030; ++start) {
    const GaitTrial trial =
        FindAbility("swim")->run({"substeps = 4", "density = 0.92"}, CharacterGains{}, start);
    Tally& tally = of[trial.group];
    ++tally.count;
    tally.good += trial.good ? 1 : 0;
    if (!trial.good) tally.failed += " " + std::to_string(start);
    tally.figures.push_back(trial.figure);
  }
  double slower = 0;
  for (const char* group : {"drive 0.3", "drive 0.6", "drive 1.0"}) {
    Tally& swims = of[group];
    ASSERT_EQ(swims.count, 6);
    EXPECT_EQ(swims.good, 6) << group << swims.failed;
    EXPECT_GT(swims.median(), slower + 0.05) << group << ", m/s";
    slower = swims.median();
  }
  EXPECT_EQ(of["drive -1.0"].good, 6) << of["drive -1.0"].failed;
  EXPECT_EQ(of["drive 0.0"].good, 6) << of["drive 0.0"].failed;
}

TEST(CharacterAbility, TreadsWaterWithTheHeadUpAndComesUpFromAnyAngle) {
  for (const char* ability : {"float", "plunge"}) {
    Tally up;
    for (int start = 7001; start <= 7020; ++start) {
      const GaitTrial trial =
          FindAbility(ability)->run({"substeps = 4", "density = 0.92"}, CharacterGains{}, start);
      up.good += trial.good ? 1 : 0;
      if (!trial.good) up.failed += " " + std::to_string(start);
    }
    EXPECT_GE(up.good, 19) << ability << up.failed;
  }
}

TEST(CharacterAbility, ClimbsOutOfWaterOverALedge) {
  Tally climbs;
  const GaitSetup setup{"substeps = 4", "density = 0.92\ngrip = true"};
  for (int start = 6001; start <= 6025; ++start) {
    const GaitTrial trial = FindAbility("climb")->run(setup, CharacterGains{}, start);
    ++climbs.count;
    climbs.good += trial.good ? 1 : 0;
    if (!trial.good) climbs.failed += " " + std::to_string(start);
  }
  ASSERT_EQ(climbs.count, 25);
  EXPECT_GE(climbs.good, 20) << climbs.failed;
}

TEST(CharacterAbility, GetsUpAfterItWentLimpByItsPlayerACommandOrAnImpact) {
  const Tally up = TryFrom(7001, "limp", 7032);
  ASSERT_EQ(up.count, 32);
  EXPECT_GE(up.good, 30) << up.failed;
}

TEST(CharacterAbility, ABarrierReplaysStairsAndTheWayUpFromTheGroundBitForBit) {
  const std::string stairs =
      "[[part]]\nname = \"ground\"\nfriction = 0.9\nchain = [[-50, 0], [1, 0], [1.01, 0.15], "
      "[1.45, 0.15], [1.46, 0.3], [60, 0.3]]\n";
  const Scene scenes[] = {
      CharacterScene("position = [0, 0]\n", "[[0, {drive = 0.4}]]", stairs),
      CharacterScene("position = [0, 0.2]\nangle = -1.5\n"),
  };
  for (const Scene& scene : scenes) {
    for (const int at : {40, 75, 110}) {
      ScriptedWorld run(scene);
      run.StepTo(at);
      const WorldSnapshot snapshot = run.world.Barrier();
      std::vector<std::uint64_t> first;
      for (int tick = 0; tick < 90; ++tick) {
        run.Step();
        first.push_back(run.world.Hash());
      }
      ASSERT_TRUE(run.world.Restore(snapshot).ok());
      for (int tick = 0; tick < 90; ++tick) {
        run.Step();
        ASSERT_EQ(run.world.Hash(), first[static_cast<std::size_t>(tick)]) << at << " + " << tick;
      }
    }
  }
}

}  // namespace character_ability_test
}  // namespace seam
