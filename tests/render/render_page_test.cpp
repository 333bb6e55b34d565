#include <gtest/gtest.h>

#include <map>

#include "common/base/check.h"
#include "render/strobe.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_page_test {

TEST(Page, IsNotBlank) {
  const Playback playback = MakePlayback();
  const Image image = RenderedPage(MakePage(playback, 1), 1.3);
  std::map<std::uint32_t, int> colours;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    ++colours[static_cast<std::uint32_t>(image.rgba[i]) << 16 |
              static_cast<std::uint32_t>(image.rgba[i + 1]) << 8 | image.rgba[i + 2]];
  EXPECT_GT(colours.size(), 100u);
  const int pixels = image.width_px * image.height_px;
  for (const auto& [colour, count] : colours) EXPECT_LT(count, pixels * 6 / 10) << colour;
}

TEST(Page, TheHeaderShowsTheTitle) {
  const Playback playback = MakePlayback();
  Page page = MakePage(playback, 0);
  const Image before = RenderedPage(page, 1);
  page.title = "Two carts part";
  const Image after = RenderedPage(page, 1);
  EXPECT_GT(Differences(before, after, 0, 0, 600, 30), 30);
  EXPECT_EQ(Differences(before, after, 0, 34, 1280, 720), 0);
}

TEST(Page, TheClockAndThePlayheadMoveWithTime) {
  const Playback playback = MakePlayback();
  const Page page = MakePage(playback, 0);
  const Image a = RenderedPage(page, 1), b = RenderedPage(page, 2);
  EXPECT_GT(Differences(a, b, 900, 0, 1280, 56), 30);    // figures
  EXPECT_GT(Differences(a, b, 0, 620, 1280, 700), 100);  // strip
}

TEST(Page, TheMovingPartsOverAStillPictureMakeTheWholePage) {
  const Playback playback = MakePlayback();
  for (const int peer : {0, kViewAll}) {
    const Page page = MakePage(playback, peer);
    const std::unique_ptr<Canvas> canvas = MakeCanvas(TestFont());
    DrawList list(TestFont());
    Image still, moving;
    DrawStill(list, page);
    canvas->Draw(list, kPaper, &still);
    for (const double now_s : {0.5, 1.4}) {
      DrawMoving(list, page, now_s);
      canvas->Draw(list, still, &moving);
      EXPECT_EQ(moving.rgba, RenderedPage(page, now_s).rgba) << now_s << " s, view " << peer;
    }
  }
}

TEST(Page, EveryPeersViewHasAPanelAndACurve) {
  const Playback playback = MakePlayback();
  const Page all = MakePage(playback, kViewAll);
  ASSERT_EQ(all.panels.size(), 3u);
  ASSERT_EQ(all.curves.size(), 3u);
  for (int peer = 0; peer < 3; ++peer)
    EXPECT_EQ(all.panels[static_cast<std::size_t>(peer)].peer, peer);
  EXPECT_EQ(MakePage(playback, 2).panels.size(), 1u);
}

TEST(Page, AComparisonHasAPanelAndACurveForEachRun) {
  std::vector<Playback> runs;
  runs.push_back(MakePlayback(6));
  runs.push_back(Playback(synthetic::MakeRecording(1, "strict", ""), synthetic::MakeScene(),
                          synthetic::MakeOracle()));
  const Page page = MakeComparison(runs, 1);
  ASSERT_EQ(page.panels.size(), 2u);
  ASSERT_EQ(page.curves.size(), 2u);
  EXPECT_EQ(page.panels[0].caption, "buffer · interleave");
  EXPECT_EQ(page.panels[1].caption, "strict");
  EXPECT_FALSE(page.curves[0].colour == page.curves[1].colour);
  // The runs are in step: the same moment of both, and only the second differs when it changes.
  const Image before = RenderedPage(page, 1);
  std::vector<Playback> changed;
  changed.push_back(MakePlayback(6));
  changed.push_back(Playback(synthetic::MakeRecording(20, "strict", ""), synthetic::MakeScene(),
                             synthetic::MakeOracle()));
  const Image after = RenderedPage(MakeComparison(changed, 1), 1);
  EXPECT_GT(Differences(before, after, 0, 60, 1280, 570), 100);
}

TEST(Strip, TheCurveLiesAtItsErrorOnTheScale) {
  const std::vector<double> errors(101, 0.01);
  Curve curve;
  curve.errors_m = &errors;
  curve.tick_hz = 100;
  curve.colour = {255, 0, 0, 255};
  DrawList list(TestFont());
  list.Begin(460, 142);
  DrawStrip(list, {0, 0, 460, 142}, {curve}, {0, 1, 1});
  DrawStripNow(list, {0, 0, 460, 142}, {curve}, {0, 1, 1});
  const Image image = Rendered(list);
  // Decades from 1 mm to 10 cm on 100 px: 1 cm lies half way up.
  int red_row = -1;
  for (int y = 0; y < 142; ++y) {
    const Colour c = PixelAt(image, Vec2(200, y));
    if (c.r > 240 && c.g < 60 && c.b < 60 && red_row < 0) red_row = y;
  }
  EXPECT_NEAR(red_row, 22 + (142 - 42) / 2, 2);
}

TEST(Strobe, FindsTheWatchedCollision) {
  std::vector<Playback> runs;
  runs.push_back(MakePlayback());
  EXPECT_NEAR(CollisionTime(runs), synthetic::kHitTick / 60.0, 1.01 / 60);
}

TEST(Strobe, FindsAStrongImpactIfNothingIsWatched) {
  Scene scene = synthetic::MakeScene();
  scene.watch.clear();
  std::vector<Playback> runs;
  runs.push_back(Playback(synthetic::MakeRecording(6), scene, synthetic::MakeOracle()));
  EXPECT_DOUBLE_EQ(CollisionTime(runs), synthetic::kHitTick / 60.0);
}

TEST(Strobe, FindsTheWorstMomentIfNothingCollides) {
  Scene scene = synthetic::MakeScene();
  scene.watch.clear();
  Recording recording = synthetic::MakeRecording(0);
  recording.impacts.clear();
  recording.views[2][120].y[0] += 3;
  std::vector<Playback> runs;
  runs.push_back(Playback(recording, scene, synthetic::MakeOracle()));
  EXPECT_DOUBLE_EQ(CollisionTime(runs), 2);
}

TEST(Strobe, ShowsEarlierAndLaterPosesAtOnceTheEarlierOnesFainter) {
  std::vector<Playback> runs;
  runs.push_back(MakePlayback(0));
  StrobeOptions options{0.2, 1.2};
  options.every_ticks = 30;
  options.peer = 1;
  StrobePlan plan = PlanStrobe(runs, options);
  plan.min = {-18, -2};
  plan.max = {18, 10};
  plan.width_px = 1280;
  plan.height_px = 600;
  DrawList list(TestFont());
  DrawStrobe(list, runs, plan);
  const Image image = Rendered(list);
  const Colour solid = PeerColour(1);
  int full = 0, faint = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const int r = image.rgba[i], g = image.rgba[i + 1], b = image.rgba[i + 2];
    if (r == solid.r && g == solid.g && b == solid.b) ++full;
    if (r > solid.r + 20 && r < 225 && b > r + 15 && g > r && g < b) ++faint;
  }
  EXPECT_GT(full, 500);
  EXPECT_GT(faint, 500);
}

TEST(Strobe, AnEmptyWindowIsAnOperatorError) {
  std::vector<Playback> runs;
  runs.push_back(MakePlayback(0));
  EXPECT_THROW(PlanStrobe(runs, StrobeOptions{50, 51}), OperatorError);
  EXPECT_THROW(PlanStrobe(runs, StrobeOptions{2, 1}), OperatorError);
  EXPECT_THROW(PlanStrobe(runs, StrobeOptions{0, 1e9, 1}), OperatorError);
}

}  // namespace render_page_test
}  // namespace seam
