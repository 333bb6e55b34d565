/// Nothing catches on the seams of floors and decks that are made of several shapes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/physics/world.h"
#include "tests/support/small_world.h"

namespace seam {
namespace outline_contacts_test {

std::string PartText(const std::string& name, const std::string& lines) {
  return "[[part]]\nname = \"" + name + "\"\n" + lines + "\n";
}

std::string Row(int count, double length, const std::string& more = "") {
  return PartText(
      "g", "box = [" + FloatDigits(length) + ", 1]\nposition = [" + FloatDigits(length / 2 - 20) +
               ", -0.5]\nanchored = true\nfriction = 0\n" + more + "repeat = {count = " +
               std::to_string(count) + ", step = [" + FloatDigits(length) + ", 0]}");
}

std::string Welds(int count, double length) {
  return "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"g.0\"\nb = \"g.1\"\nanchor = [" +
         FloatDigits(length - 20) + ", 0]\nrepeat = {count = " + std::to_string(count - 1) +
         ", step = [" + FloatDigits(length) + ", 0]}\n";
}

/// Each start has another place and speed between 12 and 19 m/s.
struct Start {
  double x, speed;
};
Start StartOf(int i) { return {-15 + 0.173 * i, 12 + 7.0 * i / 39}; }

std::string Thrown(const std::string& shape, const Start& start) {
  return PartText("b", shape + "\nfriction = 0\nposition = [" + FloatDigits(start.x) +
                           ", 4]\nvelocity = [" + FloatDigits(start.speed) + ", -3]");
}

/// Number of 40 starts after which the body has not kept the speed along the floor within `share`.
int Caught(const std::string& floor, const std::string& shape, const std::string& solver = "",
           double share = 1e-3, const std::string& top = "") {
  int caught = 0;
  for (int i = 0; i < 40; ++i) {
    const Start start = StartOf(i);
    const auto world = SmallWorld(floor + Thrown(shape, start), solver, top);
    Steps(world.get(), 240);
    const BodyState end = world->Read(0);
    const bool box = shape.rfind("box", 0) == 0;
    const bool kept = std::fabs(double{end.velocity.x()} - start.speed) < share * start.speed &&
                      (!box || std::fabs(end.angle) < 0.01f);
    if (!kept) ++caught;
  }
  return caught;
}

TEST(OutlineContacts, BoxesAndDiscsLandOnARowWithoutLoss) {
  for (const char* shape : {"box = [1, 1]", "box = [0.4, 2]", "circle = 0.5", "circle = 0.1"}) {
    EXPECT_EQ(Caught(Row(31, 4), shape), 0) << shape;
    EXPECT_EQ(Caught(Row(25, 8), shape), 0) << shape;
    EXPECT_EQ(Caught(Row(6, 20) + Welds(6, 20), shape), 0) << shape;
    EXPECT_EQ(Caught(Row(200, 0.5), shape), 0) << shape;
  }
}

TEST(OutlineContacts, TumblingThingsKeepTheirSpeedAlongTheFloor) {
  // No friction, so nothing pushes along x, whatever corner strikes.
  const char* const shapes[] = {"box = [1, 1]\nangle = 0.4\nspin = 3",
                                "wedge = [1, 0.6]\nangle = 0.4\nspin = -2",
                                "box = [0.2, 1.5]\nangle = 1\nspin = 6"};
  for (const std::string shape : shapes) {
    for (const std::string& floor : {Row(31, 4), Row(200, 0.5)}) {
      for (int i = 0; i < 40; i += 2) {
        const Start start = StartOf(i);
        const auto world = SmallWorld(floor + Thrown(shape, start));
        Steps(world.get(), 240);
        EXPECT_NEAR(world->Read(0).velocity.x(), start.speed, 1e-3 * start.speed) << shape << i;
      }
    }
  }
}

TEST(OutlineContacts, SettingsOfTheSolverDoNotMatter) {
  for (const char* solver : {"substeps = 4", "skin = 0.0025", "skin = 0.005\nsubsteps = 2",
                             "continuous = false", "faces = \"all\"", "tick_hz = 120"}) {
    EXPECT_EQ(Caught(Row(25, 8), "box = [1, 1]", solver), 0) << solver;
    EXPECT_EQ(Caught(Row(200, 0.5), "circle = 0.5", solver), 0) << solver;
  }
}

TEST(OutlineContacts, OverlapsGapsAndOtherMaterialsHaveNoSeamsEither) {
  const auto boxes = [](double length, double step, const std::string& more) {
    return PartText("g", "box = [" + FloatDigits(length) +
                             ", 1]\nposition = [-16, -0.5]\nanchored = true\nfriction = 0\n" +
                             more + "repeat = {count = 25, step = [" + FloatDigits(step) + ", 0]}");
  };
  const auto below = [](double step) {  // every second box is deeper, of another restitution
    return PartText("d",
                    "box = [4, 3]\nposition = [-20, -1.5]\nanchored = true\nfriction = 0\n"
                    "repeat = {count = 20, step = [" +
                        FloatDigits(2 * step) + ", 0]}") +
           PartText("e",
                    "box = [4, 1]\nposition = [-16, -0.5]\nanchored = true\nfriction = 0\n"
                    "restitution = 0.1\nrepeat = {count = 20, step = [" +
                        FloatDigits(2 * step) + ", 0]}");
  };
  const auto wedges = [] {  // triangles side by side, point up and point down in turn
    return PartText("u",
                    "polygon = [[-2, -1], [2, -1], [0, 1]]\nposition = [-20, -1]\n"
                    "anchored = true\nfriction = 0\nrepeat = {count = 40, step = [4, 0]}") +
           PartText("v",
                    "polygon = [[0, -1], [2, 1], [-2, 1]]\nposition = [-22, -1]\n"
                    "anchored = true\nfriction = 0\nrepeat = {count = 40, step = [4, 0]}");
  };
  for (const char* shape : {"box = [1, 1]", "circle = 0.5"}) {
    EXPECT_EQ(Caught(boxes(4.5, 4, ""), shape), 0) << shape << ", overlapping";
    EXPECT_EQ(Caught(boxes(3.997, 4, ""), shape), 0) << shape << ", gaps of 3 mm";
    EXPECT_EQ(Caught(below(4), shape), 0) << shape << ", deep and flat in turn";
    EXPECT_EQ(Caught(wedges(), shape), 0) << shape << ", wedges";
  }
}

TEST(OutlineContacts, ASlopeIsLikeOnePlane) {
  // Boxes turned by 0.2 rad in a row; gravity is turned with them, so that it is the flat case.
  const double angle = 0.2;
  const double c = std::cos(angle), s = std::sin(angle);
  const std::string floor = PartText(
      "g", "box = [4, 1]\nposition = [" + FloatDigits(-18 * c + 0.5 * s) + ", " +
               FloatDigits(-18 * s - 0.5 * c) + "]\nangle = 0.2\nanchored = true\nfriction = 0\n" +
               "repeat = {count = 31, step = [" + FloatDigits(4 * c) + ", " + FloatDigits(4 * s) +
               "]}");
  for (int i = 0; i < 40; ++i) {
    const Start start = StartOf(i);
    const auto world =
        SmallWorld(floor + PartText("b", "box = [1, 1]\nangle = 0.2\nfriction = 0\nposition = [" +
                                             FloatDigits(start.x * c - 4 * s) + ", " +
                                             FloatDigits(start.x * s + 4 * c) + "]\nvelocity = [" +
                                             FloatDigits(start.speed * c + 3 * s) + ", " +
                                             FloatDigits(start.speed * s - 3 * c) + "]"),
                   "", "gravity = [" + FloatDigits(10 * s) + ", " + FloatDigits(-10 * c) + "]");
    Steps(world.get(), 240);
    const BodyState end = world->Read(0);
    const double along = double{end.velocity.x()} * c + double{end.velocity.y()} * s;
    EXPECT_NEAR(along, start.speed, 1e-3 * start.speed) << i;
  }
}

TEST(OutlineContacts, ThingsLandOnAMovingDeckWithoutLoss) {
  // A deck of welded planks of 100 times the weight floats in space; what lands is pulled to it.
  const std::string deck =
      PartText("g",
               "box = [4, 1]\nposition = [-18, -0.5]\nfriction = 0\ndensity = 100\n"
               "repeat = {count = 20, step = [4, 0]}") +
      Welds(20, 4);
  for (const char* shape : {"box = [1, 1]", "circle = 0.5"}) {
    for (int i = 0; i < 40; ++i) {
      const Start start = StartOf(i);
      const std::string body =
          PartText("b", std::string(shape) + "\nfriction = 0\ndensity = 0.1\nposition = [" +
                            FloatDigits(start.x) + ", 2]\nvelocity = [" + FloatDigits(start.speed) +
                            ", -12]");
      const auto world = SmallWorld(deck + body, "faces = \"all\"", "gravity = [0, 0]");
      Steps(world.get(), 120);
      const BodyState end = world->Read(1);
      EXPECT_NEAR(double{end.velocity.x()}, start.speed, 2e-3 * start.speed) << shape << ", " << i;
      EXPECT_GT(double{end.position.y()}, 0.4) << shape << ", " << i;
    }
  }
}

TEST(OutlineContacts, EachStretchKeepsItsMaterial) {
  // From ice to felt: it slows down on the felt alone, by friction sqrt(0.25 · 0.25) and g.
  const std::string floor =
      PartText("ice", "box = [10, 1]\nposition = [-5, -0.5]\nanchored = true\nfriction = 0") +
      PartText("felt", "box = [40, 1]\nposition = [20, -0.5]\nanchored = true\nfriction = 0.25");
  const auto world = SmallWorld(floor + PartText("b",
                                                 "box = [0.5, 0.5]\nfriction = 0.25\n"
                                                 "position = [-8, 0.265]\nvelocity = [6, 0]"));
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).velocity.x(), 6, 1e-3);
  ASSERT_LT(world->Read(0).position.x(), -1);
  while (world->Read(0).position.x() < 0.25f) world->Step();
  const float there = world->Read(0).velocity.x();
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).velocity.x(), there - 2.5f, 0.05f);
}

TEST(OutlineContacts, AWallBesideAFloorStopsWhatRunsIntoIt) {
  const std::string room =
      Row(8, 4) + PartText("wall",
                           "box = [1, 5]\nposition = [5.5, 2.5]\nanchored = true\n"
                           "friction = 0\nrestitution = 0");
  for (const char* shape : {"box = [1, 1]", "circle = 0.5"}) {
    const auto world = SmallWorld(room + Thrown(shape, {-10, 15}));
    Steps(world.get(), 240);
    EXPECT_NEAR(world->Read(0).position.x(), 4.5, 0.03) << shape;
    EXPECT_NEAR(world->Read(0).velocity.x(), 0, 1e-3) << shape;
    EXPECT_NEAR(world->Read(0).position.y(), 0.5, 0.03) << shape;
  }
}

TEST(OutlineContacts, AGroundBearsBesideAnyNumberOfPosts) {
  for (const int posts : {0, 10, 20, 200}) {
    std::string text = PartText("ground", "box = [900, 1]\nposition = [0, -0.5]\nanchored = true");
    if (posts > 0) {
      text += PartText("post",
                       "box = [0.5, 1]\nposition = [20, 0.5]\nanchored = true\nrepeat = "
                       "{count = " +
                           std::to_string(posts) + ", step = [2, 0]}");
    }
    text += PartText("disc", "circle = 0.5\nposition = [-3, 0.7]");
    text += PartText("crate", "box = [1, 1]\nposition = [3, 0.7]");
    const auto world = SmallWorld(text);
    Steps(world.get(), 120);
    EXPECT_NEAR(world->Read(0).position.y(), 0.5f, 0.02f) << posts;
    EXPECT_NEAR(world->Read(1).position.y(), 0.5f, 0.02f) << posts;
  }
}

TEST(OutlineContacts, WithoutOneOfTheBoxesThereIsAHole) {
  // The outline is found anew: the body falls in, and stands against the hole's wall.
  for (const bool hole : {false, true}) {
    const auto world =
        SmallWorld(Row(12, 2) + PartText("b",
                                         "box = [1, 1]\nfriction = 0\nposition = [-18.5, 0.52]\n"
                                         "velocity = [2, 0]"));
    Steps(world.get(), 20);
    if (hole) world->Apply({Edit(RemoveEdit{4})});
    Steps(world.get(), 300);
    const BodyState end = world->Read(0);
    EXPECT_EQ(end.position.y() < -1, hole);
    EXPECT_EQ(std::fabs(end.velocity.x() - 2) < 2e-3f, !hole);
  }
}

TEST(OutlineContacts, TheHalvesOfADeckThatBreaksCollide) {
  const auto world =
      SmallWorld(PartText("g", "box = [2, 0.5]\nrepeat = {count = 4, step = [2, 0], glue = 200}"),
                 "", "gravity = [0, 0]");
  ASSERT_EQ(world->body_count(), 1);
  world->Apply({Edit(BreakEdit{1})});
  ASSERT_EQ(world->body_count(), 2);
  for (int body = 0; body < 2; ++body) {
    BodyState state = world->Read(body);
    state.velocity.x() = body == 0 ? 1.0f : -1.0f;
    world->Write(body, state);
  }
  Steps(world.get(), 120);
  EXPECT_GT(world->Read(1).position.x() - world->Read(0).position.x(), 3.98f);
}

TEST(OutlineContacts, AWorldThatGoesBackRepeatsItsBits) {
  const std::string text = Row(31, 4) + Thrown("box = [1, 1]", {-14.9, 13.11}) +
                           PartText("c",
                                    "circle = 0.3\nposition = [-3, 3]\nrepeat = {count = 9, "
                                    "step = [0.9, 0.1]}\nvelocity = [5, -9]");
  const auto world = SmallWorld(text), other = SmallWorld(text);
  Steps(world.get(), 40);
  Steps(other.get(), 40);
  const WorldSnapshot snapshot = world->Barrier();
  other->Barrier();
  Steps(world.get(), 60);
  const std::uint64_t hash = world->Hash();
  ASSERT_TRUE(world->Restore(snapshot).ok());
  Steps(world.get(), 60);
  EXPECT_EQ(world->Hash(), hash);
  Steps(other.get(), 60);
  EXPECT_EQ(other->Hash(), hash);
}

}  // namespace outline_contacts_test
}  // namespace seam
