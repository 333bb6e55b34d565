/// States of the first ticks, when no other player's inputs are known yet, must not assume that
/// there are none: others would apply them, rounded by the wire, and never agree bit for bit again.

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "client/embed/cluster.h"

namespace seam {
namespace first_ticks_test {

/// A cart at x on two wheels, driven by `player` towards `to`.
std::string CartText(const std::string& player, double x, int to) {
  const auto at = [](double where) { return std::to_string(where); };
  std::string text = "[[part]]\nname = \"" + player + "\"\nbox = [3, 0.6]\nposition = [" + at(x) +
                     ", 0.75]\ndensity = 2\nfriction = 0.3\n";
  for (const int side : {-1, 1}) {
    const std::string wheel = player + (side < 0 ? "-l" : "-r");
    text += "[[part]]\nname = \"" + wheel + "\"\ncircle = 0.4\nposition = [" + at(x + 1.1 * side) +
            ", 0.42]\ndensity = 1.5\nfriction = 0.9\n[[joint]]\nname = \"axle-" + wheel +
            "\"\nkind = \"wheel\"\na = \"" + player + "\"\nb = \"" + wheel +
            "\"\nfrequency = 5\nmotor = {player = \"" + player +
            "\", speed = " + std::to_string(12 * to) + ", torque = 80}\n";
  }
  return text;
}

std::string HingeText(const std::string& name, const std::string& a, const std::string& b, int x,
                      const std::string& rest = "") {
  return "[[joint]]\nname = \"" + name + "\"\nkind = \"hinge\"\na = \"" + a + "\"\nb = \"" + b +
         "\"\nanchor = [" + std::to_string(x) + ", 0.75]\n" + rest;
}

/// Two that pull at a rope of eight links, from `begins` s on: taut, it makes much of little.
std::string TugText(const char* begins) {
  std::string text = "duration = 4\n";
  for (const char* player : {"ann", "bob"}) {
    text += std::string("[[player]]\nname = \"") + player + "\"\nscript = [[0, {}], [" + begins +
            ", {drive = 1}], [1.5, {drive = 0.6}]]\n";
  }
  return text + "[[part]]\nname = \"ground\"\nchain = [[-40, 9], [-40, 0], [40, 0], [40, 9]]\n" +
         "friction = 0.8\n" + CartText("ann", -5.5, 1) + CartText("bob", 5.5, -1) +
         "[[part]]\nname = \"link\"\ncapsule = [0.85, 0.07]\nposition = [-3.5, 0.75]\n" +
         "density = 4\ngroup = -5\nrepeat = {count = 8, step = [1, 0]}\n" +
         HingeText("pin", "link.0", "link.1", -3, "repeat = {count = 7, step = [1, 0]}\n") +
         HingeText("left", "ann", "link.0", -4) + HingeText("right", "bob", "link.7", 4);
}

/// Counts ticks in the last second of 4 s: those in which all three peers had the same bits, and
/// all.
std::pair<int, int> EqualTicks(const char* begins, std::int64_t seed) {
  ClusterConfig config;
  config.scene = "tug";
  config.scene_text = TugText(begins);
  config.seed = seed;
  Cluster cluster(config);
  std::int64_t looked = 0;
  std::pair<int, int> out;
  cluster.each_instant = [&] {
    const World& server = cluster.server().replica().world();
    if (server.tick() < 180 || server.tick() == looked) return;
    const World& ann = cluster.client(0)->replica()->world();
    const World& bob = cluster.client(1)->replica()->world();
    if (ann.tick() != server.tick() || bob.tick() != server.tick()) return;
    looked = server.tick();
    ++out.second;
    if (ann.Hash() == server.Hash() && bob.Hash() == server.Hash()) ++out.first;
  };
  cluster.Run();
  return out;
}

TEST(FirstTicks, AllPeersAgreeBitForBitWhenPlayersDriveFromTheStart) {
  for (const char* begins : {"0.02", "0.1", "0.25"}) {
    for (std::int64_t seed = 1; seed <= 3; ++seed) {
      const auto [equal, all] = EqualTicks(begins, seed);
      EXPECT_GT(all, 30);
      EXPECT_EQ(equal, all) << begins << " s, seed " << seed;
    }
  }
}

}  // namespace first_ticks_test
}  // namespace seam
