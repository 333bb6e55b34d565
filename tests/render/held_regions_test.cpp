/// Regions that follow the players, drawn around each player's bodies.

#include "render/playback/held_regions.h"

#include <gtest/gtest.h>

#include "client/embed/cluster.h"
#include "tests/support/plan/plain_scene.h"

namespace seam {
namespace held_regions_test {

Playback Recorded(const std::string& scene_text) {
  ClusterConfig config;
  config.scene = "plain";
  config.scene_text = scene_text;
  config.drive = Drive::kBot;
  config.duration_s = 2;
  return Playback(RunCluster(config), std::nullopt);
}

TEST(HeldRegions, EachRegionEnclosesTheBodiesOfItsPeer) {
  PlainScene plain;
  plain.players = 2;
  const Playback playback = Recorded(PlainText(plain));
  const Moment moment = playback.MomentAt(playback.PeerOr(0), 90);
  const std::vector<HeldRegion> regions = HeldRegions(playback, moment);
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_LT(regions[0].peer, regions[1].peer);
  EXPECT_TRUE(regions[0].max.x() < regions[1].min.x() || regions[1].max.x() < regions[0].min.x())
      << "the players are 30 m apart, and hold what is around them";
  for (const BodyShapes& body : playback.moving()) {
    const std::optional<Shown> shown = playback.Find(moment, body.id);
    ASSERT_TRUE(shown);
    for (const HeldRegion& region : regions) {
      if (shown->authority != region.peer) continue;
      EXPECT_GE((shown->pose.position - region.min).minCoeff(), kHeldMargin);
      EXPECT_GE((region.max - shown->pose.position).minCoeff(), kHeldMargin);
    }
  }
}

TEST(HeldRegions, ASceneThatFixesItsRegionsHasNone) {
  const char* const fixed =
      "[[player]]\nname = \"ann\"\nregion = [[-9, -9], [9, 9]]\n"
      "[[part]]\nname = \"ball\"\ncircle = 1\n";
  const Playback playback = Recorded(fixed);
  EXPECT_TRUE(HeldRegions(playback, playback.MomentAt(playback.PeerOr(0), 60)).empty());
  const Playback planned = Recorded(std::string(fixed) + "[planner]\nacquire = 9\n");
  EXPECT_TRUE(HeldRegions(planned, planned.MomentAt(planned.PeerOr(0), 60)).empty())
      << "she has no vehicle: everything is the server's";
}

}  // namespace held_regions_test
}  // namespace seam
