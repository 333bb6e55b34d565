/// Strands are only displayed: they do not collide and are not sent.

#include "common/sync/show/strand_view.h"

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "tests/lab/session.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace strand_view_test {

const char* const kFlyer = R"(
[[part]]
name = "flyer"
box = [1, 0.5]
position = [-4, 3]
velocity = [6, 0]
[[part]]
name = "ground"
chain = [[-50, 0], [50, 0]]
friction = 0.8
)";
const char* const kScarf = R"(
[[strand]]
name = "scarf"
part = "flyer"
at = [-0.5, 0.2]
length = 1.5
links = 6
)";

std::string MistakeIn(const std::string& text) {
  try {
    ParseScene(text, "strand.toml");
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "none";
}

Recording Play(const std::string& text, double duration_s = 2, const char* impair = "4g") {
  ClusterConfig config;
  config.scene_text = text;
  config.impair = impair;
  config.duration_s = duration_s;
  return RunCluster(config);
}

std::vector<Vec2> PointsOf(const Strands& strands) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < strands.x.size(); ++i)
    points.emplace_back(strands.x[i], strands.y[i]);
  return points;
}

TEST(StrandView, EveryPeerShowsItAtItsDisplayedPart) {
  const Recording recording = Play(std::string(kTwoSides) + kFlyer + kScarf);
  ASSERT_EQ(recording.strands.size(), 3u);
  for (const auto& [peer, by_tick] : recording.strands) {
    ASSERT_GT(by_tick.size(), 60u) << peer;
    for (const auto& [tick, strands] : by_tick) {
      const std::vector<Vec2> points = PointsOf(strands);
      ASSERT_EQ(points.size(), 7u);
      const View& view = recording.views.at(peer).at(tick);
      ASSERT_EQ(view.id.size(), 1u);
      const float c = std::cos(view.angle[0]), s = std::sin(view.angle[0]);
      const Vec2 upper(view.x[0] - 0.5f * c - 0.2f * s, view.y[0] - 0.5f * s + 0.2f * c);
      EXPECT_LT((points[0] - upper).norm(), 1e-3f) << "peer " << peer << " tick " << tick;
      float length = 0;
      for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
      EXPECT_NEAR(length, 1.5f, 0.3f) << "peer " << peer << " tick " << tick;
    }
  }
}

TEST(StrandView, TrailsBehindAFlyingPartAndHangsBelowARestingOne) {
  const Recording recording = Play(std::string(kTwoSides) + kFlyer + kScarf, 12);
  const auto& server = recording.strands.at(0);
  const std::vector<Vec2> flying = PointsOf(server.at(20)),
                          rests = PointsOf(server.rbegin()->second);
  EXPECT_LT(flying.back().x(), flying.front().x() - 0.3f);
  EXPECT_NEAR(rests.back().x(), rests.front().x(), 0.2f);
  EXPECT_LT(rests.back().y(), rests.front().y() - 1);
}

TEST(StrandView, CollidesWithNothingAndIsNotSent) {
  // Without loss: the scene's text is longer, so other datagrams would be lost.
  const Recording with = Play(std::string(kTwoSides) + kFlyer + kScarf, 2, "perfect");
  const Recording without = Play(std::string(kTwoSides) + kFlyer, 2, "perfect");
  ASSERT_EQ(with.views.at(0).size(), without.views.at(0).size());
  for (const auto& [tick, view] : with.views.at(0)) {
    EXPECT_EQ(view.x, without.views.at(0).at(tick).x);
    EXPECT_EQ(view.angle, without.views.at(0).at(tick).angle);
  }
  EXPECT_EQ(with.stats.at(1).back().bytes_out, without.stats.at(1).back().bytes_out);
  EXPECT_TRUE(without.strands.empty());
}

TEST(StrandView, AStrandLeavesWithItsPartAndRestartsAtThePartsNewPlace) {
  Scene scene = ParseScene(std::string(kFlyer) + kScarf, "flyer.toml");
  World world(scene);
  StrandView strands(world);
  View view;
  view.id = {0};
  view.x = {100}, view.y = {50}, view.angle = {0};
  for (view.tick = 1; view.tick < 30; ++view.tick) strands.Next(view);
  view.x = {-300};  // as after a teleport: no lash of 400 m
  const std::vector<Vec2> points = PointsOf(strands.Next(view));
  ASSERT_EQ(points.size(), 7u);
  for (const Vec2& point : points) EXPECT_NEAR(point.x(), -300.5f, 0.1f);
  world.Apply({Edit(RemoveEdit{0})});
  EXPECT_TRUE(strands.Next(View()).strand.empty());
}

TEST(StrandView, MistakesAreOneClearLine) {
  const std::string part = "[[part]]\nname = \"p\"\ncircle = 1\n";
  const auto mistake = [&](const std::string& rest) {
    return MistakeIn(part + "[[strand]]\nname = \"s\"\npart = \"p\"\n" + rest);
  };
  EXPECT_NE(mistake("links = 1\n").find("links"), std::string::npos);
  EXPECT_NE(mistake("length = 100\n").find("length"), std::string::npos);
  EXPECT_NE(mistake("[[strand]]\nname = \"s\"\npart = \"p\"\n").find("another strand"),
            std::string::npos);
  EXPECT_NE(MistakeIn(part + "[[strand]]\nname = \"s\"\npart = \"q\"\n").find("q"),
            std::string::npos);
}

}  // namespace strand_view_test
}  // namespace seam
