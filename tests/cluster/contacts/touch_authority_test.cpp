/// Authority on touch: a body goes to the player that hits it, wherever it lies.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "client/embed/cluster.h"

namespace seam {
namespace touch_authority_test {

/// Ann's box slides to the right and hits a crate that lies in bob's half.
constexpr const char* kScene = R"(
duration = 9
[[player]]
name = "ann"
vehicle = "box-a"
region = [[-1000, -1000], [-0.001, 1000]]
[[player]]
name = "bob"
vehicle = "box-b"
region = [[0, -1000], [1000, 1000]]
[[part]]
name = "ground"
chain = [[-300, 0], [300, 0]]
friction = 0.3
[[part]]
name = "box-a"
box = [2, 2]
position = [-6, 1]
density = 4
velocity = [14, 0]
friction = 0.9
owner = "ann"
[[part]]
name = "box-b"
box = [2, 2]
position = [60, 1]
owner = "bob"
[[part]]
name = "crate"
box = [1, 1]
position = [6, 0.5]
friction = 0.15
)";

/// The holders of the crate, in their order.
std::vector<int> Holders(const std::string& mode) {
  ClusterConfig config;
  config.scene = "touch";
  config.scene_text = kScene;
  config.mode = mode;
  config.impair = "delay=30ms";
  Cluster cluster(config);
  std::vector<int> holders;
  cluster.each_instant = [&] {
    const Replica& server = cluster.server().replica();
    if (!cluster.server().started() || server.tick() < 1) return;
    const World& world = server.world();
    const int now = server.authority().at(world.mechanism(world.BodyOfId(3))).authority;
    if (holders.empty() || holders.back() != now) holders.push_back(now);
  };
  cluster.Run();
  return holders;
}

TEST(TouchAuthority, GoesToThePlayerWhoHitsABodyAndBackToTheServerWhenItSleeps) {
  EXPECT_EQ(Holders("touch"), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(Holders("strict"), (std::vector<int>{2})) << "it lies in bob's region";
}

}  // namespace touch_authority_test
}  // namespace seam
