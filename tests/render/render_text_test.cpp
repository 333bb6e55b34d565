/// Names, captions and trails of a picture cover nothing that matters.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/scene/assembly.h"
#include "render/draw/draw_hud.h"
#include "render/draw/text_places.h"
#include "render/page/document.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_text_test {

bool Cover(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

TEST(TextPlaces, GiveNoPlaceTwiceAndNoneOutsideThePanel) {
  const Rect panel{10, 20, 300, 120}, caption{10, 20, 100, 18};
  TextPlaces places(panel, {caption});
  std::vector<Rect> given{caption};
  // Forty names wanted at nearly one place: some are moved a little, the others are left out.
  int refused = 0;
  for (int i = 0; i < 40; ++i) {
    const Rect wanted{60 + static_cast<float>(i % 5), 30, 50, 16};
    const auto place = places.Place(wanted);
    if (!place) {
      ++refused;
      continue;
    }
    EXPECT_LE(std::abs(place->x - wanted.x), wanted.width);
    EXPECT_LE(std::abs(place->y - wanted.y), 2 * wanted.height);
    EXPECT_GE(place->x, panel.x);
    EXPECT_GE(place->y, panel.y);
    EXPECT_LE(place->right(), panel.right());
    EXPECT_LE(place->bottom(), panel.bottom());
    for (const Rect& other : given) EXPECT_FALSE(Cover(*place, other));
    given.push_back(*place);
  }
  EXPECT_GE(given.size(), 5u);
  EXPECT_GT(refused, 0);
}

TEST(TextPlaces, LeaveAFreePlaceAsItIs) {
  TextPlaces places({0, 0, 300, 120}, {});
  const auto place = places.Place({40, 50, 60, 16});
  ASSERT_TRUE(place.has_value());
  EXPECT_EQ(place->x, 40);
  EXPECT_EQ(place->y, 50);
}

TEST(CornerTexts, DoNotCoverEachOtherInANarrowPanel) {
  DrawList list(TestFont());
  list.Begin(800, 400);
  for (const float width : {120.0f, 200.0f, 300.0f, 700.0f}) {
    const std::vector<Rect> areas = CornerAreas(
        list, {0, 0, width, 200}, {"12.34 s  buffer · rollback", "error 0.2 mm", kInk, "a note"});
    for (std::size_t i = 0; i < areas.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(Cover(areas[i], areas[j])) << width;
    if (width > 600) {
      EXPECT_EQ(areas[0].y, areas[1].y);
    }
  }
}

TEST(Trails, OneBodyOfEachMechanismLeads) {
  for (const char* name : {"crossing", "playground", "harbour", "dockside", "wall"}) {
    const Scene scene = LoadScene(std::string("scenes/") + name + ".toml");
    const Composition made = Compose(scene);
    std::vector<int> leaders(made.mechanisms.size());
    for (const BodyShapes& body : ShapesOf(scene, made, false)) {
      const int index = made.assembly_of_part[static_cast<std::size_t>(body.id)];
      const int mechanism = made.assemblies[static_cast<std::size_t>(index)].mechanism;
      leaders[static_cast<std::size_t>(mechanism)] += body.leads ? 1 : 0;
    }
    EXPECT_EQ(std::count(leaders.begin(), leaders.end(), 1),
              static_cast<std::ptrdiff_t>(leaders.size()))
        << name;
  }
}

TEST(Trails, TheCarHasOneRowOfDotsUnlessAllPartsAreAskedFor) {
  const Scene scene = LoadScene("scenes/crossing.toml");
  const Composition made = Compose(scene);
  const std::vector<BodyShapes> bodies = ShapesOf(scene, made, false);
  const auto leads = [](const BodyShapes& body) { return body.leads; };
  EXPECT_EQ(bodies.size(), 4u);  // chassis, two wheels, brick
  EXPECT_EQ(std::count_if(bodies.begin(), bodies.end(), leads), 2);
  const auto chassis = std::find_if(bodies.begin(), bodies.end(),
                                    [](const BodyShapes& b) { return b.owner_player == 0; });
  ASSERT_NE(chassis, bodies.end());
  EXPECT_TRUE(chassis->leads);
}

/// Returns the number of pixels of a colour in rows from y0 on.
int PixelsOf(const Image& image, Colour colour, int y0) {
  int count = 0;
  for (int y = y0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x)
      count += PixelAt(image, Vec2(static_cast<float>(x), static_cast<float>(y))) == colour ? 1 : 0;
  return count;
}

TEST(Legend, StaysInItsAreaAndExplainsThePatternsWhateverTheNames) {
  Recording recording = synthetic::MakeRecording(6);
  Scene scene = synthetic::MakeScene();
  const auto views = recording.views.at(1);
  for (int peer = 3; peer <= 9; ++peer) recording.views[peer] = views;
  for (std::size_t i = 0; i < scene.players.size(); ++i) {
    scene.players[i].name = std::string(20, static_cast<char>('a' + i));
  }
  const Playback playback(std::move(recording), std::move(scene), synthetic::MakeOracle());
  EXPECT_EQ(playback.peers().size(), 10u);
  for (const float width : {520.0f, 640.0f, 900.0f, 1240.0f, 2500.0f}) {
    const Rect area{20, 10, width, 26};
    DrawList list(TestFont());
    list.Begin(static_cast<int>(width) + 900, 50);
    DrawLegend(list, area, playback, {}, true);
    float right = 0;
    int sparks = 0;
    for (const auto& vertex : list.vertices()) {
      right = std::max(right, vertex.x);
      sparks += vertex.colour == kSpark ? 1 : 0;
    }
    EXPECT_LE(right, area.right() + 1) << width;
    EXPECT_GT(sparks, 0) << width << ": the mark of an impact";
  }
}

TEST(CornerTexts, StayInANarrowPanel) {
  DrawList list(TestFont());
  list.Begin(800, 400);
  const CornerTexts texts{"12.34 s  view of red-of-the-long-name", "error 0.2 mm", kInk, "a note"};
  for (const float width : {60.0f, 120.0f, 200.0f, 300.0f}) {
    for (const Rect& area : CornerAreas(list, {10, 0, width, 200}, texts)) {
      EXPECT_LE(area.right(), 10 + width) << width;
    }
    for (const Rect& area :
         CornerAreas(list, {10, 0, width, 24}, {"12.34 s  view", "error", {}, ""})) {
      EXPECT_LE(area.bottom(), 24) << width << ": in a flat one";
    }
  }
}

TEST(Damage, IsSaidInPicturesAndPages) {
  Recording recording = synthetic::MakeRecording(6);
  recording.damage.push_back({12, 14, false, false, false, {"SEAM.main.view.0"}});
  const std::string says = "ticks 12 to 14 are damaged";
  std::vector<Playback> playbacks;
  playbacks.emplace_back(std::move(recording), synthetic::MakeScene(), synthetic::MakeOracle());
  playbacks.push_back(MakePlayback());
  EXPECT_EQ(MakePage(playbacks[0], 1).subtitle.rfind("damage: " + says + "  ·  mode ", 0), 0u)
      << MakePage(playbacks[0], 1).subtitle;
  EXPECT_EQ(MakePage(playbacks[1], 1).subtitle.find("damage"), std::string::npos);
  EXPECT_NE(MakeComparison(playbacks, 1).subtitle.find(": " + says), std::string::npos);
  const PageBytes data = PageData({{"a", &playbacks[0]}, {"b", &playbacks[1]}});
  const std::string text(data.begin(), data.end());
  EXPECT_NE(text.find("\"damage\":[\"" + says + " (SEAM.main.view.0)\"]"), std::string::npos);
  EXPECT_NE(text.find("\"damage\":[]"), std::string::npos);
}

TEST(Sheet, HasALegendBelowItsMoments) {
  const Playback playback = MakePlayback();
  const Page page = MakePage(playback, 1);
  DrawList list(TestFont());
  DrawSheet(list, page, 4);
  const Image image = Rendered(list);
  const int legend = image.height_px - 24;
  EXPECT_GT(PixelsOf(image, PeerColour(1), legend), 50);
  EXPECT_GT(PixelsOf(image, PeerColour(2), legend), 50);
}

TEST(Sheet, SeveralRunsAreSideBySideAtEachMoment) {
  std::vector<Playback> playbacks;
  playbacks.push_back(MakePlayback(2));
  playbacks.push_back(MakePlayback(20));
  const Page page = MakeComparison(playbacks, 1);
  DrawList list(TestFont());
  DrawSheet(list, page, 3);
  const Image image = Rendered(list);
  // Each run's caption has its colour: in every row of panels as many of one run as of the other.
  const auto count = [&](Colour colour) { return PixelsOf(image, colour, 0); };
  EXPECT_EQ(count(RunColour(0)), count(RunColour(1)));
  EXPECT_GT(count(RunColour(0)), 3 * 30);
}

}  // namespace render_text_test
}  // namespace seam
