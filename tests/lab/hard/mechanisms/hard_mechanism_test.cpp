/// The hard cases of mechanisms: their judges on worlds moved by hand, each case with its scene's
/// own solver, and proof that the case's difficulty occurs.

#include <gtest/gtest.h>

#include <cmath>

#include "common/measure/overlap.h"
#include "tests/lab/hard/mechanisms/mechanism_judges.h"
#include "tests/lab/hard/observe.h"
#include "tests/lab/hard/script_player.h"
#include "tests/support/hard_case_named.h"

namespace seam {
namespace hard_mechanism_test {

/// A jaw at the origin with a load beside it, hinged to a post by a rod.
const char* const kHeld =
    "[[part]]\nname = \"post\"\nbox = [0.2, 0.2]\nposition = [0, 5]\nanchored = true\n"
    "[[part]]\nname = \"jaw\"\nbox = [1, 1]\n"
    "[[part]]\nname = \"load\"\nbox = [1, 1]\nposition = [2, 0]\n"
    "[[joint]]\nname = \"rod\"\nkind = \"distance\"\na = \"post\"\nb = \"jaw\"\n";

struct Puppet {
  explicit Puppet(const std::string& text) : scene(ParseScene(text, "s.toml")), world(scene) {}
  void Place(int body, float x, float y, float angle = 0, Vec2 velocity = {0, 0}) {
    world.Write(body, {{x, y}, angle, velocity, 0});
  }
  void ShowAt(double t, Judge* judge) {
    world.SetTick(std::llround(t * scene.solver.tick_hz));
    judge->See(world);
  }
  const Scene scene;
  World world;
};

TEST(MechanismJudge, SlipIsSeenFromTheJawThatCarriesTheLoad) {
  Puppet p(kHeld);
  const auto judge = MakeGripJudge({}, {"load", "jaw", 1, 2, 0.5}, p.scene);
  p.ShowAt(0, judge.get());
  p.Place(1, 2, 0.25f);  // before the grip is closed
  p.ShowAt(1, judge.get());
  EXPECT_EQ(judge->Error(), 0);
  p.Place(0, 0, 3, static_cast<float>(std::acos(0.0)));  // turned by 90 degrees, 3 m up
  p.Place(1, -0.25f, 5);
  p.ShowAt(2, judge.get());
  EXPECT_NEAR(judge->Error(), 0, 1e-6);
  EXPECT_EQ(judge->Failure(), "");
  p.Place(1, -0.25f, 5.125f);
  p.ShowAt(3, judge.get());
  EXPECT_NEAR(judge->Error(), 0.125, 1e-6);
  p.Place(1, -0.25f, 1.5f);
  p.ShowAt(4, judge.get());
  EXPECT_EQ(judge->Failure(), "slipped out at 4.0 s");
}

TEST(MechanismJudge, ALoadThatStaysBelowIsNotUp) {
  Puppet p(kHeld);
  const auto judge = MakeGripJudge({}, {"load", "jaw", 1, 2, 9}, p.scene);
  p.ShowAt(0, judge.get());
  p.Place(1, 2, 1.9f);
  p.ShowAt(2, judge.get());
  EXPECT_EQ(judge->Failure(), "is not up");
  p.Place(1, 2, 2.1f);
  p.ShowAt(3, judge.get());
  EXPECT_EQ(judge->Failure(), "");
}

TEST(MechanismJudge, AnOpenJointAndAnIncompleteJourneyFail) {
  Puppet p(kHeld);
  const auto judge = MakeJointDriftJudge({}, 1, {"load", {10, -1}}, p.scene);
  p.ShowAt(0, judge.get());
  EXPECT_EQ(judge->Failure(), "did not get there");
  p.Place(0, 0, -0.25f);
  p.Place(1, 13, -0.5f);
  p.ShowAt(1, judge.get());
  EXPECT_NEAR(judge->Error(), 0.25, 1e-6);
  EXPECT_EQ(judge->Failure(), "");
  p.Place(1, 13, -1.5f);  // into a hole
  p.ShowAt(2, judge.get());
  EXPECT_EQ(judge->Failure(), "did not get there");
  p.Place(0, 0, -1.5f);
  p.ShowAt(3, judge.get());
  EXPECT_EQ(judge->Failure(), "came apart at 3.0 s");
}

TEST(MechanismJudge, OverlapCountsFromItsTimeOn) {
  Puppet p(kHeld);
  const auto judge = MakeOverlapJudge({}, 2, p.scene);
  p.ShowAt(0, judge.get());
  p.Place(1, 0.5f, 0);
  p.ShowAt(1, judge.get());
  EXPECT_NEAR(judge->Error(), 0.5, 1e-6) << "of a run that ends before";
  p.Place(1, 0.75f, 0);
  p.ShowAt(2, judge.get());
  p.Place(1, 3, 0);
  p.ShowAt(3, judge.get());
  EXPECT_NEAR(judge->Error(), 0.25, 1e-6);
}

TEST(MechanismJudge, EnergyCountsBothWays) {
  for (const float speed : {2.2f, 1.8f}) {
    Puppet p(std::string("gravity = [0, 0]\n") + kHeld);
    p.Place(1, 2, 0, 0, {2, 0});
    const auto judge = MakeEnergyJudge({}, p.scene);
    p.ShowAt(0, judge.get());
    p.Place(1, 2, 0, 0, {0, speed});
    p.ShowAt(1, judge.get());
    p.Place(1, 2, 0, 0, {2, 0});
    p.ShowAt(2, judge.get());
    EXPECT_NEAR(judge->Error(), std::fabs(double{speed} * double{speed} / 4 - 1), 1e-6);
  }
}

Observation RunCase(const std::string& name, const std::function<void(Scene*)>& change = {}) {
  const HardCase& hard = CaseNamed(name);
  Scene scene = LoadHardScene(hard);
  if (change) change(&scene);
  return Observe(hard, scene, hard.seconds);
}

void Stock(Scene* scene) { scene->solver = StockSolver(); }

Joint& JointNamed(Scene* scene, const std::string& name) {
  const auto found = std::find_if(scene->joints.begin(), scene->joints.end(),
                                  [&](const Joint& joint) { return joint.name == name; });
  EXPECT_NE(found, scene->joints.end()) << name;
  return *found;
}

TEST(HardMechanism, NoCaseFailsWithItsScenesOwnSolver) {
  for (const HardCase& hard : MechanismCases()) {
    const Observation seen = Observe(hard, LoadHardScene(hard), hard.seconds);
    EXPECT_EQ(seen.failure, "") << hard.name;
    EXPECT_TRUE(std::isfinite(seen.error)) << hard.name;
  }
}

TEST(HardMechanism, JudgesReportTheFailuresOfStock) {
  EXPECT_EQ(RunCase("crane-grip", Stock).failure.rfind("slipped out", 0), 0u);
  EXPECT_EQ(RunCase("mass-ratio-hung", Stock).failure.rfind("fell", 0), 0u);
  EXPECT_EQ(RunCase("tower-linkage", Stock).failure.rfind("fell", 0), 0u);
  EXPECT_GT(RunCase("chain-heavy-end-nudged", Stock).error, 1);
}

TEST(HardMechanism, TheCrateIsLiftedByItsGripAlone) {
  const auto slippery = [](Scene* scene) {
    for (Part& part : scene->parts) part.material.friction = 0.1f;
  };
  EXPECT_NE(RunCase("crane-grip", slippery).failure, "") << "friction bears it";
  const auto weak = [](Scene* scene) { JointNamed(scene, "jaw-r").motor_torque = 1500; };
  EXPECT_NE(RunCase("crane-grip", weak).failure, "") << "2400 N of friction do not bear 4000 N";
}

TEST(HardMechanism, PilesFallWithoutTheirJoints) {
  const auto unstopped = [](Scene* scene) { JointNamed(scene, "foot-l").limited = false; };
  EXPECT_EQ(RunCase("tower-linkage", unstopped).failure.rfind("fell", 0), 0u);
  const auto untied = [](Scene* scene) { JointNamed(scene, "left").gone = true; };
  EXPECT_EQ(RunCase("mass-ratio-hung", untied).failure.rfind("fell", 0), 0u);
}

TEST(HardMechanism, TheCarDrivesByItsMotor) {
  const auto parked = [](Scene* scene) { JointNamed(scene, "rear").motor_torque = 0; };
  EXPECT_EQ(RunCase("car-terrain", parked).failure, "did not get there");
}

TEST(HardMechanism, RagdollsFallOnOneAnother) {
  // Stock lets limbs into each other and joints apart: they are a heap, and not side by side.
  EXPECT_GT(RunCase("ragdoll-pile-impact", Stock).error, 0.1);
  EXPECT_GT(RunCase("ragdoll-pile", Stock).error, 0.05);
  const Scene scene = LoadHardScene(CaseNamed("ragdoll-pile"));
  const Composition composition = Compose(scene);
  EXPECT_EQ(composition.mechanisms.size(), 20u);
  for (const Mechanism& doll : composition.mechanisms) EXPECT_EQ(doll.assemblies.size(), 10u);
  const World world(scene);
  std::vector<BodyState> states;
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  EXPECT_EQ(OverlapMeter(scene, composition).Deepest(states), 0) << "nothing begins overlapping";
}

TEST(HardMechanism, ElasticBoxesMatchTheirNames) {
  for (const int substeps : {1, 2, 4, 8}) {
    for (const char* box : {"disc-box-x", "rod-box-x"}) {
      const Scene scene = LoadHardScene(CaseNamed(box + std::to_string(substeps)));
      EXPECT_EQ(scene.solver.substeps, substeps);
      for (const Part& part : scene.parts) {
        EXPECT_EQ(part.material.restitution, 1) << part.name;
        EXPECT_EQ(part.material.friction, 0) << part.name;
      }
    }
  }
}

TEST(HardMechanism, EachLoadedJointIsTheOnlyOneOfItsKind) {
  const std::pair<const char*, JointKind> kinds[] = {
      {"joint-load-distance", JointKind::kDistance},   {"joint-load-hinge", JointKind::kRevolute},
      {"joint-load-prismatic", JointKind::kPrismatic}, {"joint-load-rope", JointKind::kRope},
      {"joint-load-weld", JointKind::kWeld},           {"joint-load-wheel", JointKind::kWheel}};
  for (const auto& [name, kind] : kinds) {
    const Scene scene = LoadHardScene(CaseNamed(name));
    const World world(scene);
    ASSERT_EQ(world.body_count(), 2) << name;
    EXPECT_NEAR(double{world.mass(1)} / double{world.mass(0)}, 100, 1e-3) << name;
    for (const Joint& joint : scene.joints) {
      EXPECT_TRUE(joint.gone || joint.kind == kind) << joint.name;
    }
    EXPECT_GT(RunCase(name, Stock).error, 0.05) << name << ": it is a load";
  }
}

}  // namespace hard_mechanism_test
}  // namespace seam
