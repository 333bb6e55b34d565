/// The judges of the hard cases without an exact answer, on worlds moved by hand, and each case
/// with its scene's own solver.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/lab/hard/hard_case.h"
#include "tests/lab/hard/invariant_far.h"
#include "tests/lab/hard/invariant_judges.h"

namespace seam {
namespace hard_invariant_test {

/// Two boxes 5 m apart.
const char* const kTwoBoxes =
    "gravity = [0, 0]\n"
    "[[part]]\nname = \"box\"\nbox = [1, 1]\nrepeat = {count = 2, step = [5, 0]}\n";

/// A hook at the origin and three links of 1 m to the right of it, pinned end to end.
const char* const kChain =
    "gravity = [0, 0]\n"
    "[[part]]\nname = \"hook\"\nbox = [0.2, 0.2]\nanchored = true\n"
    "[[part]]\nname = \"link\"\nbox = [1, 0.2]\nposition = [0.5, 0]\ngroup = -1\n"
    "repeat = {count = 3, step = [1, 0]}\n"
    "[[joint]]\nname = \"hang\"\nkind = \"revolute\"\na = \"hook\"\nb = \"link.0\"\n"
    "anchor = [0, 0]\n"
    "[[joint]]\nname = \"pin\"\nkind = \"revolute\"\na = \"link.0\"\nb = \"link.1\"\n"
    "anchor = [1, 0]\nrepeat = {count = 2, step = [1, 0]}\n";

/// A world whose bodies are placed by hand and shown to a judge at chosen times.
struct Puppet {
  explicit Puppet(const std::string& text, int tick_hz = 60)
      : scene(ParseScene(text + "[solver]\ntick_hz = " + std::to_string(tick_hz) + "\n", "s.toml")),
        world(scene) {}

  void Place(int body, float x, float y, float angle = 0) {
    BodyState state = world.Read(body);
    state.position = Vec2(x, y);
    state.angle = angle;
    world.Write(body, state);
  }
  void ShowAt(double t, Judge* judge) {
    world.SetTick(std::llround(t * scene.solver.tick_hz));
    judge->See(world);
  }

  const Scene scene;
  World world;
};

TEST(HardJudge, DriftIsTheWorstDistanceAlongTheJudgedAxis) {
  for (const int hz : {30, 60, 960}) {
    Puppet p(kTwoBoxes, hz);
    const auto all = MakeDriftJudge({}, {});
    const auto across = MakeDriftJudge({}, {kNoLimit, Vec2(1, 0), 0});
    for (Judge* judge : {all.get(), across.get()}) p.ShowAt(0, judge);
    p.Place(1, 5 - 0.3f, 0.4f);
    for (Judge* judge : {all.get(), across.get()}) p.ShowAt(1, judge);
    p.Place(1, 5, 0);  // back again: the worst stays
    for (Judge* judge : {all.get(), across.get()}) p.ShowAt(2, judge);
    EXPECT_NEAR(all->Error(), 0.5, 1e-6);
    EXPECT_NEAR(across->Error(), 0.3, 1e-6);
    EXPECT_EQ(all->Failure(), "");
  }
}

TEST(HardJudge, DriftCountsFromTheSettledPose) {
  Puppet p(kTwoBoxes);
  const auto judge = MakeDriftJudge({}, {kNoLimit, Vec2(0, 0), 2});
  p.ShowAt(0, judge.get());
  p.Place(0, 0, -1);
  p.ShowAt(1.9, judge.get());
  EXPECT_NEAR(judge->Error(), 1, 1e-6) << "a run that ends before is judged from its beginning";
  p.ShowAt(2, judge.get());
  p.Place(0, 0, -1.25f);
  p.ShowAt(3, judge.get());
  EXPECT_NEAR(judge->Error(), 0.25, 1e-6);
}

TEST(HardJudge, ABodyTooFarAwayFellAtTheFirstSuchTick) {
  Puppet p(kTwoBoxes);
  const auto judge = MakeDriftJudge({}, {0.5, Vec2(1, 0), 0});
  p.ShowAt(0, judge.get());
  p.Place(0, 0, -0.4f);
  p.ShowAt(1, judge.get());
  EXPECT_EQ(judge->Failure(), "");
  p.Place(0, 0, -0.6f);  // not across, but fallen
  p.ShowAt(12.3, judge.get());
  p.ShowAt(13, judge.get());
  EXPECT_EQ(judge->Failure(), "fell at 12.3 s");
}

TEST(HardJudge, AFastBodyExplodedAndAnOutsideOneEscaped) {
  Puppet p(kTwoBoxes);
  const auto fast = MakeDriftJudge({40, {}}, {});
  const auto outside = MakeDriftJudge({kNoLimit, {-1, -1, 6, 1}}, {});
  p.ShowAt(0, fast.get());
  p.ShowAt(0, outside.get());
  EXPECT_EQ(fast->Failure() + outside->Failure(), "");
  BodyState state = p.world.Read(1);
  state.velocity = Vec2(0, -48);
  state.position = Vec2(6.1f, 0);
  p.world.Write(1, state);
  p.ShowAt(0.2, fast.get());
  p.ShowAt(0.2, outside.get());
  EXPECT_EQ(fast->Failure(), "exploded: 48 m/s at 0.2 s");
  EXPECT_EQ(outside->Failure(), "escaped at 0.2 s");
}

TEST(HardJudge, TheWaveStoppedUnlessAllHaveFallen) {
  Puppet p(kTwoBoxes);
  const auto judge = MakeToppleJudge({}, {});
  p.ShowAt(0, judge.get());
  p.Place(0, 0, 0, -1.2f);
  p.Place(1, 5, 0, 0.4f);
  p.ShowAt(1, judge.get());
  EXPECT_EQ(judge->Failure(), "the wave stopped: 1 of 2 fell");
  p.Place(1, 5, 0, -0.6f);
  p.ShowAt(2, judge.get());
  EXPECT_EQ(judge->Failure(), "");
}

TEST(HardJudge, ReachIsBeyondTheStretchedChain) {
  Puppet p(kChain);
  const auto judge = MakeReachJudge({}, 1, p.scene);
  p.ShowAt(0, judge.get());
  EXPECT_NEAR(judge->Error(), 0, 1e-6) << "laid at full stretch";
  p.Place(2, 0, -1);  // slack
  p.ShowAt(1, judge.get());
  EXPECT_NEAR(judge->Error(), 0, 1e-6);
  p.Place(2, 0, -2.75f);  // its middle is 2.5 m along the chain
  p.ShowAt(2, judge.get());
  EXPECT_NEAR(judge->Error(), 0.25, 1e-6);
  EXPECT_EQ(judge->Failure(), "");
  p.Place(0, 1.6f, 0);  // its middle is 0.5 m along
  p.ShowAt(3, judge.get());
  EXPECT_NEAR(judge->Error(), 1.1, 1e-6);
  EXPECT_EQ(judge->Failure(), "came apart at 3.0 s");
}

TEST(HardJudge, ReachUsesTheShortestPathAndTheLengthsOfRods) {
  // A short cut of 2 m from the hook to the last link's middle: less than the 2.5 m of the chain.
  Puppet p(kChain + std::string("[[joint]]\nname = \"rod\"\nkind = \"distance\"\na = \"hook\"\n"
                                "b = \"link.2\"\nanchor_a = [0, 0]\nlength = 2\n"));
  const auto judge = MakeReachJudge({}, kNoLimit, p.scene);
  p.Place(2, 0, 2.1f);
  p.ShowAt(0, judge.get());
  EXPECT_NEAR(judge->Error(), 0.1, 1e-6);
}

TEST(HardJudge, ABodyWithoutJointsHasNoReach) {
  Puppet p(kTwoBoxes);
  const auto judge = MakeReachJudge({}, 1, p.scene);
  p.Place(0, 100, 0);
  p.ShowAt(1, judge.get());
  EXPECT_EQ(judge->Error(), 0);
}

TEST(HardJudge, RestlessIsTheRootMeanSquareOfMovesOverTime) {
  for (const int hz : {30, 240}) {
    Puppet p(kTwoBoxes, hz);
    const auto judge = MakeRestlessJudge({}, 1);
    // 3 m/s until 1 s, then 0.6 m/s: of one of two bodies.
    float x = 0;
    for (int tick = 0; tick <= 3 * hz; ++tick) {
      if (tick > 0) x += (tick <= hz ? 3.0f : 0.6f) / static_cast<float>(hz);
      p.Place(0, x, 0);
      p.world.SetTick(tick);
      judge->See(p.world);
    }
    EXPECT_NEAR(judge->Error(), 0.6 / std::sqrt(2), 1e-4);
  }
}

TEST(HardJudge, ReleaseIsTheGreatestSpeedOfAnyMove) {
  Puppet p(kTwoBoxes);
  const auto judge = MakeReleaseJudge({}, 0.01, p.scene);
  float y = 0;
  for (int tick = 0; tick < 10; ++tick) {
    y += tick == 4 ? 0.1f : 0.01f;  // 6 m/s once, else 0.6 m/s
    p.Place(1, 5, y);
    p.world.SetTick(tick);
    judge->See(p.world);
  }
  EXPECT_NEAR(judge->Error(), 6, 1e-4);
}

TEST(HardJudge, AReleasedBodyMustNotOverlapAtTheEnd) {
  Puppet p(kTwoBoxes);
  const auto judge = MakeReleaseJudge({}, 0.01, p.scene);
  p.Place(1, 0.97f, 0);
  p.ShowAt(0, judge.get());
  EXPECT_EQ(judge->Failure(), "still overlap by 0.03 m");
  p.Place(1, 0.995f, 0);
  p.ShowAt(1, judge.get());
  EXPECT_EQ(judge->Failure(), "");
}

TEST(HardJudge, ArrivalIsTheDistanceFromItsGoalAfterItsTime) {
  Puppet p(kTwoBoxes);
  const auto judge = MakeArrivalJudge({}, {"box.1", 3, 2, 0.5}, p.scene);
  p.ShowAt(0, judge.get());
  EXPECT_NEAR(judge->Error(), 3, 1e-6) << "a run that ends before";
  p.Place(1, 5, 2.9f);
  p.ShowAt(2, judge.get());
  p.Place(1, 5, 3.2f);
  p.ShowAt(3, judge.get());
  EXPECT_NEAR(judge->Error(), 0.2, 1e-6);
  EXPECT_EQ(judge->Failure(), "");
  p.Place(1, 5, 2.4f);
  p.ShowAt(4, judge.get());
  EXPECT_EQ(judge->Failure(), "is not up at 4.0 s");
}

TEST(HardJudge, ADistantRunIsComparedWithTheNearOne) {
  const Vec2 by(8000, 6000);
  Scene scene = ParseScene(kTwoBoxes, "s.toml");
  ShiftScene(by, &scene);
  World world(scene);
  EXPECT_EQ(world.Read(1).position, Vec2(8005, 6000));
  const auto judge = MakeFarJudge({}, 1, by);
  for (int tick = 0; tick < 3; ++tick) {
    judge->See(world);
    world.Step();
  }
  EXPECT_EQ(judge->Error(), 0) << "nothing moves, and 8005 m is a number without rounding";
  BodyState state = world.Read(1);
  state.position += Vec2(0.25f, 0);
  world.Write(1, state);
  judge->See(world);
  EXPECT_EQ(judge->Error(), 0.25);
  EXPECT_EQ(judge->Failure(), "");
}

/// Runs a case with its scene's own solver or another one.
struct Verdict {
  double error = 0;
  std::string failure;
};
Verdict RunCase(const HardCase& hard, double seconds, const Solver* solver = nullptr) {
  Scene scene = LoadHardScene(hard);
  if (solver != nullptr) scene.solver = *solver;
  World world(scene);
  const auto judge = hard.judge(scene);
  judge->See(world);
  const int ticks = static_cast<int>(seconds * scene.solver.tick_hz);
  for (int i = 0; i < ticks; ++i) {
    world.Step();
    judge->See(world);
  }
  return {judge->Error(), judge->Failure()};
}

const HardCase& CaseOf(std::string_view name) {
  static const std::vector<HardCase> all = InvariantCases();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const HardCase& hard) { return hard.name == name; });
  EXPECT_NE(found, all.end()) << name;
  return *found;
}

TEST(HardInvariant, NoCaseFailsWithItsScenesOwnSolver) {
  for (const HardCase& hard : InvariantCases()) {
    SCOPED_TRACE(hard.name);
    EXPECT_EQ(hard.seconds, 60);
    // Long enough for the lift to be up and for the wave to have gone through the dominoes.
    const Verdict run = RunCase(hard, 12);
    EXPECT_EQ(run.failure, "");
    EXPECT_TRUE(std::isfinite(run.error));
  }
}

TEST(HardInvariant, TheScenesOwnSolverHoldsForAMinuteAndStockFails) {
  const Solver stock = StockSolver();
  const std::pair<const char*, const char*> failures[] = {
      {"ball-and-chain", "came apart"}, {"bridge", "exploded"},        {"card-house", "fell"},
      {"mass-ratio", "fell"},           {"scissor-lift", "is not up"}, {"tower-30", "fell"}};
  for (const auto& [name, failure] : failures) {
    SCOPED_TRACE(name);
    const HardCase& hard = CaseOf(name);
    EXPECT_EQ(RunCase(hard, 60, &stock).failure.rfind(failure, 0), 0u);
    EXPECT_EQ(RunCase(hard, 60).failure, "");
  }
}

TEST(HardInvariant, PilesStandEvenWhenNothingMaySleep) {
  // A sleeping pile stands under any solver: waking it must not fell it.
  for (const char* name : {"arch", "card-house", "mass-ratio", "tower-10", "tower-30"}) {
    SCOPED_TRACE(name);
    const HardCase& hard = CaseOf(name);
    Solver awake = LoadHardScene(hard).solver;
    awake.sleep = false;
    EXPECT_EQ(RunCase(hard, 60, &awake).failure, "");
  }
}

TEST(HardInvariant, TheScenesOwnSolverErrsLessThanStock) {
  const Solver stock = StockSolver();
  for (const char* name : {"pyramid-20", "joint-grid", "overlap", "far-tilted-10km",
                           "far-chain-10km", "card-house-apart"}) {
    SCOPED_TRACE(name);
    const HardCase& hard = CaseOf(name);
    EXPECT_LT(RunCase(hard, 10).error, RunCase(hard, 10, &stock).error);
  }
}

TEST(HardInvariant, FamiliesMatchTheirNames) {
  const Vec2 near = LoadHardScene(CaseOf("far-chain-0km")).parts[3].position;
  const Scene far = LoadHardScene(CaseOf("far-chain-10km"));
  EXPECT_EQ(far.parts[3].position - near, Vec2(8000, 6000));  // 10 km by Pythagoras
  const World world(far);
  EXPECT_EQ(world.Read(2).position, far.parts[3].position);
  EXPECT_EQ(far.joints[0].anchor_a, Vec2(8000, 6000));
}

}  // namespace hard_invariant_test
}  // namespace seam
