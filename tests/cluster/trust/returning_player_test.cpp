/// Honest players whose line is cut, or whose process stands still, for less than their lease.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "client/embed/cluster.h"
#include "server/trust/trust_ladder.h"
#include "tests/lab/attack/attack.h"
#include "tests/support/gas_room.h"
#include "tests/support/soak.h"
#include "tests/support/soak/fault_plan.h"
#include "tests/support/soak/fault_runner.h"

namespace seam {
namespace returning_player_test {

constexpr double kFromS = 4;

struct Outcome {
  int step = 0;    ///< highest TrustStep of any player
  int before = 0;  ///< mechanisms that the player held when its line was cut
  int after = 0;   ///< and 8 s after it was mended
};

/// Plays with a fault of the second player's client.
Outcome Play(const std::string& scene, const Fault& fault, std::int64_t seed) {
  FaultPlan plan;
  plan.config.scene = scene;
  if (scene == "gas") plan.config.scene_text = GasRoomText(60);
  plan.config.impair = "4g";
  plan.config.seed = seed;
  plan.config.drive = Drive::kBot;
  plan.config.keep = false;
  plan.config.trust = TrustMode::kAct;
  plan.config.duration_s = fault.to_s + 8;
  plan.faults = {fault};
  FaultRunner faults(plan);
  Cluster cluster(faults.Config());
  Outcome outcome;
  std::int64_t looked = -1;
  cluster.each_instant = [&] {
    faults.Act(cluster);
    const Server& server = cluster.server();
    if (!server.started() || server.tick() == looked) return;
    looked = server.tick();
    for (std::size_t player = 0; player < cluster.scene().players.size(); ++player) {
      const TrustStep step = server.ladder().step(static_cast<int>(player));
      outcome.step = std::max(outcome.step, static_cast<int>(step));
    }
    const AuthorityTable& table = server.replica().authority();
    int held = 0;
    for (int m = 0; m < table.count(); ++m) held += table.at(m).authority == 2 ? 1 : 0;
    (static_cast<double>(looked) < 60 * kFromS ? outcome.before : outcome.after) = held;
  };
  cluster.Run();
  return outcome;
}

TEST(ReturningPlayer, IsNotDistrustedAndHoldsItsBodiesAgain) {
  for (const int seed : SoakSeeds(2, 1)) {
    for (const char* scene : {"crossing", "wall", "gas"}) {
      for (const auto& [kind, for_s] :
           {std::pair(FaultKind::kCut, 2.0), std::pair(FaultKind::kCut, 2.7),
            std::pair(FaultKind::kPause, 2.0)}) {
        const Outcome seen = Play(scene, Fault{kind, 1, kFromS, kFromS + for_s, 0}, seed);
        std::printf("%s, %s for %.1f s, seed %d: step %d, held %d, then %d\n", scene,
                    ToString(kind), for_s, seed, seen.step, seen.before, seen.after);
        EXPECT_LE(seen.step, static_cast<int>(TrustStep::kWatched));
        EXPECT_GT(seen.before, 0);
        // Discs of a gas belong to nobody: whoever has them keeps them.
        if (scene != std::string("gas")) {
          EXPECT_EQ(seen.after, seen.before);
        }
      }
    }
  }
}

TEST(ReturningPlayer, IsExcusedAFewTimesHoweverOftenSomebodyIsSilent) {
  TrustLadder ladder(2, 60);
  int excused_s = 0;
  for (std::int64_t tick = 0; tick < 120 * 60; tick += 60) excused_s += ladder.Excuse(0, tick);
  EXPECT_EQ(excused_s, 2 * 6) << "three at once, and one in each half minute";
  EXPECT_TRUE(ladder.Excuse(1, 0)) << "each player has its own";
}

/// Eight ships in empty space, each with an engine.
std::string EightShips() {
  std::string text = "gravity = [0, 0]\n";
  for (int i = 0; i < 8; ++i) {
    const std::string name = "p" + std::to_string(i);
    text += "[[player]]\nname = \"" + name + "\"\nvehicle = \"ship-" + name + "\"\n";
    text += "script = [[0, {drive = 1}], [4, {drive = -1}], [12, {drive = 1}]]\n";
    text += "[[part]]\nname = \"ship-" + name + "\"\nbox = [2, 1]\nowner = \"" + name + "\"\n";
    text += "position = [0, " + std::to_string(20 * i) + "]\n";
    text += "[[thrust]]\nname = \"engine-" + name + "\"\npart = \"ship-" + name + "\"\n";
    text += "force = [10, 0]\nplayer = \"" + name + "\"\naxis = \"drive\"\n";
  }
  return text;
}

/// In a room of eight the lines of six are cut for a moment, one after the other.
TEST(ReturningPlayer, ALiarAmongThemIsFound) {
  for (const char* attack : {"none", "fly"}) {
    ClusterConfig config;
    config.scene = "ships";
    config.scene_text = EightShips();
    config.impair = "demo";
    config.keep = false;
    config.trust = TrustMode::kAct;
    config.duration_s = 26;
    std::vector<Fault> faults;
    for (int i = 0; i < 48; ++i) {
      const double from_s = 2 + 0.5 * i;
      faults.push_back({FaultKind::kCut, 2 + i % 6, from_s, from_s + 0.4, 0});
    }
    const AttackOutcome outcome = RunAttack(config, attack, faults);
    SCOPED_TRACE(attack);
    if (std::string(attack) == "none") {
      EXPECT_LE(outcome.step, static_cast<int>(TrustStep::kWatched));
    } else {
      EXPECT_GT(outcome.lies, 10);
      EXPECT_GE(outcome.step, static_cast<int>(TrustStep::kServerHolds));
    }
  }
}

}  // namespace returning_player_test
}  // namespace seam
