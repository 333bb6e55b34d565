/// A script removes things under and above sleepers: they fall in every peer's world and view.

#include <gtest/gtest.h>

#include <string>

#include "client/embed/cluster.h"

namespace seam {
namespace support_removed_test {

const std::string kRoom = R"(
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
)";

/// A crate on a shelf in bob's half, and one that hangs in ann's.
const std::string kHanging = kRoom + R"(
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

/// Two equal weights on a pulley, one in each half.
const std::string kPulley = kRoom + R"(
[[part]]
name = "left"
box = [1, 1]
position = [-5, 4]
[[part]]
name = "right"
box = [1, 1]
position = [5, 4]
[[joint]]
name = "pulley"
kind = "pulley"
a = "left"
b = "right"
ground_a = [-5, 9]
ground_b = [5, 9]
[[script]]
name = "s"
code = '''
function on_tick(t)
  if world.tick() == 300 then world.remove_joint("pulley") end
end
'''
)";

/// Ann's crate on the ground, bob's on it, and nobody's on top.
const std::string kTower = kRoom + R"(
[[part]]
name = "low"
box = [2, 1]
position = [0.5, 0.515]
owner = "ann"
[[part]]
name = "middle"
box = [1, 1]
position = [0.6, 1.54]
owner = "bob"
[[part]]
name = "top"
box = [1, 1]
position = [0.6, 2.56]
[[script]]
name = "s"
code = '''
function on_tick(t)
  if world.tick() == 300 then world.remove_part("low") end
end
'''
)";

/// The heights of two bodies at the end of a session.
struct Heights {
  double first = 0.515, second = 0.515;  // m
};

void ExpectFall(const std::string& scene, const Heights& heights, const std::string& mode,
                const std::string& impair, std::int64_t seed = 1) {
  SCOPED_TRACE(mode + " " + impair + ", seed " + std::to_string(seed));
  ClusterConfig config;
  config.scene = "hanging";
  config.scene_text = scene;
  config.mode = mode;
  config.impair = impair;
  config.seed = seed;
  Cluster cluster(config);
  cluster.RunToTick(290);
  const World& world = cluster.server().replica().world();
  for (int body = 0; body < world.body_count(); ++body) ASSERT_FALSE(world.awake(body));
  cluster.Run();
  for (const auto& [peer, views] : cluster.recording().views) {
    const View& last = views.rbegin()->second;
    ASSERT_EQ(last.id.size(), 2u);
    EXPECT_NEAR(last.y[0], heights.first, 0.03) << "peer " << peer;
    EXPECT_NEAR(last.y[1], heights.second, 0.03) << "peer " << peer;
  }
}

TEST(SupportRemoved, SleepersFallInEveryPeersView) {
  ExpectFall(kHanging, {}, "oracle", "perfect", 1);
  ExpectFall(kHanging, {}, "central", "4g", 1);
  ExpectFall(kHanging, {}, "strict", "4g", 1);
  for (const char* impair : {"perfect", "4g", "delay=200ms"}) {
    for (const std::int64_t seed : {1, 2}) ExpectFall(kHanging, {}, "buffer", impair, seed);
  }
}

TEST(SupportRemoved, BothHalvesOfAPulleyFall) {
  for (const char* mode : {"strict", "touch", "buffer", "central"}) {
    for (const char* impair : {"perfect", "demo", "4g"}) ExpectFall(kPulley, {}, mode, impair);
  }
}

TEST(SupportRemoved, ATowerOfSeveralOwnersComesDown) {
  for (const char* mode : {"strict", "touch", "buffer", "central"}) {
    for (const char* impair : {"perfect", "demo", "4g", "delay=200ms"}) {
      ExpectFall(kTower, {0.515, 1.53}, mode, impair);
    }
  }
}

}  // namespace support_removed_test
}  // namespace seam
