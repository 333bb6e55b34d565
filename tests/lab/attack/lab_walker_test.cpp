/// Characters, of which the told states lack the step: a liar is found, and no honest player. In
/// docs/trust.md: more scenes, networks and seeds.

#include <gtest/gtest.h>

#include "server/trust/trust_ladder.h"
#include "tests/lab/attack/attack.h"
#include "tests/lab/attack/honest.h"
#include "tests/support/soak.h"

namespace seam {
namespace lab_walker_test {

/// Two that walk; a coin is 72 m from the first one.
const char* const kWalk = R"(
[solver]
substeps = 4
[[player]]
name = "ann"
vehicle = "ann-body.torso"
region = [[-1000, -1000], [-0.001, 1000]]
script = [[0, {}], [0.5, {drive = 0.6}], [6, {drive = -0.6}], [10, {drive = 0.8}]]
[[player]]
name = "bob"
vehicle = "bob-body.torso"
region = [[0, -1000], [1000, 1000]]
script = [[0, {}], [1, {drive = -0.5}], [8, {drive = 0.5}]]
[[part]]
name = "ground"
chain = [[-300, 60], [-300, 0], [600, 0], [600, 60]]
friction = 0.8
[[character]]
name = "ann-body"
player = "ann"
position = [-12, 0]
[[character]]
name = "bob-body"
player = "bob"
position = [12, 0]
facing = "left"
[[trigger]]
name = "coin"
kind = "pickup"
position = [60, 1]
box = [3, 4]
score = 100
)";

ClusterConfig Walk(const std::string& impair, std::int64_t seed) {
  ClusterConfig config;
  config.scene = "walk";
  config.scene_text = kWalk;
  config.impair = impair;
  config.seed = seed;
  config.duration_s = 12;
  config.keep = false;
  return config;
}

TEST(Walker, ALiarIsFoundWithoutACopyWithinFiveSeconds) {
  for (const char* attack : {"x1.2", "x1.5", "freeze", "gain5"}) {
    for (const char* impair : {"demo", "4g"}) {
      for (const int seed : SoakSeeds(1, 1)) {
        SCOPED_TRACE(std::string(attack) + " over " + impair);
        const AttackOutcome outcome = RunAttack(Walk(impair, seed), attack);
        EXPECT_GT(outcome.lies, 10);
        EXPECT_LT(ActedAfterS(outcome), 5);
        EXPECT_EQ(outcome.won, 0);
        EXPECT_LE(outcome.others_step, static_cast<int>(TrustStep::kNoted)) << "bob is honest";
      }
    }
  }
}

TEST(Walker, AnHonestOneIsNotDoubted) {
  for (const char* scene : {"walk", "obstacle", "playground"}) {
    for (const char* impair : {"demo", "3g", "terrible"}) {
      for (const Drive drive : {Drive::kScript, Drive::kBot}) {
        SCOPED_TRACE(std::string(scene) + " over " + impair);
        ClusterConfig config = Walk(impair, 1);
        config.scene = scene;
        if (config.scene != "walk") config.scene_text.clear();
        config.drive = drive;
        const HonestOutcome outcome = RunHonest(config, false);
        EXPECT_GT(outcome.audited, 20);
        EXPECT_LE(outcome.step, static_cast<int>(TrustStep::kNoted)) << outcome.score;
      }
    }
  }
}

/// Three crates between them: bots that jump over these fall, and get up.
const char* const kCrates = R"(
[[part]]
name = "crate"
box = [0.6, 0.4]
position = [-5, 0.25]
repeat = {count = 3, step = [3, 0]}
)";

/// A walker gains centimetres in a second by it, and less than a blow of a crate gives: what hides
/// in the chance of single gains adds up.
TEST(Walker, ALittleTooFastIsFoundWithoutACopyWithinHalfAMinute) {
  for (const char* attack : {"x1.05", "x1.2"}) {
    for (const int seed : SoakSeeds(2, 2)) {
      SCOPED_TRACE(std::string(attack) + ", seed " + std::to_string(seed));
      ClusterConfig config = Walk("demo", seed);
      config.scene_text += std::string(attack) == "x1.2" ? kCrates : "";
      config.drive = Drive::kBot;
      config.duration_s = 33;
      const AttackOutcome outcome = RunAttack(config, attack);
      EXPECT_LT(ActedAfterS(outcome), 30);
      EXPECT_LE(outcome.others_step, static_cast<int>(TrustStep::kNoted)) << "bob is honest";
    }
  }
}

/// When one begins to get up is decided by less than the wire's rounding: the audit's world was
/// 0.4 s early, which came to 1.5 of a lie.
TEST(Walker, AnHonestOneThatFallsAndGetsUpIsNotDoubted) {
  for (const char* impair : {"demo", "terrible"}) {
    for (const int seed : SoakSeeds(1, 1)) {
      SCOPED_TRACE(impair);
      ClusterConfig config = Walk(impair, seed);
      config.scene_text += kCrates;
      config.drive = Drive::kBot;
      config.duration_s = 20;
      const HonestOutcome outcome = RunHonest(config, false);
      EXPECT_GT(outcome.audited, 20);
      EXPECT_EQ(outcome.step, 0) << outcome.score;
      EXPECT_LT(outcome.audit, 1) << "of a lie";
    }
  }
}

}  // namespace lab_walker_test
}  // namespace seam
