#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "common/base/check.h"
#include "render/canvas.h"
#include "render/commands.h"
#include "render/draw_body.h"
#include "render/draw_world.h"
#include "render/palette.h"
#include "render/png_writer.h"
#include "render/sequence.h"
#include "render/strobe.h"
#include "tests/render_synthetic.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// A folder of one test, gone afterwards.
class Folder {
 public:
  Folder() {
    path_ = ::testing::TempDir() + "seam-render-XXXXXX";
    EXPECT_NE(mkdtemp(path_.data()), nullptr);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  /// Names in it, sorted.
  std::vector<std::string> List() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(path_)) names.insert(entry.path().filename());
    return {names.begin(), names.end()};
  }

 private:
  std::string path_;
};

std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Playback MakePlayback(int late_ticks = 6) {
  return Playback(synthetic::MakeRecording(late_ticks), synthetic::MakeScene(),
                  synthetic::MakeOracle());
}

const Font& TestFont() {
  static const Font font(1);
  return font;
}

Image Rendered(const DrawList& list) {
  Image image;
  MakeCanvas(TestFont())->Draw(list, kPaper, &image);
  return image;
}

Image RenderedPage(const Page& page, double now_s) {
  DrawList list(TestFont());
  DrawPage(list, page, now_s);
  return Rendered(list);
}

/// The world of peer 1 at a tick on a page of its own.
Image RenderedWorld(const Playback& playback, double tick, Viewport* viewport, bool cull = true) {
  DrawList list(TestFont());
  list.Begin(800, 400);
  *viewport = SceneViewport({0, 0, 800, 400}, playback, 1, tick);
  WorldLook look;
  look.peer = 1;
  look.tick = tick;
  look.cull = cull;
  DrawWorld(list, *viewport, playback, look);
  return Rendered(list);
}

Colour PixelAt(const Image& image, const Vec2& px) {
  const std::uint8_t* p = image.At(static_cast<int>(px.x()), static_cast<int>(px.y()));
  return {p[0], p[1], p[2], 255};
}

/// Pixels of the rectangle that differ.
int Differences(const Image& a, const Image& b, int x0, int y0, int x1, int y1) {
  int count = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (!std::equal(a.At(x, y), a.At(x, y) + 3, b.At(x, y))) ++count;
  return count;
}

int Differences(const Image& a, const Image& b) {
  return Differences(a, b, 0, 0, a.width_px, a.height_px);
}

/// Runs seam-render; what it says on stderr goes to `said`.
int SeamRender(const std::vector<std::string>& arguments, std::string* said = nullptr) {
  std::vector<const char*> argv{"seam-render"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  ::testing::internal::CaptureStderr();
  const int status = RenderMain(static_cast<int>(argv.size()), argv.data());
  const std::string text = ::testing::internal::GetCapturedStderr();
  if (said != nullptr) *said = text;
  return status;
}

// --- canvas ---------------------------------------------------------------------------------

TEST(Canvas, FillsWholePixelsAndKeepsTheRestOfThePage) {
  DrawList list(TestFont());
  list.Begin(64, 48);
  list.Fill({{10, 10}, {30, 10}, {30, 20}, {10, 20}}, {200, 10, 20, 255});
  const Image image = Rendered(list);
  ASSERT_EQ(image.width_px, 64);
  ASSERT_EQ(image.height_px, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool inside = x >= 10 && x < 30 && y >= 10 && y < 20;
      const Colour expected = inside ? Colour{200, 10, 20, 255} : kPaper;
      ASSERT_EQ(PixelAt(image, Vec2(x, y)), expected) << x << "," << y;
    }
}

TEST(Canvas, ALineCoversItsWidthAndSharesItsEdgePixels) {
  DrawList list(TestFont());
  list.Begin(40, 20);
  // From y = 8.75 to 11.25: rows 9 and 10 full, rows 8 and 11 a quarter.
  list.Stroke({{0, 10}, {40, 10}}, false, {2.5f, {0, 0, 0, 255}, 0});
  const Image image = Rendered(list);
  const auto shade = [&](int y) { return static_cast<int>(image.At(20, y)[0]); };
  EXPECT_EQ(shade(7), kPaper.r);
  EXPECT_NEAR(shade(8), 0.75 * kPaper.r, 2);
  EXPECT_EQ(shade(9), 0);
  EXPECT_EQ(shade(10), 0);
  EXPECT_NEAR(shade(11), 0.75 * kPaper.r, 2);
  EXPECT_EQ(shade(12), kPaper.r);
}

TEST(Canvas, AClipKeepsEverythingInside) {
  DrawList list(TestFont());
  list.Begin(64, 64);
  list.Clip({16, 16, 32, 32});
  list.FillRect({0, 0, 64, 64}, {1, 2, 3, 255});
  list.Disc({16, 16}, 20, {250, 2, 3, 255});
  list.Text(0, 40, TextStyle::kTitle, "MMMMMMMM", {0, 255, 0, 255});
  const Image image = Rendered(list);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool inside = x >= 16 && x < 48 && y >= 16 && y < 48;
      ASSERT_EQ(PixelAt(image, Vec2(x, y)) == kPaper, !inside) << x << "," << y;
    }
}

TEST(Canvas, PagesOfDifferentSizesFollowEachOther) {
  const std::unique_ptr<Canvas> canvas = MakeCanvas(TestFont());
  DrawList list(TestFont());
  Image first, again;
  list.Begin(100, 50);
  list.Disc({50, 25}, 10, {0, 0, 0, 255});
  canvas->Draw(list, kPaper, &first);
  list.Begin(30, 70);
  canvas->Draw(list, kPaper, &again);
  EXPECT_EQ(again.width_px, 30);
  list.Begin(100, 50);
  list.Disc({50, 25}, 10, {0, 0, 0, 255});
  canvas->Draw(list, kPaper, &again);
  EXPECT_EQ(first.rgb, again.rgb);
}

TEST(RenderFont, SaysInOneLineWhichFontIsMissing) {
  try {
    const Font font(1, "", "/nowhere");
    FAIL() << "a font from nowhere";
  } catch (const OperatorError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("/nowhere/DejaVuSans.ttf"), std::string::npos) << line;
    EXPECT_NE(line.find("fonts-dejavu-core"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST(RenderFont, ReadsUtf8AndSurvivesWhatIsNot) {
  EXPECT_EQ(Codepoints("aµ→"), (std::vector<std::uint32_t>{'a', 0xb5, 0x2192}));
  EXPECT_EQ(Codepoints("\xff" "a\xc2"), (std::vector<std::uint32_t>{0xfffd, 'a', 0xfffd}));
  EXPECT_EQ(Codepoints("\xe2\x82"), (std::vector<std::uint32_t>{0xfffd, 0xfffd}));
  EXPECT_GT(TestFont().Width(TextStyle::kBody, "\xff\xfe 猫"), 0);
}

// --- PNG ------------------------------------------------------------------------------------

TEST(Png, DecodesToTheSamePixelsAndCarriesNoTime) {
  Folder folder;
  Image image;
  image.width_px = 37;
  image.height_px = 11;
  for (int i = 0; i < 37 * 11 * 3; ++i)
    image.rgb.push_back(static_cast<std::uint8_t>(i * 7 + i / 5));
  WritePng(folder / "a.png", image);
  const Image read = ReadPng(folder / "a.png");
  EXPECT_EQ(read.width_px, 37);
  EXPECT_EQ(read.height_px, 11);
  EXPECT_EQ(read.rgb, image.rgb);
  EXPECT_EQ(Content(folder / "a.png").find("tIME"), std::string::npos);
}

TEST(Png, ADiskThatDoesNotTakeItIsAnOperatorError) {
  Image image;
  image.width_px = image.height_px = 200;
  image.rgb.resize(200 * 200 * 3);
  EXPECT_THROW(WritePng("/nowhere/a.png", image), OperatorError);
  if (!fs::exists("/dev/full")) return;
  EXPECT_THROW(WritePng("/dev/full", image), OperatorError);
}

// --- world ----------------------------------------------------------------------------------

TEST(DrawWorld, ABoxColoursThePixelsWhereItIsInTheWorld) {
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
  const BodyLook remote = LookOf(2, kRoleRemote);
  int pale = 0;
  for (float x = -1; x <= 1; x += 0.05f)
    if (PixelAt(image, viewport.ToPx(shown + Vec2(x, 0.3f))) == remote.fill) ++pale;
  EXPECT_GT(pale, 10);
}

TEST(DrawWorld, RolesLookDifferentAndSoDoPeers) {
  std::set<std::string> looks;
  for (int peer = 0; peer < 8; ++peer)
    for (int role : {kRoleAuthority, kRoleSecondary, kRoleRemote}) {
      const Colour c = LookOf(peer, role).fill;
      looks.insert({static_cast<char>(c.r), static_cast<char>(c.g), static_cast<char>(c.b)});
    }
  EXPECT_EQ(looks.size(), 24u);
  EXPECT_FALSE(LookOf(1, kRoleSecondary).hatched);
  EXPECT_TRUE(LookOf(1, kRoleRemote).hatched);
}

TEST(DrawWorld, TheGhostAppearsOnlyWhereViewAndTruthPart) {
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
  EXPECT_GT(ink(MakePlayback(10)), ink(MakePlayback(0)) + 50);
}

TEST(DrawWorld, CullingChangesNoPixel) {
  Scene scene = synthetic::MakeScene();
  scene.camera.min = {-9, 0};   // cuts through the stack, the carts' ways and the wheel's
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

TEST(DrawWorld, CullingLeavesOutWhatIsFarAway) {
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

TEST(Viewport, TilesWidePanelsBelowEachOtherAndTallOnesBesideEachOther) {
  const std::vector<Rect> wide = Tile({0, 0, 1200, 600}, 2, 5, 10);
  EXPECT_EQ(wide[0].x, wide[1].x);
  EXPECT_LT(wide[0].bottom(), wide[1].y);
  const std::vector<Rect> tall = Tile({0, 0, 1200, 600}, 2, 0.8f, 10);
  EXPECT_EQ(tall[0].y, tall[1].y);
  EXPECT_NEAR(tall[1].right(), 1200, 0.01);
}

// --- playback -------------------------------------------------------------------------------

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
  recording.views[1].erase(31);                                       // one lost
  for (int tick = 61; tick < 100; ++tick) recording.views[1].erase(tick);   // a hole
  const Playback playback(recording, synthetic::MakeScene(), synthetic::MakeOracle());
  const auto x_at = [&](double tick) {
    return playback.Find(playback.MomentAt(1, tick), 1)->pose.position.x();
  };
  EXPECT_NEAR(x_at(31), synthetic::Truth(1, 31).position.x(), 1e-4);
  EXPECT_FLOAT_EQ(x_at(80), synthetic::Truth(1, 60).position.x());
  EXPECT_FLOAT_EQ(x_at(100), synthetic::Truth(1, 100).position.x());
}

TEST(Playback, KnowsWhoDrivesWhat) {
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
  // Peer 1 shows ben's cart 6 ticks late at 6.8 m/s, the server's stack right, its own things right.
  const double late_m = 6.8 * 6 / 60;
  const auto error = playback.ErrorAt(1, 40);
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR(*error, late_m / std::sqrt(7.0), 1e-4);
  EXPECT_FALSE(playback.ErrorAt(1, synthetic::kTicks + 1).has_value());
  EXPECT_EQ(MakePlayback(0).ErrorAt(-1, 40).value(), 0);
}

TEST(Playback, WithoutAnOracleThereAreNoErrorsAndNoGhosts) {
  const Playback playback(synthetic::MakeRecording(6), synthetic::MakeScene(), std::nullopt);
  EXPECT_FALSE(playback.ErrorAt(-1, 40).has_value());
  EXPECT_FALSE(playback.Truth(1, 40).has_value());
  EXPECT_TRUE(MakePage(playback, 0).curves.empty());
  EXPECT_GT(Differences(RenderedPage(MakePage(playback, 1), 0.7),
                        RenderedPage(MakePage(MakePlayback(), 1), 0.7)), 100);
}

// --- pages ----------------------------------------------------------------------------------

TEST(Page, IsNotBlank) {
  const Playback playback = MakePlayback();
  const Image image = RenderedPage(MakePage(playback, 1), 1.3);
  std::map<std::uint32_t, int> colours;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    ++colours[static_cast<std::uint32_t>(image.rgb[i]) << 16 |
              static_cast<std::uint32_t>(image.rgb[i + 1]) << 8 | image.rgb[i + 2]];
  EXPECT_GT(colours.size(), 100u);
  const int pixels = image.width_px * image.height_px;
  for (const auto& [colour, count] : colours) EXPECT_LT(count, pixels * 6 / 10) << colour;
}

TEST(Page, TheHeaderSaysWhatItIsTold) {
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
  EXPECT_GT(Differences(a, b, 900, 0, 1280, 56), 30);     // figures
  EXPECT_GT(Differences(a, b, 0, 620, 1280, 700), 100);   // strip
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
  const Image image = Rendered(list);
  // Decades from 1 mm to 10 cm on 100 px: 1 cm lies half way up.
  int red_row = -1;
  for (int y = 0; y < 142; ++y) {
    const Colour c = PixelAt(image, Vec2(200, y));
    if (c.r > 240 && c.g < 60 && c.b < 60 && red_row < 0) red_row = y;
  }
  EXPECT_NEAR(red_row, 22 + (142 - 42) / 2, 2);
}

// --- strobe ---------------------------------------------------------------------------------

TEST(Strobe, FindsTheWatchedCollision) {
  EXPECT_NEAR(CollisionTime(MakePlayback()), synthetic::kHitTick / 60.0, 1.01 / 60);
}

TEST(Strobe, FindsAStrongImpactWhereNothingIsWatched) {
  Scene scene = synthetic::MakeScene();
  scene.watch.clear();
  const Playback playback(synthetic::MakeRecording(6), scene, synthetic::MakeOracle());
  EXPECT_DOUBLE_EQ(CollisionTime(playback), synthetic::kHitTick / 60.0);
}

TEST(Strobe, ShowsEarlierAndLaterPosesAtOnceTheEarlierOnesFainter) {
  std::vector<Playback> runs;
  runs.push_back(MakePlayback(0));
  StrobeWishes wishes{0.2, 1.2};
  wishes.every_ticks = 30;
  wishes.peer = 1;
  StrobePlan plan = PlanStrobe(runs, wishes);
  plan.min = {-18, -2};
  plan.max = {18, 10};
  plan.width_px = 1280;
  plan.height_px = 600;
  DrawList list(TestFont());
  DrawStrobe(list, runs, plan);
  const Image image = Rendered(list);
  const Colour solid = PeerColour(1);
  int full = 0, faint = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const int r = image.rgb[i], g = image.rgb[i + 1], b = image.rgb[i + 2];
    if (r == solid.r && g == solid.g && b == solid.b) ++full;
    if (r > solid.r + 20 && r < 225 && b > r + 15 && g > r && g < b) ++faint;
  }
  EXPECT_GT(full, 500);
  EXPECT_GT(faint, 500);
}

TEST(Strobe, AnEmptyWindowIsAnOperatorError) {
  std::vector<Playback> runs;
  runs.push_back(MakePlayback(0));
  EXPECT_THROW(PlanStrobe(runs, StrobeWishes{50, 51}), OperatorError);
  EXPECT_THROW(PlanStrobe(runs, StrobeWishes{2, 1}), OperatorError);
}

// --- sequences ------------------------------------------------------------------------------

TEST(Sequence, WritesTheSameBytesInEveryRunAndWithAnyNumberOfThreads) {
  const Playback playback = MakePlayback();
  Page page = MakePage(playback, kViewAll);
  page.width_px = 640;
  page.height_px = 360;
  const Font font(ScaleOf(640, 360));
  const std::vector<double> times = FrameTimes(1, 1.5, 30);
  std::vector<std::vector<std::string>> runs;
  for (int threads : {1, 1, 2, 5}) {
    Folder folder;
    const OutputFolder output(folder / "frames", false);
    output.Prepare();
    int done = 0;
    WriteSequence(page, font, times, threads, output, [&done](int) { ++done; });
    EXPECT_EQ(done, 16);
    runs.emplace_back();
    for (int i = 0; i < 16; ++i) runs.back().push_back(Content(output.FramePath(i)));
    EXPECT_FALSE(fs::exists(output.FramePath(16)));
  }
  for (const auto& run : runs) EXPECT_TRUE(run == runs[0]);
  EXPECT_NE(runs[0][0], runs[0][15]);
  for (const std::string& bytes : runs[0]) EXPECT_GT(bytes.size(), 2000u);
}

TEST(Sequence, FramesFollowTheWantedMoments) {
  EXPECT_EQ(FrameTimes(0, 3, 30).size(), 91u);
  EXPECT_EQ(FrameTimes(1, 1, 30).size(), 1u);
  const std::vector<double> times = FrameTimes(0.5, 1.5, 30);
  ASSERT_EQ(times.size(), 31u);
  const Playback playback = MakePlayback();
  for (std::size_t i = 0; i < times.size(); ++i)   // 30 frames/s of 60 ticks/s: every other tick
    EXPECT_EQ(playback.TickAt(times[i]), 30 + 2 * static_cast<double>(i));
}

TEST(Sequence, AFrameIsThePageAtItsMoment) {
  Folder folder;
  const Playback playback = MakePlayback();
  const Page page = MakePage(playback, 1);
  const OutputFolder output(folder / "frames", false);
  output.Prepare();
  WriteSequence(page, TestFont(), FrameTimes(1.2, 1.3, 10), 2, output, [](int) {});
  EXPECT_EQ(ReadPng(output.FramePath(0)).rgb, RenderedPage(page, 1.2).rgb);
  EXPECT_EQ(ReadPng(output.FramePath(1)).rgb, RenderedPage(page, 1.3).rgb);
}

TEST(Sequence, AFrameThatCannotBeWrittenStopsItWithAnError) {
  Folder folder;
  const Playback playback = MakePlayback();
  const OutputFolder output(folder / "never-prepared", false);
  EXPECT_THROW(WriteSequence(MakePage(playback, 1), TestFont(), FrameTimes(0, 1, 10), 2, output,
                             [](int) {}),
               OperatorError);
}

TEST(OutputFolder, RefusesOtherPeoplesFilesAndReplacesItsOwnFrames) {
  Folder folder;
  const std::string path = folder / "frames";
  OutputFolder(path, false).Prepare();
  for (const char* name : {"/frame_00000.png", "/frame_00007.png"}) std::ofstream(path + name) << 1;
  OutputFolder(path, false).Prepare();
  EXPECT_TRUE(fs::is_empty(path));
  std::ofstream(path + "/thesis.txt") << "mine";
  EXPECT_THROW(OutputFolder(path, false), OperatorError);
  OutputFolder(path, true).Prepare();
  EXPECT_EQ(Content(path + "/thesis.txt"), "mine");
  EXPECT_THROW(OutputFolder(path + "/thesis.txt", true), OperatorError);
}

// --- command line ---------------------------------------------------------------------------

TEST(RenderProgram, OperatorsMistakesAreOneLineStatus2AndWriteNothing) {
  Folder folder;
  std::ofstream(folder / "not.lcm") << "no log at all";
  const std::string out = folder / "out", log = folder / "not.lcm", none = folder / "none.lcm";
  const std::vector<std::vector<std::string>> mistakes{
      {},
      {"--frobnicate"},
      {log},
      {"-o", out},
      {none, "-o", out},
      {log, "-o", out},
      {log, log, "-o", out},
      {"--compare", log, none, "-o", out},
      {log, "-o", out, "--fps", "0"},
      {log, "-o", out, "--fps", "many"},
      {log, "-o", out, "--size", "10x10"},
      {log, "-o", out, "--size", "1280x720x3"},
      {log, "-o", out, "--view", "nobody"},
      {log, "-o", out, "--from", "2", "--to", "1"},
      {log, "-o", out, "--every", "3"},
      {log, "-o", out, "--threads", "-1"},
      {"--strobe", log, "-o", out},
      {"--strobe", log, "-o", out + ".png"},
      {"--live", log, "-o", out},
      {"--live", "--strobe", "-o", out + ".png"},
  };
  for (const auto& mistake : mistakes) {
    std::string said, typed;
    for (const std::string& word : mistake) typed += " " + word;
    EXPECT_EQ(SeamRender(mistake, &said), 2) << typed;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << typed << ": " << said;
    EXPECT_EQ(said.rfind("seam-render: ", 0), 0u) << typed << ": " << said;
    EXPECT_EQ(folder.List(), std::vector<std::string>{"not.lcm"}) << typed;
  }
}

}  // namespace
}  // namespace seam
