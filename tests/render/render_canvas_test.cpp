#include <gtest/gtest.h>

#include <filesystem>

#include "common/base/check.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_canvas_test {

namespace fs = std::filesystem;

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

TEST(Canvas, LargeAreasCoverEarlierDrawings) {
  DrawList list(TestFont());
  list.Begin(200, 200);
  const Colour red{200, 0, 0, 255}, blue{0, 0, 200, 255}, black{0, 0, 0, 255};
  list.FillRect({0, 0, 200, 100}, red);
  list.FillRect({0, 0, 100, 200}, blue);  // over the left half of the red one
  list.Clip({0, 0, 200, 100});
  list.FillRect({10, 10, 20, 20}, black);
  list.NoClip();
  list.FillRect({100, 100, 100, 100}, red);  // nothing lies under it
  list.FillRect({0, 0, 90, 90}, red);        // the black one does
  const Image image = Rendered(list);
  EXPECT_TRUE(PixelAt(image, Vec2(150, 50)) == red);
  EXPECT_TRUE(PixelAt(image, Vec2(50, 150)) == blue);
  EXPECT_TRUE(PixelAt(image, Vec2(95, 50)) == blue);
  EXPECT_TRUE(PixelAt(image, Vec2(150, 150)) == red);
  EXPECT_TRUE(PixelAt(image, Vec2(20, 20)) == red);
}

TEST(Canvas, AnUnderlayHidesNoEarlierDrawing) {
  DrawList list(TestFont());
  list.Begin(200, 100);
  const Colour red{200, 0, 0, 255}, blue{0, 0, 200, 255}, black{0, 0, 0, 255};
  list.FillUnder({0, 0, 100, 100}, red);
  list.FillUnder({50, 0, 1, 100}, blue);  // over the red one
  list.Clip({0, 0, 100, 100});
  list.Fill({{20, 20}, {80, 20}, {80, 80}, {20, 80}}, black);
  list.FillUnder({0, 50, 100, 1}, blue);  // over the black one, which was there before
  list.NoClip();
  list.FillUnder({150, 0, 1, 100}, blue);  // where nothing is
  const Image image = Rendered(list);
  EXPECT_TRUE(PixelAt(image, Vec2(10, 10)) == red);
  EXPECT_TRUE(PixelAt(image, Vec2(50, 10)) == blue);
  EXPECT_TRUE(PixelAt(image, Vec2(50, 30)) == black);
  EXPECT_TRUE(PixelAt(image, Vec2(30, 50)) == blue);
  EXPECT_TRUE(PixelAt(image, Vec2(150, 10)) == blue);
  EXPECT_TRUE(PixelAt(image, Vec2(149, 10)) == kPaper);
}

TEST(Canvas, ADotHasTheShareOfEachPixelThatItsRadiusGives) {
  DrawList list(TestFont());
  list.Begin(40, 40);
  const Vec2 centre(20.3f, 19.6f);
  constexpr float kRadius = 3.3f;
  list.Disc(centre, kRadius, {0, 0, 0, 255});
  const Image image = Rendered(list);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const float away = (Vec2(x, y) + Vec2(0.5f, 0.5f) - centre).norm();
      const float cover = std::min(std::max(kRadius + 0.5f - away, 0.0f), 1.0f);
      EXPECT_NEAR(image.At(x, y)[0], (1 - cover) * kPaper.r, 2) << x << "," << y;
    }
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
  EXPECT_EQ(first.rgba, again.rgba);
}

TEST(RenderFont, NamesTheMissingFontInOneLine) {
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

TEST(RenderFont, ReadsUtf8AndSurvivesInvalidBytes) {
  EXPECT_EQ(Codepoints("aµ→"), (std::vector<std::uint32_t>{'a', 0xb5, 0x2192}));
  EXPECT_EQ(Codepoints("\xff"
                       "a\xc2"),
            (std::vector<std::uint32_t>{0xfffd, 'a', 0xfffd}));
  EXPECT_EQ(Codepoints("\xe2\x82"), (std::vector<std::uint32_t>{0xfffd, 0xfffd}));
  EXPECT_GT(TestFont().Width(TextStyle::kBody, "\xff\xfe 猫"), 0);
}

TEST(Png, DecodesToTheSamePixelsAndCarriesNoTime) {
  Folder folder;
  Image image;
  image.width_px = 37;
  image.height_px = 11;
  for (int i = 0; i < 37 * 11 * 4; ++i) {
    image.rgba.push_back(static_cast<std::uint8_t>(i % 4 == 3 ? 255 : i * 7 + i / 5));
  }
  for (const PngEffort effort : {PngEffort::kFast, PngEffort::kSmall}) {
    WritePng(folder / "a.png", image, effort, {{"Title", "Mauer → Wand"}});
    const Image read = ReadPng(folder / "a.png");
    EXPECT_EQ(read.width_px, 37);
    EXPECT_EQ(read.height_px, 11);
    EXPECT_EQ(read.rgba, image.rgba);
    EXPECT_NE(Content(folder / "a.png").find("Mauer → Wand"), std::string::npos);
    EXPECT_EQ(Content(folder / "a.png").find("tIME"), std::string::npos);
  }
}

TEST(Png, ADiskThatDoesNotTakeItIsAnOperatorError) {
  Image image;
  image.width_px = image.height_px = 200;
  image.rgba.resize(200 * 200 * 4);
  EXPECT_THROW(WritePng("/nowhere/a.png", image), OperatorError);
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THROW(WritePng("/dev/full", image), OperatorError);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace render_canvas_test
}  // namespace seam
