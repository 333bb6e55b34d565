/// scenes/crane.toml matches its title: a glued crate is lifted over the seam into a boat.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "client/embed/cluster.h"
#include "common/base/geometry.h"
#include "common/physics/part_places.h"

namespace seam {
namespace crane_test {

BodyState Named(const World& world, const std::string& name) {
  for (const Part& part : world.scene().parts) {
    if (part.name == name) return PartPose(world, part.id);
  }
  ADD_FAILURE() << "no part " << name;
  return {};
}

int JointsThere(const World& world, const std::string& begin) {
  int there = 0;
  for (const Joint& joint : world.scene().joints) {
    if (!joint.gone && joint.name.rfind(begin, 0) == 0) ++there;
  }
  return there;
}

/// The crate stands on the deck in one piece, without its ropes, and the boat floats upright.
void ExpectAboard(const World& world) {
  const BodyState boat = Named(world, "boat");
  EXPECT_LT(std::fabs(boat.angle), 0.1f);
  EXPECT_EQ(JointsThere(world, "crate."), 4) << "its glue holds";
  EXPECT_EQ(JointsThere(world, "left-rope") + JointsThere(world, "right-rope"), 0);
  for (const char* name : {"crate.0.0", "crate.1.0"}) {
    const BodyState piece = Named(world, name);
    const Vec2 on_deck = Turned(piece.position - boat.position, -boat.angle);
    EXPECT_NEAR(on_deck.y(), 0.7f + 0.25f + 0.015f, 0.05f) << name;
    EXPECT_LT(std::fabs(on_deck.x()), 2.5f) << name;
    EXPECT_LT((piece.velocity - boat.velocity).norm(), 0.2f) << name;
  }
}

TEST(CraneScene, LiftsAGluedCrateOverTheSeamIntoTheBoatOverTenSeedsUnder4g) {
  for (std::int64_t seed = 11; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ClusterConfig config;
    config.scene = "crane";
    config.impair = "4g";
    config.seed = seed;
    config.keep = false;
    Cluster cluster(config);
    const World& begin = cluster.server().replica().world();
    EXPECT_LT(Named(begin, "crate.0.0").position.x(), -8) << "it begins on ann's quay";
    cluster.Run();
    ExpectAboard(cluster.server().replica().world());
    for (int i = 0; i < cluster.client_count(); ++i) {
      SCOPED_TRACE("client " + std::to_string(i));
      ExpectAboard(cluster.client(i)->replica()->world());
    }
  }
}

}  // namespace crane_test
}  // namespace seam
