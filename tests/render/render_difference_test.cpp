/// Pictures of two runs over each other, and the colours that a scene gives its players.

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/scene/player_colours.h"
#include "render/canvas/palette.h"
#include "render/draw/draw_difference.h"
#include "render/frame.h"
#include "render/playback/peer_colour.h"
#include "tests/support/render_fixture.h"
#include "tests/support/render_synthetic.h"

namespace seam {
namespace render_difference_test {

using namespace synthetic;

Playback Late(int ticks) { return Playback(MakeRecording(ticks), MakeScene(), MakeOracle()); }

TEST(Difference, IsZeroForARunAndItselfAndGrowsWithTheDelay) {
  const Playback now = Late(0), late = Late(3), later = Late(12);
  EXPECT_EQ(ApartOf(now, now, 1, 0.5), 0);
  const double three = ApartOf(now, late, 1, 0.5), twelve = ApartOf(now, later, 1, 0.5);
  EXPECT_GT(three, 0.01);
  EXPECT_GT(twelve, 2 * three);
}

TEST(Difference, BodiesOfTheSecondHaveTheColourOfTheirDistance) {
  std::vector<Playback> runs;
  runs.push_back(Late(0));
  runs.push_back(Late(12));
  Page page = MakeDifference(runs, 1);
  ASSERT_EQ(page.panels.size(), 1u);
  page.look.pale = true;
  page.look.ghosts = page.look.trails = false;
  const double at_s = 0.5;
  const Image image = RenderedPage(page, at_s);
  const Moment here = runs[0].MomentAt(1, runs[0].TickAt(at_s));
  const Moment there = runs[1].MomentAt(1, runs[1].TickAt(at_s));
  const auto pale = runs[0].Find(here, 2), over = runs[1].Find(there, 2);
  ASSERT_TRUE(pale && over);
  const Colour heat = HeatColour((pale->pose.position - over->pose.position).norm());
  int pixels = 0;
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const std::uint8_t* p = image.At(x, y);
      pixels += std::abs(p[0] - heat.r) + std::abs(p[1] - heat.g) + std::abs(p[2] - heat.b) < 8;
    }
  EXPECT_GT(pixels, 100);
}

std::string WithColour(const std::string& line) {
  return "[[player]]\nname = \"ann\"\n" + line + "\n[[part]]\nname = \"a\"\nbox = [1, 1]\n";
}

TEST(PlayerColour, IsTheScenesOrThePalettesOrThePeers) {
  Recording recording = MakeRecording(0);
  std::string text = SceneText();
  text.insert(text.find("name = \"ann\""), "colour = \"#ff0080\"\n");
  text.insert(text.find("name = \"ben\""), "colour = 5\n");
  recording.room.scene_text = text;
  const Playback playback(recording, MakeOracle());
  EXPECT_TRUE((ColourOf(playback, 1) == Colour{255, 0, 128, 255}));
  EXPECT_TRUE(ColourOf(playback, 2) == PeerColour(5));
  EXPECT_TRUE(ColourOf(playback, 0) == PeerColour(0));
  EXPECT_TRUE(ColourOf(Late(0), 1) == PeerColour(1));
}

TEST(PlayerColour, InASceneIsHexOrAPaletteNumberOnly) {
  const auto of = [](const std::string& line) {
    return PlayerColours(ParseScene(WithColour(line), "s.toml")).at(0);
  };
  EXPECT_EQ(of("colour = \"#12aBef\""), "#12aBef");
  EXPECT_EQ(of("colour = 10"), "10");
  EXPECT_EQ(of(""), "");
  for (const char* wrong : {"colour = \"red\"", "colour = \"#12345\"", "colour = \"#12345g\"",
                            "colour = 0", "colour = 11", "colour = true", "colour = \"\""}) {
    EXPECT_THROW(ParseScene(WithColour(wrong), "s.toml"), OperatorError) << wrong;
  }
}

}  // namespace render_difference_test
}  // namespace seam
