/// Honest players whose line is cut, or whose process stands still, for less than their lease.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "client/embed/cluster.h"
#include "server/sessions/account_book.h"
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
  for (const int seed : SoakSeeds(1, 1)) {
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

TEST(ReturningPlayer, IsExcusedAFewTimesHoweverOftenItIsSilent) {
  ClientAccount account;
  int excused = 0;
  for (std::int64_t now_us = 0; now_us < 120'000'000; now_us += 300'000) {
    const std::int64_t before_us = account.returned_us;
    account.NoteReturn(now_us);
    excused += account.returned_us != before_us ? 1 : 0;
  }
  EXPECT_EQ(excused, 6) << "three at once, and one in each half minute";
}

}  // namespace returning_player_test
}  // namespace seam
