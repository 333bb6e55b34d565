/// The error of the measure itself: in every scene, a session in mode oracle over a perfect network
/// equals the oracle exactly.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"

namespace seam {
namespace oracle_row_test {

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

/// Error of the server's view, RMS over points of bodies, m.
double ServerIsOff(const std::string& scene, double duration_s) {
  ClusterConfig config;
  config.scene = scene;
  config.mode = "central";
  config.impair = "delay=40ms";
  config.duration_s = duration_s;
  const Recording recording = RunCluster(config);
  const Measures m = Measure(recording, ComputeOracle(recording, WithBarriers(recording.room)));
  EXPECT_GT(m.compared, 0) << scene;
  return m.error_server_m.value_or(1e9);
}

/// In mode central nobody else moves anything: only a late input can make the server wrong, and
/// clients run ahead of it, so that none is. A crawler that slept until its player drove it slept
/// on, and crates that became one body did so two at a time. A view is of before the edits that are
/// ordered for its tick, an oracle's pose of after them: that is the millimetre.
TEST(OracleRow, TheServerOfModeCentralEqualsTheOracleIfNoInputIsLate) {
  EXPECT_LT(ServerIsOff("playground", 7), 0.001) << "a crawler is driven that slept";
  EXPECT_LT(ServerIsOff("freight", 10.5), 0.001) << "sixty crates become one body and sixty again";
  EXPECT_EQ(ServerIsOff("heap", 4), 0);
}

}  // namespace oracle_row_test
}  // namespace seam
