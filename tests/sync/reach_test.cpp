/// Which ticks are input-complete: how far may the effect of unknown inputs reach?

#include "common/sync/reach/reach.h"

#include <gtest/gtest.h>

#include "tests/support/scripted_world.h"

namespace seam {
namespace reach_test {

/// ann's and bob's boxes `gap` m apart, and a crate far from both; this is ann's peer.
class Lot {
 public:
  explicit Lot(float gap, int own_player = 0, int ticks = 60)
      : lot(ParseScene("[[player]]\nname = \"ann\"\nvehicle = \"hers\"\n"
                       "[[player]]\nname = \"bob\"\nvehicle = \"his\"\n"
                       "[[part]]\nname = \"ground\"\nchain = [[-900, 0], [900, 0]]\n"
                       "[[part]]\nname = \"hers\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
                       "[[part]]\nname = \"his\"\nbox = [1, 1]\nposition = [" +
                           std::to_string(1 + gap) +
                           ", 0.5]\n"
                           "[[part]]\nname = \"crate\"\nbox = [1, 1]\nposition = [-800, 0.5]\n",
                       "lot.toml")),
        bodies(lot.world),
        roles(config, 1, own_player, lot.world, bodies) {
    for (int t = 0; t < ticks; ++t) lot.Step();
    for (int m = 0; m < roles.table().count(); ++m) {  // it follows everything
      AuthorityRecord record;
      record.secondaries.Add(1);
      roles.table().Set(m, record);
    }
    drivers.Look();
  }

  /// The newest tick of which inputs of the player are known is that many ticks ago.
  void Heard(int player, std::int64_t ago, const Input& input = {64, 0, 0}) {
    inputs[static_cast<std::size_t>(player)].Note(lot.world.tick() - ago, input);
  }
  /// Age of a part's newest input-complete tick, in ticks.
  std::int64_t Missing(const std::string& part) {
    reach.Look();
    return lot.world.tick() - reach.CompleteTick(lot.world.mechanism(lot.Body(part)));
  }

  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  ScriptedWorld lot;
  BodyTable bodies;
  Roles roles;
  std::vector<InputTrack> inputs = std::vector<InputTrack>(2);
  Drivers drivers{lot.world, roles};
  Reach reach{config, lot.world, roles, drivers, inputs};
};

TEST(Reach, TheOwnPlayerNeverLimits) {
  Lot near(0.1f);
  near.Heard(0, 20);
  near.Heard(1, 0);
  for (const char* part : {"hers", "his", "crate"}) EXPECT_EQ(near.Missing(part), 0) << part;
}

TEST(Reach, ANearPlayersInputsAreMissingAndADistantOnesAreNot) {
  Lot near(0.1f);
  near.Heard(1, 20);
  EXPECT_EQ(near.Missing("hers"), 20);
  EXPECT_EQ(near.Missing("his"), 20);
  EXPECT_EQ(near.Missing("crate"), 0) << "out of reach of both";
  Lot far(100);
  far.Heard(1, 20);
  EXPECT_EQ(far.Missing("hers"), 0);
  EXPECT_EQ(far.Missing("his"), 20) << "his own is moved by it wherever it is";
}

TEST(Reach, GrowsWithTheNumberOfMissingInputs) {
  Lot lot(3);  // both can accelerate: 10 m/s^2 t^2
  lot.Heard(1, 6);
  EXPECT_EQ(lot.Missing("hers"), 0);
  Lot later(3);
  later.Heard(1, 40);
  EXPECT_EQ(later.Missing("hers"), 40);
}

TEST(Reach, ACompleteTickStaysCompleteWhenAMissingPlayersBoxComesNear) {
  Lot lot(3);
  lot.Heard(1, 6);
  ASSERT_EQ(lot.Missing("hers"), 0);
  for (int t = 0; t < 34; ++t) lot.lot.Step();
  EXPECT_EQ(lot.Missing("hers"), 34) << "40 ticks are missing, and the first 6 did not matter";
  EXPECT_EQ(lot.Missing("his"), 40);
  lot.Heard(1, 2);
  EXPECT_EQ(lot.Missing("hers"), 0) << "two ticks do not take him there";
}

TEST(Reach, APlayerMissedAnewLimitsAsFarBackAsItIsMissing) {
  Lot lot(0.1f);
  lot.Heard(1, 0);
  for (int t = 0; t < 181; ++t) lot.lot.Step();
  ASSERT_EQ(lot.Missing("hers"), 0) << "he is absent";
  lot.lot.Step();
  lot.Heard(1, 20);
  EXPECT_EQ(lot.Missing("hers"), 20);
}

TEST(Reach, TheLeastHeardOfSeveralNearPlayersLimits) {
  Lot server(0.1f, -1);  // plays nobody
  server.Heard(0, 5);
  server.Heard(1, 12);
  EXPECT_EQ(server.Missing("hers"), 12);
  server.Heard(1, 0);
  EXPECT_EQ(server.Missing("hers"), 5);
}

TEST(Reach, NobodyWaitsForAPlayerNeverHeardOrSilentForThreeSeconds) {
  Lot never(0.1f);
  EXPECT_EQ(never.Missing("hers"), 0);
  Lot gone(0.1f);
  gone.Heard(1, 0);
  for (int t = 0; t < 180; ++t) gone.lot.Step();
  EXPECT_EQ(gone.Missing("hers"), 180) << "who drove on may brake";
  gone.lot.Step();
  EXPECT_EQ(gone.Missing("hers"), 0);
}

TEST(Reach, InTheFirstThreeQuartersOfASecondTheFirstInputIsInFlight) {
  Lot lot(0.1f, 0, 44);
  EXPECT_EQ(lot.Missing("hers"), 44) << "bob may have driven from the first tick on";
  EXPECT_EQ(lot.Missing("crate"), 0) << "out of reach of both";
  lot.Heard(1, 4);
  EXPECT_EQ(lot.Missing("hers"), 4);
  Lot later(0.1f, 0, 45);
  EXPECT_EQ(later.Missing("hers"), 0) << "who was not heard of by now is not there";
}

TEST(Reach, AnIdlePlayerIsWaitedForAtMostASecondAndAQuarter) {
  Lot idle(0.1f);
  idle.Heard(1, 0, Input{});
  for (int t = 0; t < 75; ++t) idle.lot.Step();
  EXPECT_EQ(idle.Missing("hers"), 75) << "in a quiet room inputs come once a second";
  idle.lot.Step();
  EXPECT_EQ(idle.Missing("hers"), 0);
}

TEST(Reach, InputsOfFutureTicksAreNotMissing) {
  Lot lot(0.1f);
  lot.Heard(1, -3);  // with an input delay they come before their tick
  EXPECT_EQ(lot.Missing("his"), 0);
}

TEST(Reach, ABodyOnABeltWaitsForThePlayerThatDrivesIt) {
  ScriptedWorld room(
      ParseScene("[[player]]\nname = \"ann\"\n[[player]]\nname = \"bob\"\n"
                 "[[part]]\nname = \"belt\"\nbox = [20, 0.5]\nposition = [0, 0]\nangle = "
                 "1.5707963\nanchored = true\n"
                 "conveyor = {player = \"bob\", speed = 2}\n"
                 "[[part]]\nname = \"ground\"\nchain = [[-900, -20], [900, -20]]\n"
                 "[[part]]\nname = \"on\"\nbox = [0.4, 0.4]\nposition = [0, 10.2]\n"
                 "[[part]]\nname = \"beside\"\nbox = [0.4, 0.4]\nposition = [9, -19.8]\n",
                 "belt.toml"));
  const SyncConfig config = MakeSyncConfig("buffer", "rollback");
  BodyTable bodies(room.world);
  Roles roles(config, 1, 0, room.world, bodies);
  Drivers drivers(room.world, roles);
  std::vector<InputTrack> inputs(2);
  Reach reach(config, room.world, roles, drivers, inputs);
  for (int t = 0; t < 60; ++t) room.Step();
  drivers.Look();
  inputs[1].Note(room.world.tick() - 20, {64, 0, 0});
  reach.Look();
  const auto complete = [&](const char* part) {
    return room.world.tick() - reach.CompleteTick(room.world.mechanism(room.Body(part)));
  };
  EXPECT_EQ(complete("on"), 20);
  EXPECT_EQ(complete("beside"), 0) << "nine metres from the upright belt";
}

}  // namespace reach_test
}  // namespace seam
