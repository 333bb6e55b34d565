/// A client that lies wins nothing; an honest one is not doubted. docs/trust.md has the figures of
/// more networks and seeds (seam-lab attack).

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "server/trust/trust_ladder.h"
#include "tests/lab/attack/attack.h"
#include "tests/lab/attack/cheat.h"
#include "tests/support/soak.h"

namespace seam {
namespace lab_attack_test {

ClusterConfig Room(const std::string& impair, std::int64_t seed) {
  std::ifstream file("tests/lab/attack/trust.toml");
  ClusterConfig config;
  config.scene = "trust";
  config.scene_text.assign(std::istreambuf_iterator<char>(file), {});
  config.impair = impair;
  config.seed = seed;
  config.duration_s = 16;
  return config;
}

double ActedAfterS(const AttackOutcome& outcome) {
  if (outcome.acted_tick < 0) return 1e9;
  return static_cast<double>(outcome.acted_tick - outcome.first_tick) / 60;
}

TEST(Attack, AGrossLiarLosesItsBodiesWithinFiveSeconds) {
  for (const char* attack : {"x1.2", "x1.5", "ram", "vel10", "fly", "lift", "freeze", "tear"}) {
    for (const char* impair : {"perfect", "4g"}) {
      for (int seed = 1; seed <= Soak(1); ++seed) {
        SCOPED_TRACE(std::string(attack) + " over " + impair);
        const AttackOutcome outcome = RunAttack(Room(impair, seed), attack);
        EXPECT_GT(outcome.lies, 10);
        EXPECT_LT(ActedAfterS(outcome), 5);
        EXPECT_EQ(outcome.won, 0);
        EXPECT_EQ(outcome.others_step, 0) << "bob is honest";
      }
    }
  }
}

TEST(Attack, ATeleportWinsNoCoin) {
  for (const char* attack : {"silence", "firstword"}) {
    for (const char* impair : {"perfect", "demo", "terrible"}) {
      for (int seed = 1; seed <= Soak(1); ++seed) {
        SCOPED_TRACE(std::string(attack) + " over " + impair);
        const AttackOutcome outcome = RunAttack(Room(impair, seed), attack);
        EXPECT_GT(outcome.lies, 10);
        EXPECT_EQ(outcome.won, 0);
        EXPECT_GE(outcome.step, static_cast<int>(TrustStep::kServerHolds));
      }
    }
  }
}

TEST(Attack, ASlightlyFasterCarIsFoundWithinHalfAMinute) {
  for (int seed = 1; seed <= Soak(1); ++seed) {
    ClusterConfig config = Room("demo", seed);
    config.duration_s = 33;
    config.drive = Drive::kBot;
    const AttackOutcome outcome = RunAttack(config, "x1.05");
    EXPECT_LT(ActedAfterS(outcome), 30);
  }
}

TEST(Attack, GlueWithoutALoadDoesNotBreak) {
  const AttackOutcome outcome = RunAttack(Room("demo", 1), "break");
  EXPECT_GT(outcome.lies, 5);
  EXPECT_EQ(outcome.broken, 0);
  EXPECT_GE(outcome.step, static_cast<int>(TrustStep::kServerHolds));
}

TEST(Attack, ALieAboutImpactsHurtsNobody) {
  const AttackOutcome outcome = RunAttack(Room("demo", 1), "impact");
  EXPECT_GT(outcome.lies, 10);
  EXPECT_EQ(outcome.hurt, 0);
}

TEST(Attack, AnHonestClientIsNotDoubted) {
  for (const char* impair : {"perfect", "demo", "4g", "3g", "terrible"}) {
    for (const Drive drive : {Drive::kScript, Drive::kBot}) {
      SCOPED_TRACE(impair);
      ClusterConfig config = Room(impair, 1);
      config.drive = drive;
      const AttackOutcome outcome = RunAttack(config, "none");
      EXPECT_LE(outcome.step, static_cast<int>(TrustStep::kWatched));
      EXPECT_LE(outcome.others_step, static_cast<int>(TrustStep::kWatched));
    }
  }
}

}  // namespace lab_attack_test
}  // namespace seam
