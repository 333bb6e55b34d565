/// A room of elastic discs whose clients may simulate only a few of them: a client's discs and
/// those they meet are simulated by the same peer; otherwise the two sides of an impact differ and
/// the room gains energy.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"

namespace seam {
namespace capacity_test {

/// Eight players steer a disc each, in the middle of 144 others.
std::string RoomText(int capacity) {
  std::string text =
      "title = \"discs\"\nduration = 4\ngravity = [0, 0]\nbounds = [[-50, -50], [50, 50]]\n"
      "[planner]\ncapacity = " +
      std::to_string(capacity) +
      "\n[[player]]\nname = \"p\"\nrepeat = {count = 8}\nvehicle = \"v.0\"\n"
      "script = [[0, {drive = 1}], [3, {drive = -1}]]\n"
      "[[part]]\nname = \"wall\"\nchain = [[-15, -15], [-15, 15], [15, 15], [15, -15], "
      "[-15, -15]]\nfriction = 0\nrestitution = 1\n"
      "[[part]]\nname = \"v\"\ncircle = 0.5\nposition = [-4.2, 0]\ndensity = 2\nfriction = 0\n"
      "restitution = 1\nowners = [\"p-*\"]\nrepeat = {count = 8, step = [1.2, 0]}\n";
  for (int n = 0; n < 8; ++n) {
    text += "[[thrust]]\nname = \"t" + std::to_string(n) + "\"\npart = \"v." + std::to_string(n) +
            "\"\nforce = [" + std::to_string(15 * std::cos(2.4 * n)) + ", " +
            std::to_string(15 * std::sin(2.4 * n)) + "]\nplayer = \"p-" + std::to_string(n) +
            "\"\n";
  }
  for (int n = 0; n < 144; ++n) {
    const int column = n % 12, row = n / 12;
    text += "[[part]]\nname = \"d" + std::to_string(n) + "\"\ncircle = 0.3\nfriction = 0\n" +
            "restitution = 1\ndensity = 1\nposition = [" + std::to_string(2.4 * column - 13.2) +
            ", " + std::to_string(2.4 * row - 13.3) + "]\nvelocity = [" +
            std::to_string(3 * std::cos(2.4 * n * n)) + ", " +
            std::to_string(3 * std::sin(1.7 * n * n)) + "]\n";
  }
  return text;
}

/// Largest energy of all displayed bodies over any 2 s, relative to the single world.
double MostEnergy(int capacity, std::int64_t seed) {
  ClusterConfig config;
  config.scene = "discs";
  config.scene_text = RoomText(capacity);
  config.seed = seed;
  Cluster cluster(config);
  cluster.Run();
  const auto measured = Measure(cluster.recording(), ComputeOracle(cluster.recording()));
  const double most = measured.energy_ratio_max.value_or(1e9);
  std::printf("  capacity %d, seed %d: %.2f\n", capacity, static_cast<int>(seed), most);
  return most;
}

TEST(Capacity, RoomsOfElasticDiscsGainNoEnergyAtAnyCapacity) {
  for (std::int64_t seed = 1; seed <= 2; ++seed) {
    for (const int capacity : {0, 10, 30}) EXPECT_LT(MostEnergy(capacity, seed), 1.1);
  }
}

}  // namespace capacity_test
}  // namespace seam
