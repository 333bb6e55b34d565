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

class Agreement : public ::testing::TestWithParam<const char*> {};

TEST_P(Agreement, NoPairOfPeersDiffersForTwoSecondsAfterInputsAreKnown) {
  std::ifstream file(std::string("tests/lab/agreement/") + GetParam() + ".toml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  for (const char* impair : {"delay=100ms", "delay=200ms", "4g", "terrible"}) {
    for (int seed = 1; seed <= Soak(4); ++seed) {
      ClusterConfig config;
      config.scene = GetParam();
      config.scene_text = text;
      config.impair = impair;
      config.seed = seed;
      config.drive = Drive::kBot;
      config.keep = false;
      Cluster cluster(config);
      AgreementWatch watch(cluster);
      cluster.each_instant = [&watch] { watch.Look(); };
      cluster.Run();
      EXPECT_GT(watch.compared(), 1000) << impair << " seed " << seed;
      EXPECT_LE(watch.longest_s(), kDiffersMost)
          << impair << " seed " << seed << ": " << watch.body();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, ::testing::Values("wheels", "plank", "chain"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace agreement_soak_test
}  // namespace seam
