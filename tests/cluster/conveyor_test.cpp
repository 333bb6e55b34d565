/// The boxes of scenes/conveyor.toml circulate for ten minutes.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "client/embed/cluster.h"
#include "common/physics/part_places.h"

namespace seam {
namespace conveyor_test {

/// Counts how often each box has passed x = 0 on the upper belt, to the left.
class Laps {
 public:
  void Look(const World& world) {
    for (const Part& part : world.scene().parts) {
      if (part.name.rfind("box.", 0) != 0) continue;
      BodyState state;
      if (!ReadPart(world, part.id, &state)) continue;
      const float x = state.position.x();
      const auto [it, fresh] = last_.emplace(part.name, x);
      count_.emplace(part.name, 0);
      if (!fresh && it->second > 0 && x <= 0 && state.position.y() > 4) ++count_[part.name];
      it->second = x;
    }
  }
  const std::map<std::string, int>& count() const { return count_; }

 private:
  std::map<std::string, float> last_;
  std::map<std::string, int> count_;
};

TEST(ConveyorScene, AllBoxesCirculateForTenMinutesAndNoneIsLost) {
  for (const std::int64_t seed : {3}) {
    ClusterConfig config;
    config.scene = "conveyor";
    config.impair = "4g";
    config.seed = seed;
    config.duration_s = 600;
    config.keep = false;
    Cluster cluster(config);
    Laps laps;
    std::int64_t looked = 0;
    cluster.each_instant = [&] {
      const World& world = cluster.server().replica().world();
      if (world.tick() > looked) laps.Look(world);
      looked = world.tick();
    };
    cluster.Run();
    EXPECT_EQ(cluster.server().left_bounds(), 0) << "seed " << seed;
    EXPECT_EQ(cluster.server().replica().revision(), 0) << "seed " << seed;
    ASSERT_EQ(laps.count().size(), 5u);
    for (const auto& [name, count] : laps.count()) {
      std::printf("[          ] seed %lld, %s: %d rounds\n", static_cast<long long>(seed),
                  name.c_str(), count);
      EXPECT_GE(count, 15) << "seed " << seed << ", " << name;
    }
  }
}

}  // namespace conveyor_test
}  // namespace seam
