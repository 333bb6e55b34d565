/// Penetration, joint drift and energy of states with answers known by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "common/base/random.h"
#include "common/measure/energy.h"
#include "common/measure/joint_drift.h"
#include "common/measure/overlap.h"
#include "common/physics/world.h"

namespace seam {
namespace measure_geometry_test {

struct Meters {
  explicit Meters(const std::string& text)
      : scene(ParseScene(text, "test.toml")),
        composition(Compose(scene)),
        overlap(scene, composition),
        joints(scene, composition),
        energy(scene, composition) {}
  /// The scene's own states at tick 0.
  std::vector<BodyState> Start() const {
    std::vector<BodyState> states;
    for (const Assembly& assembly : composition.assemblies) {
      if (assembly.anchored) continue;
      const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
      states.push_back({root.position, root.angle, root.velocity, root.spin});
    }
    return states;
  }
  double Deepest() const { return overlap.Deepest(Start()); }

  Scene scene;
  Composition composition;
  OverlapMeter overlap;
  JointMeter joints;
  EnergyMeter energy;
};

std::string Body(const std::string& name, const std::string& rest) {
  return "[[part]]\nname = \"" + name + "\"\n" + rest + "\n";
}

constexpr double kRound = 1e-6;  // the scenes' numbers are floats, m

TEST(Overlap, TwoBoxesOverlapByTheShortestWayOut) {
  const auto boxes = [](const std::string& second) {
    return Meters(Body("a", "box = [2, 1]") + Body("b", "box = [1, 1]\n" + second)).Deepest();
  };
  EXPECT_NEAR(boxes("position = [1.375, 0.25]"), 0.125, kRound);  // out to the right
  EXPECT_NEAR(boxes("position = [0.25, 0.75]"), 0.25, kRound);    // up
  EXPECT_EQ(boxes("position = [1.5, 0]"), 0);                     // they touch
  EXPECT_EQ(boxes("position = [1.6, 1.1]"), 0);
  // A corner that points down, 0.1 below the top.
  EXPECT_NEAR(boxes("angle = 0.785398163\nposition = [0, 1.10710678]"), 0.1, kRound);
  // Boxes of bounding boxes that overlap, apart along the diagonal.
  EXPECT_EQ(boxes("angle = 0.785398163\nposition = [1.4, 0.9]"), 0);
}

TEST(Overlap, CirclesAreExactOutsideAndInside) {
  const std::string a = Body("a", "circle = 0.5");
  EXPECT_NEAR(Meters(a + Body("b", "circle = 1\nposition = [0.9, 1.2]")).Deepest(), 0, kRound);
  EXPECT_NEAR(Meters(a + Body("b", "circle = 1\nposition = [0.6, 0.8]")).Deepest(), 0.5, kRound);
  const std::string box = Body("box", "box = [4, 2]");
  const auto in_box = [&](const std::string& at) {
    return Meters(box + Body("ball", "circle = 0.5\nposition = " + at)).Deepest();
  };
  EXPECT_NEAR(in_box("[0, 1.25]"), 0.25, kRound);    // on the face
  EXPECT_NEAR(in_box("[2.3, 1.4]"), 0, kRound);      // touches the corner
  EXPECT_NEAR(in_box("[2.15, 1.2]"), 0.25, kRound);  // on the corner
  EXPECT_NEAR(in_box("[1.5, 0.25]"), 1.0, kRound);   // its centre inside
}

TEST(Overlap, CapsulesOverlapByTheirRadiiAroundTheirCentreLines) {
  const std::string lying = Body("a", "capsule = [2, 0.5]");
  const auto with = [&](const std::string& other) {
    return Meters(lying + Body("b", other)).Deepest();
  };
  EXPECT_NEAR(with("circle = 0.5\nposition = [0.5, 0.75]"), 0.25, kRound);  // on its side
  EXPECT_NEAR(with("circle = 0.5\nposition = [1.6, 0.6]"), 1 - std::sqrt(0.72), kRound);  // end
  EXPECT_EQ(with("circle = 0.5\nposition = [1.8, 0.7]"), 0);
  EXPECT_NEAR(with("box = [1, 1]\nposition = [0, 0.75]"), 0.25, kRound);
  EXPECT_NEAR(with("box = [1, 1]\nposition = [1.8, 0.8]"), 0.5 - std::hypot(0.3, 0.3), kRound);
  EXPECT_NEAR(with("capsule = [2, 0.5]\nposition = [0, 0.9]"), 0.1, kRound);  // side by side
  EXPECT_NEAR(with("capsule = [2, 0.5]\nposition = [0.5, 1.8]\nangle = 1.57079633"), 0.2, kRound);
  const std::string ground = Body("ground", "chain = [[-9, 0], [9, 0]]");
  EXPECT_NEAR(Meters(ground + Body("b", "capsule = [2, 0.5]\nposition = [0, 0.45]")).Deepest(),
              0.05, kRound);
  const std::string edge = Body("edge", "segment = [[-9, 0], [9, 0]]");
  for (const char* at : {"[0, 0.45]", "[0, -0.45]"}) {
    const Meters m(edge + Body("b", std::string("capsule = [2, 0.5]\nposition = ") + at));
    EXPECT_NEAR(m.Deepest(), 0.05, kRound) << "a segment is solid from both sides";
  }
}

TEST(Overlap, PolygonsCountEitherWayRoundAndBeneathATurnedRoot) {
  const std::string box = Body("box", "box = [1, 1]\nposition = [10.4, 5]");
  for (const char* points : {"[[0, -1], [1, 0], [0, 1]]", "[[0, 1], [1, 0], [0, -1]]"}) {
    const Meters m(Body("wedge", std::string("position = [9, 5]\npolygon = ") + points) + box);
    EXPECT_NEAR(m.Deepest(), 0.1, kRound) << points;
    // Turned by half a turn about its own frame it points away.
    std::vector<BodyState> states = m.Start();
    states[0].angle = 3.14159265f;
    EXPECT_EQ(m.overlap.Deepest(states), 0) << points;
  }
  // An arm that is welded to a turned root: only the arm reaches.
  const Meters m(Body("root", "box = [2, 2]\nangle = 1.57079633\ndensity = 5") +
                 Body("arm", "box = [4, 0.5]\nposition = [2, 0]") +
                 Body("far", "box = [1, 1]\nposition = [4.25, 0]") +
                 "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"root\"\nb = \"arm\"\n");
  EXPECT_NEAR(m.Deepest(), 0.25, kRound);
  std::vector<BodyState> turned = m.Start();
  turned[0].angle += 1.57079633f;
  EXPECT_EQ(m.overlap.Deepest(turned), 0);
}

TEST(Overlap, BodiesThatDoNotCollideDoNotOverlap) {
  const std::string at = "box = [1, 1]\n";
  EXPECT_EQ(Meters(Body("a", at + "group = -3") + Body("b", at + "group = -3")).Deepest(), 0);
  EXPECT_EQ(Meters(Body("a", at + "group = 3") + Body("b", at + "group = 3")).Deepest(), 1);
  EXPECT_EQ(Meters(Body("a", at + "group = -3") + Body("b", at + "group = -4")).Deepest(), 1);
  EXPECT_EQ(Meters(Body("a", at + "anchored = true") + Body("b", at + "anchored = true") +
                   Body("c", "circle = 1\nposition = [9, 9]"))
                .Deepest(),
            0);
  EXPECT_EQ(Meters(Body("a", at + "anchored = true") + Body("b", at)).Deepest(), 1);
  const std::string pin = "[[joint]]\nname = \"j\"\nkind = \"revolute\"\na = \"a\"\nb = \"b\"\n";
  EXPECT_EQ(Meters(Body("a", at) + Body("b", at) + pin).Deepest(), 0);
  EXPECT_EQ(Meters(Body("a", at) + Body("b", at) + pin + "collide = true").Deepest(), 1);
  const std::string weld = "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"a\"\nb = \"b\"\n";
  EXPECT_EQ(Meters(Body("a", at) + Body("b", at) + weld).Deepest(), 0);
  EXPECT_EQ(
      Meters("[solver]\nwelds = \"joint\"\n" + Body("a", at) + Body("b", at) + weld).Deepest(), 0);
}

/// A ground of many short pieces with a ridge at x = 0 and a cliff at x = 10.
std::string Terrain() {
  std::string points;
  for (int i = -40; i < 0; ++i) points += "[" + std::to_string(i / 4.0) + ", 0], ";
  return Body("ground", "chain = [" + points + "[-1e-1, 0], [0, 1], [0.1, 0], [10, 0], [10, -5]]");
}

double InTerrain(const std::string& body) {
  return Meters(Terrain() + Body("body", body)).Deepest();
}

TEST(Overlap, InTerrainIsTheDepthBelowTheLine) {
  EXPECT_NEAR(InTerrain("box = [1, 1]\nposition = [-5, 0.375]"), 0.125, kRound);
  EXPECT_NEAR(InTerrain("box = [1, 1]\nposition = [5, 0.375]"), 0.125, kRound);
  EXPECT_EQ(InTerrain("box = [1, 1]\nposition = [-5, 0.5]"), 0);
  EXPECT_NEAR(InTerrain("circle = 0.5\nposition = [-5, 0.4]"), 0.1, kRound);
  EXPECT_NEAR(InTerrain("circle = 0.5\nposition = [-5.1, -0.1]"), 0.6, kRound);  // centre below
  EXPECT_NEAR(InTerrain("box = [1, 1]\nposition = [5, -0.4]"), 0.9, kRound);  // its top looks out
}

TEST(Overlap, InTerrainKnowsRidgesAndCliffs) {
  // The ridge's point is 0.05 inside the bottom of a wide box, and a wide circle.
  EXPECT_NEAR(InTerrain("box = [3, 1]\nposition = [0, 1.45]"), 0.05, kRound);
  EXPECT_NEAR(InTerrain("circle = 2\nposition = [0, 2.95]"), 0.05, kRound);
  // Overhanging the cliff, slightly turned either way: not the length of the overhang.
  EXPECT_NEAR(InTerrain("box = [2, 1]\nposition = [10, 0.49]"), 0.01, kRound);
  EXPECT_LT(InTerrain("box = [2, 1]\nposition = [10, 0.5]\nangle = 0.02"), 0.03);
  EXPECT_LT(InTerrain("box = [2, 1]\nposition = [10, 0.5]\nangle = -0.02"), 0.03);
  EXPECT_NEAR(InTerrain("circle = 0.5\nposition = [10.3, 0.3]"), 0.5 - std::sqrt(0.18), kRound);
  // Against the cliff's wall.
  EXPECT_NEAR(InTerrain("box = [1, 1]\nposition = [10.4, -2]"), 0.1, kRound);
  // Leaning on the ridge's flank: the way out is back, not through the ridge.
  EXPECT_LT(InTerrain("circle = 0.3\nposition = [-0.32, 0.7]"), 0.06);
}

TEST(Overlap, FarBelowTerrainAndBeyondItsEndsIsOpen) {
  EXPECT_NEAR(InTerrain("circle = 0.25\nposition = [5, -0.5]"), 0.75, kRound);  // just through
  EXPECT_EQ(InTerrain("circle = 0.25\nposition = [5, -3]"), 0);                 // under a bridge
  EXPECT_EQ(InTerrain("circle = 0.25\nposition = [-10.2, -0.1]"), 0);
  EXPECT_EQ(InTerrain("box = [0.5, 0.5]\nposition = [-10.3, -0.3]"), 0);
}

TEST(Overlap, IsTheDeepestOfAllPairs) {
  Random random(20);
  for (const double height : {2.0, 40.0}) {  // a sweep along x, and one along y
    std::vector<std::string> bodies;
    for (int i = 0; i < 24; ++i) {
      const std::string shape = i % 3 == 0   ? "circle = 0.6"
                                : i % 3 == 1 ? "box = [2, 0.4]"
                                             : "polygon = [[0, 0], [1, 0], [0, 1]]";
      bodies.push_back(Body("b" + std::to_string(i),
                            shape + "\nposition = [" + std::to_string(random.Uniform(-6, 6)) +
                                ", " + std::to_string(random.Uniform(-0.2, height)) +
                                "]\nangle = " + std::to_string(random.Uniform(-3, 3))));
    }
    std::string all = Terrain();
    double deepest = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      all += bodies[i];
      deepest = std::max(deepest, Meters(Terrain() + bodies[i]).Deepest());
      for (std::size_t k = 0; k < i; ++k) {
        deepest = std::max(deepest, Meters(bodies[i] + bodies[k]).Deepest());
      }
      EXPECT_EQ(Meters(all).Deepest(), deepest) << i;
    }
    EXPECT_GT(deepest, 0.1);
  }
}

TEST(Overlap, IsInfiniteForANonFiniteState) {
  const Meters m(Body("a", "box = [1, 1]") + Body("b", "box = [1, 1]\nposition = [5, 0]"));
  std::vector<BodyState> states = m.Start();
  states[1].position.x() = std::nanf("");
  EXPECT_EQ(m.overlap.Deepest(states), std::numeric_limits<double>::infinity());
  EXPECT_EQ(m.joints.Worst(states), std::numeric_limits<double>::infinity());
}

// ---- joints

std::string TwoBoxes() {
  return Body("a", "box = [1, 1]\nangle = 0.5\nposition = [1, 2]") +
         Body("b", "box = [1, 1]\nposition = [3, 2]");
}

double DriftAfter(const std::string& text, const Vec2& shift, float turn = 0) {
  const Meters m(text);
  std::vector<BodyState> states = m.Start();
  EXPECT_NEAR(m.joints.Worst(states), 0, kRound);
  states.back().position += shift;
  states.back().angle += turn;
  return m.joints.Worst(states);
}

TEST(JointDrift, IsTheDistanceBetweenTheAnchors) {
  const std::string pin = TwoBoxes() +
                          "[[joint]]\nname = \"j\"\nkind = \"revolute\"\na = \"a\"\nb = \"b\"\n"
                          "anchor = [2, 2]\n";
  EXPECT_NEAR(DriftAfter(pin, {0.3f, 0.4f}), 0.5, kRound);
  // Turned about its own middle by a half turn, the anchor 1 m to its left goes 2 m.
  EXPECT_NEAR(DriftAfter(pin, {0, 0}, 3.14159265f), 2, kRound);
  const std::string to_ground = Body("a", "box = [1, 1]\nangle = 0.5\nanchored = true") +
                                Body("b", "box = [1, 1]\nposition = [3, 2]") +
                                "[[joint]]\nname = \"j\"\nkind = \"revolute\"\na = \"a\"\n"
                                "b = \"b\"\nanchor = [2, 2]\n";
  EXPECT_NEAR(DriftAfter(to_ground, {0, -0.25f}), 0.25, kRound);
}

TEST(JointDrift, CountsWeldsOnlyWhereTheyAreJoints) {
  const std::string weld =
      TwoBoxes() + "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"a\"\nb = \"b\"\n";
  EXPECT_NEAR(DriftAfter("[solver]\nwelds = \"joint\"\n" + weld, {0.3f, 0.4f}), 0.5, kRound);
  EXPECT_EQ(DriftAfter(weld, {0.3f, 0.4f}), 0);  // one body
}

TEST(JointDrift, IsAcrossTheAxisOfAWheelUnlessItIsRigid) {
  const std::string wheel = TwoBoxes() +
                            "[[joint]]\nname = \"j\"\nkind = \"wheel\"\na = \"a\"\nb = \"b\"\n"
                            "axis = [3, 4]\n";
  EXPECT_NEAR(DriftAfter(wheel + "frequency = 4", {0.3f, 0.4f}), 0, kRound);
  EXPECT_NEAR(DriftAfter(wheel + "frequency = 4", {-0.4f, 0.3f}), 0.5, kRound);
  EXPECT_NEAR(DriftAfter(wheel, {0.3f, 0.4f}), 0.5, kRound);
}

TEST(JointDrift, IsTheStretchOfARigidDistanceAndZeroForASpring) {
  const std::string rod =
      TwoBoxes() + "[[joint]]\nname = \"j\"\nkind = \"distance\"\na = \"a\"\nb = \"b\"\n";
  EXPECT_NEAR(DriftAfter(rod, {0.25f, 0}), 0.25, kRound);
  EXPECT_NEAR(DriftAfter(rod, {-0.25f, 0}), 0.25, kRound);
  EXPECT_NEAR(DriftAfter(rod, {-2, 2}), 0, kRound);  // swung, not stretched
  EXPECT_EQ(DriftAfter(rod + "frequency = 2", {0.25f, 0}), 0);
}

// ---- energy

TEST(Energy, IsKineticAndPotentialOfTheCentreOfMass) {
  const Meters m("gravity = [0, -10]\n" +
                 Body("a",
                      "box = [2, 1]\ndensity = 3\nposition = [1, 4]\nvelocity = [3, -4]\n"
                      "spin = 2"));
  // 6 kg: 75 J of speed, 5/2 kg m^2 of inertia: 5 J, and 240 J of height.
  EXPECT_NEAR(m.energy.Of(m.Start()), 75 + 5 + 240, 1e-4);
  EXPECT_EQ(MechanicalEnergy(m.scene, m.composition, m.Start()), m.energy.Of(m.Start()));
  // 1 kg at 0 and 3 kg at 4 m, welded and turned upright: the centre is 1 m above or below the
  // root's.
  const Meters bar(Body("low", "box = [1, 1]") +
                   Body("high", "box = [1, 1]\nposition = [0, 4]\ndensity = 3") +
                   "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"low\"\nb = \"high\"\n");
  std::vector<BodyState> states = bar.Start();
  EXPECT_NEAR(bar.energy.Of(states), 4 * 10 * 3, 1e-4);
  states[0].angle = 3.14159265f;
  EXPECT_NEAR(bar.energy.Of(states), 4 * 10 * 5, 1e-4);
}

TEST(Energy, SpringsStoreHalfTheStiffnessTimesTheStretchSquared) {
  const auto stored = [](const std::string& joint, const Vec2& shift) {
    const Meters m("gravity = [0, 0]\n" + Body("a", "box = [1, 1]\nposition = [1, 2]") +
                   Body("b", "box = [1, 1]\nposition = [3, 2]\ndensity = 3") +
                   "[[joint]]\nname = \"j\"\na = \"a\"\nb = \"b\"\nfrequency = 2\n" + joint);
    std::vector<BodyState> states = m.Start();
    EXPECT_NEAR(m.energy.Of(states), 0, kRound);
    states[1].position += shift;
    return m.energy.Of(states);
  };
  const double stiffness = 0.75 * (4 * M_PI) * (4 * M_PI);  // of 1 and 3 kg at 2 Hz
  EXPECT_NEAR(stored("kind = \"distance\"", {0.5f, 0}), stiffness / 8, 1e-4);
  EXPECT_NEAR(stored("kind = \"distance\"", {-2, 2}), 0, 1e-4);
  EXPECT_NEAR(stored("kind = \"wheel\"\naxis = [0, 1]", {0.3f, 0.5f}), stiffness / 8, 1e-4);
}

TEST(Energy, EqualsTheWorldsEnergyWithoutSprings) {
  const Scene scene = LoadScene("scenes/wall.toml");
  Scene without = scene;
  for (Joint& joint : without.joints) joint.frequency_hz = 0;
  World world(without);
  const EnergyMeter meter(without, world.composition());
  for (int tick = 0; tick < 60; ++tick) world.Step();
  std::vector<BodyState> states;
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  EXPECT_NEAR(meter.Of(states), world.Energy(), 1e-6 * std::abs(world.Energy()));
}

TEST(Energy, IsConservedForABouncingSpring) {
  const Meters m("gravity = [0, -10]\n[solver]\ntick_hz = 960\nsubsteps = 8\n" +
                 Body("roof", "box = [1, 1]\nposition = [0, 4]\nanchored = true") +
                 Body("bob", "box = [1, 1]\n") +
                 "[[joint]]\nname = \"j\"\nkind = \"distance\"\na = \"roof\"\nb = \"bob\"\n"
                 "frequency = 1\ndamping_ratio = 0\n");
  World world(m.scene);
  const double start = m.energy.Of({world.Read(0)});
  double lowest = 0;
  for (int tick = 0; tick < 960; ++tick) {
    world.Step();
    lowest = std::min(lowest, double{world.Read(0).position.y()});
    EXPECT_NEAR(m.energy.Of({world.Read(0)}), start, 0.02) << tick;
  }
  EXPECT_NEAR(lowest, -20 / (4 * M_PI * M_PI), 1e-3);  // 2 g / omega^2: energy went to and fro
}

}  // namespace measure_geometry_test
}  // namespace seam
