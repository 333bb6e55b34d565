#include <gtest/gtest.h>

#include <cmath>

#include "render/draw/draw_body.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_world_test {

TEST(DrawWorld, ABoxColoursThePixelsAtItsPlace) {
  const Playback playback = MakePlayback();
  Viewport viewport;
  const double tick = 30;
  const Image image = RenderedWorld(playback, tick, &viewport);
  const Vec2 cart = synthetic::Truth(1, tick).position;
  const Colour solid = PeerColour(1);
  // Half a metre within the corners of the 3 m x 1.5 m box, and outside of them.
  for (float x : {-1.2f, 1.2f})
    for (float y : {-0.5f, 0.5f})
      EXPECT_EQ(PixelAt(image, viewport.ToPx(cart + Vec2(x, y))), solid) << x << " " << y;
  EXPECT_FALSE(PixelAt(image, viewport.ToPx(cart + Vec2(0, 1.9f))) == solid);
  EXPECT_FALSE(PixelAt(image, viewport.ToPx(cart + Vec2(2, 0))) == solid);
}

TEST(DrawWorld, ShowsThePeersViewAndNotTheTruth) {
  const int late = 20;
  const Playback playback = MakePlayback(late);
  Viewport viewport;
  const double tick = 30;
  const Image image = RenderedWorld(playback, tick, &viewport);
  // Peer 1 shows ben's cart as a remote copy, where it was 20 ticks ago.
  const Vec2 shown = synthetic::Truth(2, tick - late).position;
  const BodyLook remote = LookOf(PeerColour(2), kRoleRemote);
  int pale = 0;
  for (float x = -1; x <= 1; x += 0.05f)
    if (PixelAt(image, viewport.ToPx(shown + Vec2(x, 0.3f))) == remote.fill) ++pale;
  EXPECT_GT(pale, 10);
}

TEST(DrawWorld, RolesLookDifferentAndSoDoPeers) {
  std::set<std::string> looks;
  for (int peer = 0; peer < 8; ++peer)
    for (int role : {kRoleAuthority, kRoleSecondary, kRoleRemote}) {
      const Colour c = LookOf(PeerColour(peer), role).fill;
      looks.insert({static_cast<char>(c.r), static_cast<char>(c.g), static_cast<char>(c.b)});
    }
  EXPECT_EQ(looks.size(), 24u);
  EXPECT_FALSE(LookOf(PeerColour(1), kRoleSecondary).hatched);
  EXPECT_TRUE(LookOf(PeerColour(1), kRoleRemote).hatched);
}

TEST(DrawWorld, TheGhostAppearsOnlyIfViewAndOracleDiffer) {
  Viewport viewport;
  const double tick = 40;
  const auto ink = [&](const Playback& playback) {
    const Image image = RenderedWorld(playback, tick, &viewport);
    const Vec2 truth = viewport.ToPx(synthetic::Truth(2, tick).position);
    int dark = 0;
    for (int y = 0; y < image.height_px; ++y)
      for (int x = static_cast<int>(truth.x()) - 60; x < image.width_px; ++x) {
        const Colour c = PixelAt(image, Vec2(x, y));
        if (c.r < 90 && c.g < 90 && c.b < 90) ++dark;
      }
    return dark;
  };
  const int present = ink(MakePlayback(0));
  EXPECT_GT(ink(MakePlayback(10)), present + 50);
  Recording late = synthetic::MakeRecording(10);
  synthetic::SayAges(10, &late);
  EXPECT_LE(ink(Playback(late, synthetic::MakeScene(), synthetic::MakeOracle())), present)
      << "what is shown of the past is compared with that moment";
}

TEST(DrawWorld, CullingChangesNoPixel) {
  Scene scene = synthetic::MakeScene();
  scene.camera.given = true;
  scene.camera.min = {-9, 0};  // cuts through the stack, the carts' ways and the wheel's
  scene.camera.max = {9, 4};
  scene.camera.follow = 1;
  const Playback playback(synthetic::MakeRecording(6), scene, synthetic::MakeOracle());
  for (double tick : {10.0, 60.0, 75.5, 90.0, 150.0}) {
    Viewport viewport;
    const Image culled = RenderedWorld(playback, tick, &viewport, true);
    const Image whole = RenderedWorld(playback, tick, &viewport, false);
    EXPECT_EQ(Differences(culled, whole), 0) << tick;
  }
}

TEST(DrawWorld, CullingOmitsDistantBodies) {
  const Playback playback = MakePlayback();
  DrawList list(TestFont());
  const auto triangles = [&](bool cull) {
    list.Begin(800, 400);
    Viewport viewport;
    viewport.panel = {0, 0, 800, 400};
    viewport.centre = {1000, 1000};
    WorldLook look;
    look.tick = 30;
    look.cull = cull;
    DrawWorld(list, viewport, playback, look);
    return list.indices().size() / 3;
  };
  EXPECT_LT(triangles(true) + 50, triangles(false));
}

TEST(Viewport, FitsTheWholeBoxAndInvertsItself) {
  const Viewport viewport = Fit({100, 50, 400, 300}, {-20, -2}, {20, 12});
  EXPECT_NEAR(viewport.px_per_m, 10, 1e-4);
  EXPECT_TRUE(viewport.ToPx({-20, 5}).isApprox(Vec2(100, 200), 1e-4f));
  EXPECT_TRUE(viewport.ToPx({0, 12}).isApprox(Vec2(300, 130), 1e-4f));
  EXPECT_TRUE(viewport.ToWorld(viewport.ToPx({3, 4})).isApprox(Vec2(3, 4), 1e-4f));
  EXPECT_TRUE(viewport.Sees({20, 5}, 0));
  EXPECT_FALSE(viewport.Sees({23, 5}, 2));
  EXPECT_TRUE(viewport.Sees({23, 5}, 4));
}

TEST(Viewport, APageOfAnyNumberOfPanelsHasNoHoles) {
  for (int count = 1; count <= 10; ++count) {
    for (const float aspect : {0.5f, 1.0f, 2.0f, 6.0f}) {
      const Rect area{10, 20, 1200, 500};
      float covered = 0;
      for (const Rect& panel : Tile(area, count, aspect, 0)) {
        covered += panel.width * panel.height;
        EXPECT_LE(panel.right(), area.right() + 0.1f);
        EXPECT_LE(panel.bottom(), area.bottom() + 0.1f);
      }
      EXPECT_NEAR(covered, area.width * area.height, 1) << count << " panels of " << aspect;
    }
  }
}

TEST(Viewport, TilesWidePanelsBelowEachOtherAndTallOnesBesideEachOther) {
  const std::vector<Rect> wide = Tile({0, 0, 1200, 600}, 2, 5, 10);
  EXPECT_EQ(wide[0].x, wide[1].x);
  EXPECT_LT(wide[0].bottom(), wide[1].y);
  const std::vector<Rect> tall = Tile({0, 0, 1200, 600}, 2, 0.8f, 10);
  EXPECT_EQ(tall[0].y, tall[1].y);
  EXPECT_NEAR(tall[1].right(), 1200, 0.01);
}

TEST(Playback, InterpolatesBetweenTicksAndNeverBeyondTheLast) {
  const Playback playback = MakePlayback();
  const auto x_at = [&](double tick) {
    return playback.Find(playback.MomentAt(1, tick), 1)->pose.position.x();
  };
  const float at_30 = synthetic::Truth(1, 30).position.x();
  const float at_31 = synthetic::Truth(1, 31).position.x();
  EXPECT_FLOAT_EQ(x_at(30), at_30);
  EXPECT_NEAR(x_at(30.25), 0.75f * at_30 + 0.25f * at_31, 1e-5);
  EXPECT_FLOAT_EQ(x_at(synthetic::kTicks + 50.5), x_at(synthetic::kTicks));
  EXPECT_EQ(playback.MomentAt(1, -1).before, nullptr);
  EXPECT_EQ(playback.MomentAt(9, 30).before, nullptr);
}

TEST(Playback, HoldsTheLastViewOverAHoleAndBridgesALostOne) {
  Recording recording = synthetic::MakeRecording(0);
  recording.views[1].erase(31);                                            // one lost
  for (int tick = 61; tick < 100; ++tick) recording.views[1].erase(tick);  // a hole
  const Playback playback(recording, synthetic::MakeScene(), synthetic::MakeOracle());
  const auto x_at = [&](double tick) {
    return playback.Find(playback.MomentAt(1, tick), 1)->pose.position.x();
  };
  EXPECT_NEAR(x_at(31), synthetic::Truth(1, 31).position.x(), 1e-4);
  EXPECT_FLOAT_EQ(x_at(80), synthetic::Truth(1, 60).position.x());
  EXPECT_FLOAT_EQ(x_at(100), synthetic::Truth(1, 100).position.x());
}

TEST(Playback, KnowsTheDriverOfEachBody) {
  const Playback playback = MakePlayback();
  EXPECT_EQ(playback.PlayerOf(0), -1);
  EXPECT_EQ(playback.PlayerOf(1), 0);
  EXPECT_EQ(playback.PlayerOf(2), 1);
  EXPECT_EQ(playback.PeerName(0), "server");
  EXPECT_EQ(playback.PeerName(2), "ben (peer 2)");
  EXPECT_EQ(playback.Label(), "buffer · interleave");
}

TEST(Playback, AViewsErrorIsTheMeasureOfThatViewAlone) {
  const Playback playback = MakePlayback(6);
  // Peer 1 shows ben's cart 6 ticks late at 6.8 m/s, the stack and its own things right.
  const double late_m = 6.8 * 6 / 60;
  const auto error = playback.ErrorAt(1, 40);
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR(*error, late_m / std::sqrt(7.0), 1e-4);
  EXPECT_FALSE(playback.ErrorAt(1, synthetic::kTicks + 1).has_value());
  EXPECT_EQ(MakePlayback(0).ErrorAt(-1, 40).value(), 0);
}

TEST(Playback, AnErrorThatIsNotKnownIsNotZero) {
  Oracle oracle = synthetic::MakeOracle();
  oracle.ticks.resize(101);  // the oracle ends at tick 100
  oracle.ticks[50].clear();  // and lost one
  Recording recording = synthetic::MakeRecording(6);
  recording.views[1].erase(60);
  const Playback playback(recording, synthetic::MakeScene(), oracle);
  EXPECT_TRUE(playback.ErrorAt(1, 40).has_value());
  EXPECT_FALSE(playback.ErrorAt(1, 50).has_value());
  EXPECT_FALSE(playback.ErrorAt(1, 60).has_value());
  EXPECT_TRUE(playback.ErrorAt(-1, 60).has_value());
  EXPECT_TRUE(playback.ErrorAt(1, 100).has_value());
  EXPECT_FALSE(playback.ErrorAt(1, 101).has_value());
  EXPECT_FALSE(playback.ErrorAt(-1, 101).has_value());
}

TEST(Playback, WithoutAnOracleThereAreNoErrorsAndNoGhosts) {
  const Playback playback(synthetic::MakeRecording(6), synthetic::MakeScene(), std::nullopt);
  EXPECT_FALSE(playback.ErrorAt(-1, 40).has_value());
  EXPECT_FALSE(playback.Truth(1, 40).has_value());
  EXPECT_TRUE(MakePage(playback, 0).curves.empty());
  EXPECT_GT(Differences(RenderedPage(MakePage(playback, 1), 0.7),
                        RenderedPage(MakePage(MakePlayback(), 1), 0.7)),
            100);
}

}  // namespace render_world_test
}  // namespace seam
