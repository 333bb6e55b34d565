/// Mode central, clients that predict only their own: the server leaves out states that dead
/// reckoning gives, and clients reckon on.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/measure/revisions.h"

namespace seam {
namespace far_bodies_test {

/// Ann at the left, bob at the right, `filler` bodies that do nothing, and one that moves at 1 m/s
/// and spins, `x` m away from ann. With more than 256 bodies the room is a large one.
std::string Scene(int filler, double x, const std::string& more) {
  return R"(
duration = 6
gravity = [0, 0]
[[player]]
name = "ann"
region = [[-200, -50], [-0.01, 100]]
vehicle = "own"
[[player]]
name = "bob"
region = [[0, -50], [200, 100]]
vehicle = "bo"
[[part]]
name = "mover"
box = [2, 0.4]
position = [)" +
         std::to_string(x) + R"(, 5]
velocity = [1, 0]
)" + more +
         R"(
[[part]]
name = "own"
box = [1, 1]
position = [-5, 5]
owner = "ann"
[[part]]
name = "bo"
box = [1, 1]
position = [8, 15]
owner = "bob"
[[part]]
name = "filler"
box = [0.5, 0.5]
position = [-150, -20]
repeat = {count = [)" +
         std::to_string(filler / 10) + R"(, 10], step = [0.8, 0.8]}
)";
}

struct Seen {
  double still = 0, longest = 0;  // share of ticks without a move; longest move of a tick, m
};

Seen AnnsViewOfTheMover(const std::string& text, const std::string& impair) {
  ClusterConfig config;
  config.scene_text = text;
  config.mode = "central";
  config.predict = "own";
  config.impair = impair;
  const Recording run = RunCluster(config);
  Seen seen;
  const auto& views = run.views.at(1);
  int count = 0, still = 0;
  for (auto now = views.upper_bound(120); now != views.end(); ++now) {
    const auto before = views.find(now->first - 1);
    const int k = IndexOf(now->second, 0);
    if (before == views.end() || k < 0) continue;
    const auto i = static_cast<std::size_t>(k);
    const double step =
        std::hypot(now->second.x[i] - before->second.x[i], now->second.y[i] - before->second.y[i]);
    ++count;
    still += step < 1e-4 ? 1 : 0;
    seen.longest = std::max(seen.longest, step);
  }
  EXPECT_GT(count, 200);
  seen.still = static_cast<double>(still) / std::max(1, count);
  return seen;
}

TEST(FarBodies, GlideInLargeRoomsAsInSmallOnes) {
  for (const int filler : {20, 300}) {
    for (const double x : {10.0, 40.0, 90.0}) {
      for (const char* more : {"", "spin = 2"}) {
        for (const char* impair : {"perfect", "4g"}) {
          SCOPED_TRACE(std::to_string(filler) + " " + std::to_string(x) + " " + more + " " +
                       impair);
          const Seen seen = AnnsViewOfTheMover(Scene(filler, x, more), impair);
          EXPECT_EQ(seen.still, 0);
          EXPECT_LT(seen.longest, 1.5 / 60) << "1 m/s";
        }
      }
    }
  }
}

}  // namespace far_bodies_test
}  // namespace seam
