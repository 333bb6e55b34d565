/// Peers that know all inputs agree: meshing wheels, three owners on one body, a chain between
/// cars, driven by bots over slow paths.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/lab/agreement/agreement.h"
#include "tests/support/soak.h"

namespace seam {
namespace agreement_soak_test {

/// Longest time in which two peers differ that know all inputs, s.
constexpr double kDiffersMost = 2;

ClusterConfig Driven(const std::string& scene, const std::string& impair, int seed) {
  std::ifstream file("tests/lab/agreement/" + scene + ".toml");
  ClusterConfig config;
  config.scene = scene;
  config.scene_text = std::string(std::istreambuf_iterator<char>(file), {});
  config.impair = impair;
  config.seed = seed;
  config.drive = Drive::kBot;
  config.keep = false;
  return config;
}

void ExpectAgreement(const AgreementWatch& watch, std::int64_t compared) {
  EXPECT_GT(watch.compared(), compared);
  EXPECT_LE(watch.longest_s(), kDiffersMost) << watch.body();
}

class AgreementCluster : public ::testing::TestWithParam<const char*> {};

TEST_P(AgreementCluster, NoPairOfPeersDiffersForTwoSecondsAfterInputsAreKnown) {
  for (const char* impair : {"delay=100ms", "delay=200ms", "4g", "terrible"}) {
    for (const int seed : SoakSeeds(1, 4)) {
      SCOPED_TRACE(std::string(impair) + " seed " + std::to_string(seed));
      Cluster cluster(Driven(GetParam(), impair, seed));
      AgreementWatch watch(cluster);
      cluster.each_instant = [&watch] { watch.Look(); };
      cluster.Run();
      ExpectAgreement(watch, 1000);
    }
  }
}

/// One in six sessions of `chain`, and one in thirty of the others, takes longer (48 each): what it
/// missed is still told while both drive on.
TEST_P(AgreementCluster, APeerThatWasAwayMostlyAgreesAgainWithinTwoSeconds) {
  int sessions = 0, longer = 0;
  for (const double away_s : {1.0, 3.5}) {
    for (const int seed : SoakSeeds(1, 4)) {
      SCOPED_TRACE(std::to_string(away_s) + " s away, seed " + std::to_string(seed));
      Cluster cluster(Driven(GetParam(), "delay=100ms", seed));
      AgreementWatch watch(cluster);
      cluster.each_instant = [&watch] { watch.Look(); };
      const int hz = cluster.scene().solver.tick_hz;
      cluster.RunToTick(3 * hz);
      cluster.Kill(0);
      cluster.RunToTick(3 * hz + static_cast<std::int64_t>(away_s * hz));
      cluster.Revive(0);
      cluster.Run();
      EXPECT_GT(watch.compared(), 500);  // nothing is compared meanwhile
      EXPECT_LE(watch.longest_s(), 2 * kDiffersMost) << watch.body();
      sessions += 1;
      longer += watch.longest_s() > kDiffersMost ? 1 : 0;
    }
  }
  EXPECT_LE(longer, sessions / 4);
}

TEST(ScriptedAgreement, PeersAgreeAboutWhatAScriptJoins) {
  for (const char* impair : {"delay=100ms", "delay=300ms", "4g"}) {
    for (const int seed : SoakSeeds(1, 6)) {
      SCOPED_TRACE(std::string(impair) + " seed " + std::to_string(seed));
      Cluster cluster(Driven("tow", impair, seed));
      AgreementWatch watch(cluster);
      cluster.each_instant = [&watch] { watch.Look(); };
      cluster.Run();
      ExpectAgreement(watch, 1000);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, AgreementCluster, ::testing::Values("wheels", "plank", "chain"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace agreement_soak_test
}  // namespace seam
