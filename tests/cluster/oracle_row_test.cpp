/// The measure's own error: a session in mode oracle over a perfect network is the oracle, exactly,
/// in every scene.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "common/measure/measure.h"
#include "tests/lab/cluster.h"

namespace seam {
namespace {

/// Scenes of more parts are played by a few, and not to their end.
constexpr std::size_t kPartsOfSmall = 500;

std::vector<std::string> Scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("scenes")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(OracleRow, IsExactlyZeroInEveryScene) {
  const std::vector<std::string> scenes = Scenes();
  EXPECT_GE(scenes.size(), 15u);
  for (const std::string& scene : scenes) {
    ClusterConfig config;
    config.scene = scene;
    config.mode = "oracle";
    config.impair = "perfect";
    if (LoadScene("scenes/" + scene + ".toml").parts.size() > kPartsOfSmall) {
      config.players = 4;  // each of them simulates all of it
      config.duration_s = 4;
    }
    const Recording recording = RunCluster(config);
    const Oracle oracle = ComputeOracle(recording);
    const Measures m = Measure(recording, oracle);
    EXPECT_GT(m.compared, 0) << scene;
    EXPECT_EQ(m.error_max_m, 0) << scene;
    EXPECT_EQ(m.error_rms_rad, 0) << scene;
    EXPECT_EQ(m.lost.value_or(0), 0) << scene;
    EXPECT_EQ(m.topology_lag_s.value_or(0), 0) << scene;
    EXPECT_EQ(recording.edits.size(), oracle.edits.size()) << scene;
  }
}

}  // namespace
}  // namespace seam
