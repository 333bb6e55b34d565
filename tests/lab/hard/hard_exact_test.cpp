/// The judges of the hard cases with an exact answer, on worlds moved by hand to a pose of known
/// error.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/lab/hard/exact_judge.h"
#include "tests/support/hard_case_named.h"

namespace seam {
namespace hard_exact_test {

/// A case's world, whose bodies are placed by hand and shown to its judge at chosen times.
struct Puppet {
  explicit Puppet(const std::string& name, bool weld_joints = false)
      : scene(Adjusted(name, weld_joints)), world(scene), judge(CaseNamed(name).judge(scene)) {}

  static Scene Adjusted(const std::string& name, bool weld_joints) {
    Scene scene = LoadHardScene(CaseNamed(name));
    scene.solver.weld_joints = weld_joints;
    return scene;
  }
  int Body(const std::string& part) const {
    const auto found = std::find_if(scene.parts.begin(), scene.parts.end(),
                                    [&](const Part& p) { return p.name == part; });
    EXPECT_NE(found, scene.parts.end()) << part;
    return world.BodyOfId(found->id);
  }
  void Place(const std::string& part, double x, double y) {
    BodyState state = world.Read(Body(part));
    state.position = Vec2(static_cast<float>(x), static_cast<float>(y));
    world.Write(Body(part), state);
  }
  void Shift(const std::string& part, double x, double y) {
    const Vec2 at = world.Read(Body(part)).position;
    Place(part, static_cast<double>(at.x()) + x, static_cast<double>(at.y()) + y);
  }
  void Turn(const std::string& part, double angle) {
    BodyState state = world.Read(Body(part));
    state.angle = static_cast<float>(angle);
    world.Write(Body(part), state);
  }
  void Push(const std::string& part, double x, double y) {
    BodyState state = world.Read(Body(part));
    state.velocity = Vec2(static_cast<float>(x), static_cast<float>(y));
    world.Write(Body(part), state);
  }
  double ErrorAt(double t) {
    world.SetTick(std::llround(t * scene.solver.tick_hz));
    judge->See(world);
    return judge->Error();
  }

  const Scene scene;
  World world;
  const std::unique_ptr<Judge> judge;
};

TEST(HardExact, ANanErrorIsTheWorst) {
  EXPECT_EQ(Worse(1, 2), 2);
  EXPECT_EQ(Worse(2, 1), 2);
  EXPECT_TRUE(std::isnan(Worse(std::nan(""), 1)));
  EXPECT_TRUE(std::isnan(Worse(1, std::nan(""))));
  // And it stays the worst of a run.
  Puppet p("projectile");
  double next = std::nan("");
  Worst worst([&next](const World&) { return next; });
  worst.See(p.world);
  next = 3;
  worst.See(p.world);
  EXPECT_TRUE(std::isnan(worst.Error()));
}

TEST(HardExact, ProjectileIsComparedWithTheSumAndWithTheParabola) {
  // n = 120 steps of 1/60 s: y = 20 * 2 - 10 * 120 * 121/(2 * 3600) = 40 - 20.1667.
  Puppet sum("projectile");
  sum.Place("ball", 14, 40 - 20 - 1.0 / 6);
  EXPECT_NEAR(sum.ErrorAt(2), 0, 2e-6);
  sum.Shift("ball", 0.3, -0.4);
  EXPECT_NEAR(sum.ErrorAt(2), 0.5, 2e-6);
  Puppet parabola("projectile-parabola");
  parabola.Place("ball", 14, 20);
  EXPECT_NEAR(parabola.ErrorAt(2), 0, 2e-6);
  parabola.Shift("ball", 0, 0.25);
  EXPECT_NEAR(parabola.ErrorAt(2), 0.25, 2e-6);
}

TEST(HardExact, BlocksSlideAndStopByCoulombsLaw) {
  struct Way {
    const char* name;
    double angle, t, come;
  };
  for (const Way& way : {Way{"slide-flat", 0, 1, 8 - 2.5}, Way{"slide-flat", 0, 4, 6.4},
                         Way{"slope-creep", 0.4, 9, 0},
                         Way{"slope-slide", 0.4, 2, 20 * (std::sin(0.4) - 0.2 * std::cos(0.4))},
                         Way{"slope-stop", 0.2, 5, 3.2 / (0.5 * std::cos(0.2) - std::sin(0.2))}}) {
    Puppet p(way.name);
    const double c = std::cos(way.angle), s = std::sin(way.angle);
    p.Shift("block", way.come * c, -way.come * s);
    EXPECT_NEAR(p.ErrorAt(way.t), 0, 1e-5) << way.name;
    p.Shift("block", s, c);  // off the ground: another matter
    EXPECT_NEAR(p.ErrorAt(way.t), 0, 1e-5) << way.name;
    p.Shift("block", -0.125 * c, 0.125 * s);
    EXPECT_NEAR(p.ErrorAt(way.t), 0.125, 1e-5) << way.name;
  }
}

TEST(HardExact, DiscIsComparedWithTwoThirdsOfTheSlopesPullAndItsTurnWithItsPath) {
  Puppet way("rolling-disc"), slip("rolling-disc-slip");
  const double c = std::cos(0.35), s = std::sin(0.35), come = 10 * s / 3 * 9;
  for (Puppet* p : {&way, &slip}) {
    p->Shift("disc", come * c, -come * s);
    p->Turn("disc", -0.35 - come / 0.5);
    EXPECT_NEAR(p->ErrorAt(3), 0, 1e-5);
    p->Turn("disc", -0.35 - (come - 0.1) / 0.5);
  }
  EXPECT_NEAR(way.ErrorAt(3), 0, 1e-5);
  EXPECT_NEAR(slip.ErrorAt(3), 0.1, 1e-5);
  way.Shift("disc", 0.2 * c, -0.2 * s);
  EXPECT_NEAR(way.ErrorAt(3), 0.2, 1e-5);
}

TEST(HardExact, PeriodOfAMadeUpSwingIsRight) {
  // I/(m g d) = ((1 + 0.01)/12 + 0.25)/5, K(sin 45) = 1.854074677.
  const double exact = 4 * std::sqrt((1.01 / 12 + 0.25) / 5) * 1.854074677;
  for (const double share : {1.0, 1.1, 0.8}) {
    Puppet p("pendulum-period");
    EXPECT_TRUE(std::isinf(p.ErrorAt(0)));
    for (int n = 1; n < 180; ++n) {
      const double angle =
          std::acos(-1.0) / 2 * std::cos(2 * std::acos(-1.0) * n / 60 / (share * exact));
      p.Place("bar", 0.5 * std::sin(angle), -0.5 * std::cos(angle));
      p.ErrorAt(n / 60.0);
    }
    EXPECT_NEAR(p.judge->Error(), std::fabs(share - 1), 1e-4) << share;
  }
}

TEST(HardExact, EnergyIsAShareOfTheFall) {
  // 0.1 kg that may fall 0.5 m: 0.5 J. At 1 m/s it has 0.05 J too much.
  Puppet one("pendulum-energy");
  EXPECT_EQ(one.ErrorAt(0), 0);
  one.Push("bar", 0, 1);
  EXPECT_NEAR(one.ErrorAt(1), 0.1, 1e-6);
  one.Push("bar", 0, 0);
  EXPECT_NEAR(one.ErrorAt(2), 0.1, 1e-6) << "the worst stays";
  // The lower of two hangs 1.5 m out: 2 J to fall. 0.1 m lower at rest, 0.1 J are lost.
  Puppet two("pendulum-double");
  two.Shift("lower", 0, -0.1);
  EXPECT_NEAR(two.ErrorAt(1), 0.05, 1e-6);
}

TEST(HardExact, ImpactsAreComparedWithReflectionAboutTheCommonCentre) {
  for (const char* name : {"collision-elastic", "collision-glancing", "collision-inelastic"}) {
    Puppet p(name);
    for (std::size_t i = 0; i < p.scene.parts.size(); i += 2) {
      const Part &a = p.scene.parts[i], &b = p.scene.parts[i + 1];
      const double m1 = static_cast<double>(a.material.density);
      const double m2 = static_cast<double>(b.material.density);
      const double e = static_cast<double>(a.material.restitution);
      // Discs of 0.5 m touch when their centres are 1 m apart.
      const double aside = static_cast<double>(b.position.y() - a.position.y());
      const Eigen::Vector2d normal(std::sqrt(1 - aside * aside), aside);
      const Eigen::Vector2d v(8, 0), common = m1 / (m1 + m2) * v;
      const Eigen::Vector2d left = v - (1 + e) * v.dot(normal) * normal;  // relative, after
      const Eigen::Vector2d after_a = common + m2 / (m1 + m2) * left;
      const Eigen::Vector2d after_b = common - m1 / (m1 + m2) * left;
      p.Push(a.name, after_a.x(), after_a.y());
      p.Push(b.name, after_b.x(), after_b.y());
    }
    EXPECT_NEAR(p.ErrorAt(1), 0, 1e-6) << name;
    const Vec2 v = p.world.Read(p.Body("b1")).velocity;
    p.Push("b1", static_cast<double>(v.x()), static_cast<double>(v.y()) + 0.8);
    EXPECT_NEAR(p.ErrorAt(1), 0.1, 1e-6) << name;
  }
}

TEST(HardExact, CradleIsSeenWhenTheLastBallIsHighest) {
  // Half a period is 2 sqrt(4/10) K(sin 22.5) = 2.066 s.
  const double top = std::acos(-1.0) / 4;
  for (const auto& [name, pitch] :
       {std::pair<const char*, double>{"cradle-gaps", 1.02}, {"cradle-touching", 1.0}}) {
    for (const double swing : {top, top * 2 / 3}) {
      Puppet p(name);
      EXPECT_TRUE(std::isnan(p.ErrorAt(2.05))) << "too early";
      p.Place("ball0", 0, -4);
      p.Place("ball4", 4 * pitch + 4 * std::sin(swing), -4 * std::cos(swing));
      const double share = (1 - std::cos(swing)) / (1 - std::cos(top));
      EXPECT_NEAR(p.ErrorAt(2.1), 1 - share, 1e-5) << name;
    }
    Puppet moving(name);
    moving.Place("ball0", 0, -4);
    moving.Place("ball4", 4 * pitch + 4 * std::sin(top), -4 * std::cos(top));
    moving.Push("ball2", 1, 0);  // of 40 (1 - cos 45) J/kg
    EXPECT_NEAR(moving.ErrorAt(2.1), 0.5 / (40 * (1 - std::cos(top))), 1e-5);
  }
}

TEST(HardExact, RockingBlockFallsInTheTimeOfItsEquation) {
  for (const double scale : {1.0, 10.0}) {
    // angle'' = -p^2 sin(alpha - angle), by small steps from 0.147 to 0.
    const double alpha = std::atan(0.25), p2 = 30 / (2 * scale * std::sqrt(4.25));
    double angle = 0.147, spin = 0, exact = 0;
    const double h = 1e-5;
    while (angle > 0) {
      spin -= h * p2 * std::sin(alpha - angle);
      angle += h * spin;
      exact += h;
    }
    Puppet p(scale > 1 ? "rocking-time-tenfold" : "rocking-time");
    EXPECT_TRUE(std::isinf(p.ErrorAt(0)));
    p.Turn("block", 0.03);
    const double before = std::floor(exact * 60) / 60;
    p.ErrorAt(before);
    p.Turn("block", -0.01);  // three quarters of a tick later it passed upright
    EXPECT_NEAR(p.ErrorAt(before + 1.0 / 60), std::fabs((before + 0.75 / 60) / exact - 1), 2e-5);
  }
}

TEST(HardExact, RockingBlockKeepsHousnersShareOfItsSpin) {
  // Half of the spin lifts the block by a quarter of the height. Housner leaves 1 - 1.5/17.
  const double alpha = std::atan(0.25);
  const double quarter = 0.75 * std::cos(alpha) + 0.25 * std::cos(alpha - 0.147);
  Puppet p("rocking-spin");
  EXPECT_NEAR(p.ErrorAt(0), 1 - 1.5 / 17, 1e-6) << "it did not rise at all";
  p.Turn("block", -(alpha - std::acos(quarter)));
  EXPECT_NEAR(p.ErrorAt(1), 1 - 1.5 / 17 - 0.5, 1e-5);
  EXPECT_EQ(p.judge->Failure(), "did not rock back");
  p.Turn("block", 0);
  p.ErrorAt(2);
  p.Turn("block", -0.2);  // a later swing does not count
  EXPECT_NEAR(p.ErrorAt(3), 1 - 1.5 / 17 - 0.5, 1e-5);
  EXPECT_EQ(p.judge->Failure(), "");
}

TEST(HardExact, CatenaryIsInPlaceUntilALinkIsMoved) {
  Puppet p("catenary");
  EXPECT_LT(p.ErrorAt(0), 1e-6);
  p.Shift("link07", 0.03, -0.04);
  EXPECT_NEAR(p.ErrorAt(1), 0.05, 1e-6);
}

TEST(HardExact, StretchIsMeasuredAtTheLoadsHinge) {
  Puppet p("chain-heavy-end");
  EXPECT_NEAR(p.ErrorAt(0), 0, 1e-6);
  // The load's hinge is 0.5 m above its middle: swung out to the right and turned with the chain.
  p.Place("load", 10.5, 0);
  p.Turn("load", std::acos(-1.0) / 2);
  EXPECT_NEAR(p.ErrorAt(1), 0, 2e-6);
  p.Place("load", 10.7, 0);
  EXPECT_NEAR(p.ErrorAt(2), 0.2, 2e-6);
}

TEST(HardExact, DroopIsMeasuredInTheFrameOfTheTurnedBase) {
  Puppet whole("cantilever");
  EXPECT_EQ(whole.world.body_count(), 1);
  whole.Place("base", 3, 4);
  whole.Turn("base", 1);
  EXPECT_NEAR(whole.ErrorAt(1), 0, 5e-6);
  Puppet jointed("cantilever", true);
  EXPECT_EQ(jointed.world.body_count(), 11);
  EXPECT_NEAR(jointed.ErrorAt(0), 0, 1e-6);
  jointed.Shift("link.9", 0, -0.5);
  EXPECT_NEAR(jointed.ErrorAt(1), 0.5, 1e-6);
}

TEST(HardExact, CranksAreComparedWithTheMotorAndTheCouplerWithRest) {
  Puppet p("motor-loop");
  EXPECT_EQ(p.ErrorAt(0), 0);
  for (const char* crank : {"crank0", "crank1", "crank2"}) p.Turn(crank, 6);
  EXPECT_NEAR(p.ErrorAt(2), 0, 1e-6);
  p.Turn("coupler", -0.05);
  EXPECT_NEAR(p.ErrorAt(2), 0.05, 1e-6);
  p.Turn("crank2", 5.9);
  EXPECT_NEAR(p.ErrorAt(2), 0.1, 1e-6);
}

TEST(HardExact, ShotsBehindTheirWallAreCountedAndThoseThatWereSlowed) {
  Puppet p("tunnel-bullet-0500");
  EXPECT_EQ(p.ErrorAt(0), 0);
  for (int i = 0; i < 3; ++i) p.Push("shot-disc-still." + std::to_string(i), 120, 0);
  EXPECT_EQ(p.ErrorAt(0.01), 0);
  EXPECT_EQ(p.judge->Failure(), "3 of 32 shots slowed by the engine's clamp");
  // At the anchored wall; beyond it; beyond where a moving wall began, but that moved away.
  p.Shift("shot-box-still.0", 7.9, 0);
  p.Push("shot-box-still.0", 0, 0);
  p.Shift("shot-box-still.1", 9, 0);
  p.Shift("wall-box-moving.0", 2, 0);
  p.Shift("shot-box-moving.0", 9, 0);
  EXPECT_EQ(p.ErrorAt(0.02), 1.0 / 32);
  EXPECT_EQ(p.judge->Failure(), "3 of 32 shots slowed by the engine's clamp");
  p.Shift("wall-box-moving.0", -2, 0);
  EXPECT_EQ(p.ErrorAt(0.03), 2.0 / 32);
}

}  // namespace hard_exact_test
}  // namespace seam
