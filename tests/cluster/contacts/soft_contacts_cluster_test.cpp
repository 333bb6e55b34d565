/// Soft contacts at all peers: a session over a perfect network equals the oracle, to the last bit.

#include <gtest/gtest.h>

#include <string>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace soft_contacts_cluster_test {

Measures SoftSession(const std::string& name, const std::string& mode, const std::string& impair) {
  const Scene scene = LoadSceneWith("scenes/" + name + ".toml", {"solver.contacts=\"soft\""});
  EXPECT_EQ(scene.solver.contacts, ContactSolving::kSoft);
  ClusterConfig config;
  config.scene = name + ".toml";
  config.scene_text = scene.text;
  config.mode = mode;
  config.impair = impair;
  config.duration_s = 4;
  const Recording recording = RunCluster(config);
  return Measure(recording, ComputeOracle(recording));
}

TEST(SoftContactsCluster, ASessionOverAPerfectNetworkEqualsTheOracle) {
  for (const char* scene : {"stack", "crossing", "seesaw", "wall"}) {
    const Measures m = SoftSession(scene, "oracle", "perfect");
    EXPECT_GT(m.compared, 0) << scene;
    EXPECT_EQ(m.error_max_m, 0) << scene;
    EXPECT_EQ(m.error_rms_rad, 0) << scene;
  }
}

TEST(SoftContactsCluster, AHandedOverPileStaysNearTheOracle) {
  const Measures m = SoftSession("stack", "buffer", "4g");
  EXPECT_GT(m.compared, 0);
  EXPECT_LT(m.error_max_m, 0.25);
}

}  // namespace soft_contacts_cluster_test
}  // namespace seam
