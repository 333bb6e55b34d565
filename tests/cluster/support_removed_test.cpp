/// A script removes things under and above sleepers: they fall in every peer's world and view.

#include <gtest/gtest.h>

#include <string>

#include "client/embed/cluster.h"

namespace seam {
namespace support_removed_test {

/// A crate on a shelf in bob's half, and one that hangs in ann's.
const char* const kHanging = R"(
duration = 12
[[player]]
name = "ann"
region = [[-200, -50], [-0.01, 100]]
[[player]]
name = "bob"
region = [[0, -50], [200, 100]]
[[part]]
name = "ground"
chain = [[-90, 0], [90, 0]]
[[part]]
name = "shelf"
box = [4, 0.4]
position = [5, 3]
anchored = true
[[part]]
name = "lies"
box = [1, 1]
position = [5, 3.715]
[[part]]
name = "post"
box = [0.4, 0.4]
position = [-5, 6]
anchored = true
[[part]]
name = "hangs"
box = [1, 1]
position = [-5, 3]
[[joint]]
name = "rope"
kind = "distance"
a = "post"
b = "hangs"
[[script]]
name = "s"
code = '''
function on_tick(t)
  if world.tick() == 300 then
    world.remove_part("shelf")
    world.remove_joint("rope")
  end
end
'''
)";

void ExpectBothFall(const std::string& mode, const std::string& impair, std::int64_t seed) {
  SCOPED_TRACE(mode + " " + impair + ", seed " + std::to_string(seed));
  ClusterConfig config;
  config.scene = "hanging";
  config.scene_text = kHanging;
  config.mode = mode;
  config.impair = impair;
  config.seed = seed;
  Cluster cluster(config);
  cluster.RunToTick(290);
  const World& world = cluster.server().replica().world();
  for (int body = 0; body < 2; ++body) ASSERT_FALSE(world.awake(body));
  cluster.Run();
  for (const auto& [peer, views] : cluster.recording().views) {
    const View& last = views.rbegin()->second;
    ASSERT_EQ(last.id.size(), 2u);
    for (const float y : last.y) EXPECT_NEAR(y, 0.515, 0.03) << "peer " << peer;
  }
}

TEST(SupportRemoved, SleepersFallInEveryPeersView) {
  ExpectBothFall("oracle", "perfect", 1);
  ExpectBothFall("central", "4g", 1);
  ExpectBothFall("strict", "4g", 1);
  for (const char* impair : {"perfect", "4g", "delay=200ms"}) {
    for (const std::int64_t seed : {1, 2}) ExpectBothFall("buffer", impair, seed);
  }
}

}  // namespace support_removed_test
}  // namespace seam
