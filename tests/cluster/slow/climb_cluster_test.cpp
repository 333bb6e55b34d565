/// A character climbs out of the water; each grip is an edit ordered by the server. Other peers see
/// it come out as without a network.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>

#include "client/embed/cluster.h"
#include "common/scene/character.h"

namespace seam {
namespace climb_cluster_test {

constexpr float kWall = 4;  // m, where the pool ends

struct Start {
  double x, ledge, drive;
};

/// ann walks into a pool and goes on, over the ledge at its other end; bob looks on.
std::string Pool(const Start& start) {
  return fmt::format(
      R"(duration = 26
buffer = 14
[solver]
substeps = 4
[[player]]
name = "ann"
vehicle = "hero.torso"
region = [[-1000, -1000], [29.999, 1000]]
script = [[0, {{}}], [0.5, {{drive = {2}}}]]
[[player]]
name = "bob"
region = [[30, -1000], [1000, 1000]]
[[part]]
name = "ground"
chain = [[-60, {1}], [0, {1}], [0.02, -2.6], [{3}, -2.6], [{3}.02, {1}], [60, {1}]]
friction = 0.9
[[water]]
name = "pool"
box = [{3}, 2.6]
position = [{4}, -1.3]
[[character]]
name = "hero"
player = "ann"
position = [{0}, {1}]
grip = true
)",
      start.x, start.ledge, start.drive, kWall, kWall / 2);
}

/// s at which this view first has the character out, above the ledge and behind its edge; -1:
/// never.
double OutAt(const std::map<std::int64_t, View>& views, PartId torso, const Start& start) {
  for (const auto& [tick, view] : views) {
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      if (view.id[i] != torso || view.x[i] < kWall + 0.2f) continue;
      if (view.y[i] > static_cast<float>(start.ledge) + 0.6f) return static_cast<double>(tick) / 60;
    }
  }
  return -1;
}

TEST(ClimbCluster, EveryPeerShowsTheClimbOutOfTheWater) {
  for (const Start& start : {Start{-1.5, 0.3, 0.8}, Start{-2.2, 0.4, 1}, Start{-3.1, 0.45, 0.7}}) {
    ClusterConfig config;
    config.scene_text = Pool(start);
    config.impair = "4g";
    Cluster cluster(config);
    cluster.Run();
    const Scene& scene = cluster.server().replica().world().scene();
    const PartId torso = scene.characters[0].parts[kTorso];
    const Recording& recording = cluster.recording();
    for (const auto& [peer, views] : recording.views) {
      const double out = OutAt(views, torso, start);
      std::printf("[          ] ledge %.2f m, drive %.1f: out at %.1f s as peer %d sees it\n",
                  start.ledge, start.drive, out, peer);
      EXPECT_GT(out, 4) << "ledge " << start.ledge << ", drive " << start.drive << ", peer "
                        << peer;
    }
  }
}

}  // namespace climb_cluster_test
}  // namespace seam
