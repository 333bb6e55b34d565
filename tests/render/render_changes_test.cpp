/// Pictures of worlds with changing bodies: each view by its own topology, large ones by their rim.

#include <gtest/gtest.h>

#include <string>

#include "client/embed/cluster.h"
#include "common/sync/edits/edit_order.h"
#include "render/playback/playback.h"

namespace seam {
namespace render_changes_test {

std::string Box(const std::string& name, int x, int y) {
  return "[[part]]\nname = \"" + name + "\"\nbox = [1, 1]\nposition = [" + std::to_string(x) +
         ", " + std::to_string(y) + "]\n";
}

std::string Joined(const std::string& kind, const std::string& a, const std::string& b) {
  return "[[joint]]\nname = \"" + a + "-" + b + "\"\nkind = \"" + kind + "\"\na = \"" + a +
         "\"\nb = \"" + b + "\"\n" + (kind == "glue" ? "strength = 1e6\n" : "");
}

TEST(RenderChanges, TheRimOfASquareOfBoxesIsItsOutside) {
  std::string text = "gravity = [0, 0]\n";
  constexpr int kSide = 11;
  const auto name = [](int x, int y) { return "b" + std::to_string(kSide * y + x); };
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) text += Box(name(x, y), x, y);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (x + y > 0) text += Joined("weld", x > 0 ? name(x - 1, y) : name(x, y - 1), name(x, y));
  const Scene scene = ParseScene(text, "square.toml");
  const DrawnRevision revision = RevisionOf(scene, Compose(scene));
  ASSERT_EQ(revision.moving.size(), 1u);
  EXPECT_EQ(revision.moving[0].rim.size(), 4u * kSide);
  for (const auto& edge : revision.moving[0].rim) EXPECT_NEAR((edge[0] - edge[1]).norm(), 1, 1e-5);
}

TEST(RenderChanges, APulleysRopeGoesUpAcrossAndDown) {
  const Scene scene =
      ParseScene(Box("a", 0, 0) + Box("b", 4, 1) +
                     "[[joint]]\nname = \"rope\"\nkind = \"pulley\"\na = \"a\"\nb = \"b\"\n"
                     "ground_a = [0, 9]\nground_b = [4, 9]\n",
                 "pulley.toml");
  const std::vector<DrawnJoint> ropes = JointsOf(scene, Compose(scene));
  ASSERT_EQ(ropes.size(), 3u);
  for (const DrawnJoint& rope : ropes) EXPECT_TRUE(rope.rod);
  EXPECT_EQ(ropes[0].a, 0);
  EXPECT_EQ(ropes[0].b, -1);
  EXPECT_EQ(ropes[0].anchor_b, Vec2(0, 9));
  EXPECT_EQ(ropes[1].anchor_a, Vec2(0, 9));
  EXPECT_EQ(ropes[1].anchor_b, Vec2(4, 9));
  EXPECT_EQ(ropes[2].anchor_a, Vec2(4, 9));
  EXPECT_EQ(ropes[2].b, 1);
  EXPECT_EQ(ropes[2].anchor_b, Vec2(0, 0)) << "in the frame of the part";
}

TEST(RenderChanges, EachViewIsDrawnByItsOwnTopology) {
  ClusterConfig config;
  config.scene_text = "gravity = [0, 0]\nduration = 3\n[[player]]\nname = \"ann\"\n" +
                      Box("left", 0, 0) + Box("right", 1, 0) + Joined("glue", "left", "right");
  config.impair = "4g";
  Cluster cluster(config);
  cluster.RunToTick(60);
  cluster.server().Order(Edit(BreakEdit{0}, EditCause::kOutside));
  cluster.Run();
  const Recording& recording = cluster.recording();
  const Playback playback(recording, ComputeOracle(recording));
  std::int64_t changed = -1;
  for (const auto& [tick, view] : recording.views.at(1)) {
    const Moment moment = playback.MomentAt(1, static_cast<double>(tick));
    const bool broken = view.revision == 1;
    if (broken && changed < 0) changed = tick;
    EXPECT_EQ(playback.RevisionOf(moment)->moving.size(), broken ? 2u : 1u) << tick;
    // Nothing but the skin between them (1.5 cm) moves the parts, in one body or in two.
    EXPECT_NEAR(playback.FindPart(moment, 0).value().position.x(), 0, 0.02);
    EXPECT_NEAR(playback.FindPart(moment, 1).value().position.x(), 1, 0.02);
    EXPECT_NEAR(playback.Truth(1, static_cast<double>(tick)).value().position.x(), 1, 0.02);
  }
  EXPECT_GT(changed, 60);
  EXPECT_LT(changed, 120);
}

}  // namespace render_changes_test
}  // namespace seam
