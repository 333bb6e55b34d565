/// scenes/dockside.toml matches its title: crane, crate, driver, boat, pier and score.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "client/embed/cluster.h"
#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "server/rules/rules.h"

namespace seam {
namespace dockside_test {

PartId IdOf(const World& world, const std::string& name) {
  for (const Part& part : world.scene().parts) {
    if (part.name == name) return part.id;
  }
  ADD_FAILURE() << "no part " << name;
  return 0;
}

BodyState Named(const World& world, const std::string& name) {
  return PartPose(world, IdOf(world, name));
}

void ExpectDelivered(const World& world) {
  const BodyState boat = Named(world, "boat");
  EXPECT_GT(boat.position.x(), 20) << "by the pier";
  EXPECT_LT(std::fabs(boat.angle), 0.15f);
  for (const char* name : {"crate.0.0", "crate.1.0"}) {
    const Vec2 on_deck = Turned(Named(world, name).position - boat.position, -boat.angle);
    EXPECT_NEAR(on_deck.y(), 0.965f, 0.06f) << name;
    EXPECT_LT(std::fabs(on_deck.x()), 3.2f) << name;
  }
  const std::vector<int>& assembly = world.composition().assembly_of_part;
  const auto of = [&](const char* name) {
    return assembly[static_cast<std::size_t>(IdOf(world, name))];
  };
  EXPECT_EQ(of("sailor.torso"), of("boat")) << "he sits at the helm";
  const auto glue =
      std::count_if(world.scene().joints.begin(), world.scene().joints.end(),
                    [](const Joint& j) { return !j.gone && j.name.rfind("crate.", 0) == 0; });
  EXPECT_EQ(glue, 4) << "the crate is in one piece";
}

TEST(DocksideScene, TheCrateIsLoadedAndDeliveredAndScoredOverTenSeedsUnder4g) {
  for (std::int64_t seed = 11; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ClusterConfig config;
    config.scene = "dockside";
    config.impair = "4g";
    config.seed = seed;
    config.keep = false;
    Cluster cluster(config);
    cluster.Run();
    const MetaTable& values = cluster.server().rules()->metadata();
    EXPECT_EQ(values.Get({kMetaPlayer, 0, kMetaScore}), 10) << "ann's: loaded";
    EXPECT_EQ(values.Get({kMetaPlayer, 1, kMetaScore}), 50) << "bob's: delivered";
    ExpectDelivered(cluster.server().replica().world());
    for (int i = 0; i < cluster.client_count(); ++i) {
      SCOPED_TRACE("client " + std::to_string(i));
      ExpectDelivered(cluster.client(i)->replica()->world());
    }
  }
}

}  // namespace dockside_test
}  // namespace seam
