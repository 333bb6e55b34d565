/// A belt that a player starts wakes what sleeps on it, whatever the mode.

#include <gtest/gtest.h>

#include "client/embed/cluster.h"

namespace seam {
namespace woken_by_belt_test {

constexpr char kBelt[] = R"(
duration = 15
[[player]]
name = "ann"
script = [[5.0, {drive = 0.3}], [7.0, {}]]
region = [[-200, -50], [-0.01, 100]]
[[player]]
name = "bob"
region = [[0, -50], [200, 100]]
[[part]]
name = "belt"
box = [14, 0.6]
position = [5, 0.3]
anchored = true
conveyor = {player = "ann", speed = 2}
[[part]]
name = "box"
box = [1, 1]
position = [3, 1.12]
)";

TEST(WokenByBelt, InEveryModeAndReconciler) {
  for (const auto& [mode, reconcile] :
       {std::pair("oracle", ""), std::pair("buffer", "rollback"), std::pair("buffer", "fade"),
        std::pair("buffer", "retrospect"), std::pair("strict", ""), std::pair("touch", "")}) {
    ClusterConfig config;
    config.scene_text = kBelt;
    config.mode = mode;
    if (*reconcile != '\0') config.reconcile = reconcile;
    config.impair = "perfect";
    config.drive = Drive::kScript;
    config.keep = false;
    Cluster cluster(config);
    const World& world = cluster.server().replica().world();
    cluster.RunToTick(290);
    EXPECT_FALSE(world.awake(0)) << mode << " " << reconcile;
    cluster.RunToTick(480);
    EXPECT_NEAR(world.Read(0).position.x(), 4.2f, 0.1f) << mode << " " << reconcile;
  }
}

}  // namespace woken_by_belt_test
}  // namespace seam
