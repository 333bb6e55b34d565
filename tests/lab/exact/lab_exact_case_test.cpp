/// Scenes that carry their exact answer: the judge on right and wrong answers, by poses and by a
/// number, and every mistake in one line.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/check.h"
#include "tests/lab/exact/scene_case.h"
#include "tests/lab/exact/scene_truth.h"
#include "tests/lab/hard/observe.h"
#include "tests/lab/hard/settings.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_exact_case_test {

/// A ball thrown from 10 m; the code begins on line 10.
const char* const kThrown =
    "duration = 1\n[[part]]\nname = \"ball\"\ncircle = 0.5\n"
    "position = [0, 10]\nvelocity = [3, 4]\n";

/// A scene with a script, as a file that is there as long as this is.
struct JudgedScene {
  explicit JudgedScene(const std::string& code, const std::string& parts = kThrown) {
    files.Write("my.toml", parts + "[[script]]\nname = \"truth\"\ncode = '''\n" + code + "\n'''\n");
  }
  HardCase Case() const { return SceneCase(path, 0); }
  double ErrorAt(const Solver& solver) const {
    const HardCase hard = Case();
    return Observe(hard, WithSolver(LoadScene(path), solver), hard.seconds).error;
  }
  double Error() const { return ErrorAt(Solver()); }

  const LabWorkspace files;
  const std::string path = files / "my.toml";
};

TEST(ExactCase, ErrorIsNearZeroForTheEnginesOwnSum) {
  // Symplectic Euler in closed form: y_n = y0 + n v h - g h^2 n (n + 1)/2.
  const JudgedScene scene(
      "function exact(t)\n"
      "  return {ball = {x = 3 * t, y = 10 + 4 * t - 5 * t * (t + 1 / 60), angle = 0}}\n"
      "end");
  EXPECT_LT(scene.Error(), 1e-5);
  const HardCase hard = scene.Case();
  EXPECT_EQ(hard.name, "my");
  EXPECT_EQ(hard.unit, "m");
  EXPECT_EQ(hard.seconds, 1);
  EXPECT_EQ(hard.truth, Truth::kFormula);
}

TEST(ExactCase, ErrorIsTheWorstDistanceFromTheParabolaAtAnyRate) {
  const JudgedScene scene(
      "function exact(t) return {ball = {x = 3 * t, y = 10 + 4 * t - 5 * t * t}} end");
  EXPECT_NEAR(scene.Error(), 5.0 / 60, 1e-4) << "the step's own error, g h t/2";
  Solver fine;
  fine.tick_hz = 240;
  fine.substeps = 4;
  EXPECT_NEAR(scene.ErrorAt(fine), 5.0 / 960, 1e-4);
}

TEST(ExactCase, ErrorEqualsTheDeviationOfAWrongAnswer) {
  EXPECT_NEAR(JudgedScene("function exact(t) return {ball = {x = 5 * t}} end").Error(), 2, 1e-4);
  EXPECT_NEAR(JudgedScene("function exact(t) return {ball = {angle = math.pi * t}} end").Error(), 1,
              1e-4)
      << "half a turn of a disc of 1 m";
  const JudgedScene early(
      "function exact(t) return {ball = {x = 3 * t + (t < 0.1 and 7 or 0)}} end");
  EXPECT_NEAR(early.Error(), 7, 1e-4) << "the worst, not the last";
}

TEST(ExactCase, EnergyIsComparedAsAShareOfTheLargestExactValue) {
  // The engine's energy falls by g^2 h t/2 for each kg, of g y0 + v^2/2.
  const JudgedScene scene(
      "local m = math.pi / 4\nfunction exact(t) return m * (10 * 10 + 12.5), \"J\" end");
  EXPECT_NEAR(scene.Error(), 100.0 / 60 / 2 / 112.5, 2e-5);
  EXPECT_EQ(scene.Case().unit, "J/J");
  EXPECT_NE(scene.Case().about.find("energy against exact(t)"), std::string::npos);
}

TEST(ExactCase, EnergyOfJointedWeldsIsThatOfTheirBodies) {
  const JudgedScene scene("function exact(t) return 20, \"J\" end",
                          "gravity = [0, 0]\nduration = 1\n"
                          "[[part]]\nname = \"a\"\nbox = [1, 1]\nvelocity = [4, 0]\ndensity = 2\n"
                          "[[part]]\nname = \"b\"\nbox = [0.5, 1]\nposition = [0.75, 0]\n"
                          "velocity = [4, 0]\n"
                          "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"a\"\nb = \"b\"\n");
  EXPECT_LT(scene.Error(), 1e-5);
  EXPECT_LT(scene.ErrorAt(StockSolver()), 1e-5);
}

TEST(ExactCase, ComparesTheExactNumberWithTheMeasuredOne) {
  const std::string measured = "function measured(t) return world.part(\"ball\").vy + 0 * t end\n";
  const JudgedScene right(measured + "function exact(t) return 4 - 10 * t, \"m/s\", \"vy\" end");
  EXPECT_LT(right.Error(), 1e-6);
  EXPECT_EQ(right.Case().unit, "1") << "no m/s/m/s";
  const JudgedScene wrong(measured + "function exact(t) return 4 - 9 * t, \"m/s\", \"vy\" end");
  EXPECT_NEAR(wrong.Error(), 1.0 / 5, 1e-5) << "of the greatest, |4 - 9|";
  const JudgedScene zero(
      "function exact() return 0, \"m\" end\n"
      "function measured() return world.part(\"ball\").x end");
  EXPECT_NEAR(zero.Error(), 3, 1e-5) << "nothing to take a share of: metres";
  EXPECT_EQ(zero.Case().unit, "m");
}

TEST(ExactCase, AMeasuredNanHasDiverged) {
  const JudgedScene scene(
      "function exact() return 1, \"m\" end\n"
      "function measured(t) return t < 0.5 and 1 or 0 / 0 end");
  EXPECT_TRUE(std::isinf(scene.Error()));
}

TEST(ExactCase, WithoutExactTheReferenceRunsAt32TimesTheRate) {
  const JudgedScene scene("function on_tick(t) end");
  const HardCase hard = scene.Case();
  EXPECT_EQ(hard.truth, Truth::kConverged);
  EXPECT_FALSE(hard.judge);
  EXPECT_EQ(hard.unit, "m");
}

TEST(ExactCase, TheSuppliedScenesFollowTheirAnswers) {
  const auto error = [](const std::string& name, const Solver& solver) {
    const HardCase hard = SceneCase("scenes/exact/" + name + ".toml", 0);
    return Observe(hard, WithSolver(LoadHardScene(hard), solver), hard.seconds).error;
  };
  Solver fine;
  fine.substeps = 32;
  EXPECT_LT(error("brake", StockSolver()), 1e-4);
  EXPECT_GT(error("oscillator", StockSolver()), 0.2) << "a soft joint damps";
  EXPECT_LT(error("oscillator", fine), 0.06);
  EXPECT_GT(error("swing", StockSolver()), 0.5) << "a hinge loses energy";
  EXPECT_LT(error("swing", fine), 0.15);
}

struct Mistake {
  const char* code;
  int line;          ///< of the code, from 1
  const char* what;  ///< behind "FILE:LINE: "
};

TEST(ExactCase, EveryMistakeIsOneLineWithFileAndLine) {
  const char* const kMeasuredNothing =
      "function exact() return 1 end\n"
      "function measured(t) end";
  const Mistake mistakes[] = {
      {"function exact(t)\nend", 1,
       "exact(0): expected poses by part, {ball = {x = 1, y = 2}}, or a number; it returns "
       "nothing"},
      {"\nfunction exact(t) return true end", 2,
       "exact(0): expected poses by part, {ball = {x = 1, y = 2}}, or a number; it returns a "
       "boolean"},
      {"function exact(t) return {1, 2} end", 1,
       "exact(0): expected poses by part, {ball = {x = 1, y = 2}}, or a number; it returns an "
       "array"},
      {"function exact(t) return {} end", 1, "exact(0): no part is in the table"},
      {"function exact(t) return {bal = {x = 1}} end", 1, "exact(0): the scene has no part 'bal'"},
      {"function exact(t) return {ball = 3} end", 1,
       "exact(0): part 'ball': expected {x = m, y = m, angle = rad}, or some of these, not an "
       "integer"},
      {"function exact(t) return {ball = {z = 1}} end", 1,
       "exact(0): part 'ball': a pose has x, y and angle, not 'z'"},
      {"function exact(t) return {ball = {x = \"1\"}} end", 1, "exact(0): part 'ball': x is text"},
      {"function exact(t) return {ball = {x = 1 / (t - 0.5)}} end", 1,
       "exact(0.5): part 'ball': x is not finite"},
      {"function exact(t) return {ball = print} end", 1, "a function is no value here"},
      {"function exact(t) return 0 / 0 end", 1, "exact(0): the number is not finite"},
      {"function exact(t) return 1, \"m\" end", 1,
       "exact(0): in m, but without a function measured(t) it is compared with the energy, in J"},
      {"function exact(t) return 1, 2 end", 1,
       "exact(0): the number may be followed by its unit and its name, both text"},
      {"function exact(t) return t < 0.5 and 1 or {ball = {x = 1}} end", 1,
       "exact(0.5): poses at one time, a number at another"},
      {"function measured() return 1 end\n"
       "function exact(t) return 1, t < 0.5 and \"m\" or \"s\" end",
       2, "exact(0.5): another unit than before"},
      {kMeasuredNothing, 2, "measured(0): expected a number; it returns nothing"},
      {"function exact(t)\n  while true do end\nend", 2, "more than 200000 instructions in a tick"},
      {"while true do end", 1, "more than 200000 instructions in a tick"},
      {"function exact(t)\n  return {ball = {x = speed * t}}\nend", 2,
       "attempt to perform arithmetic on a nil value (global 'speed')"},
      {"function exact(t)\n  world.impulse(\"ball\", 1, 1)\nend", 2,
       "a scene that is judged cannot be changed by its exact answer"},
      {"function exact(t) return 1", 2, "'end' expected"},
      {"exact = 5", 1, "script 'truth': exact is no function"},
      {"function exact(t) return 1 end\nmeasured = {}", 1,
       "script 'truth': measured is no function"},
      {"function measured(t) return 1 end", 1, "script 'truth' says measured(t), but not exact(t)"},
      {"function exact(t) return {ball = {x = 1e308}} end", 1,
       "exact(0): part 'ball': x is 1e+308, of at most 1e+09"},
      {"local n = 0\nfunction exact(t) n = n + 1 return n end", 2,
       "exact(0): another answer than before; it may depend on t alone"},
      {"function exact(t) return 1, \"m\" end\n"
       "function measured(t) return t < 0.5 and 1 or \"much\" end",
       2, "measured(0.5): expected a number; it returns text"},
      {"function exact(t) return 1, \"m\" end\n"
       "function measured(t)\n  if t > 0.5 then error(\"late\") end\n  return 1\nend",
       3, "late"},
  };
  for (const Mistake& mistake : mistakes) {
    const JudgedScene scene(mistake.code);
    const std::string begin = scene.path + ":" + std::to_string(9 + mistake.line) + ": ";
    try {
      scene.Case();
      ADD_FAILURE() << "accepted: " << mistake.code;
    } catch (const OperatorError& e) {
      const std::string said = e.what();
      EXPECT_EQ(said.rfind(begin, 0), 0u) << said << "\nof " << mistake.code;
      EXPECT_NE(said.find(mistake.what), std::string::npos) << said << "\nof " << mistake.code;
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
  }
}

TEST(ExactCase, TwoAnswersOrTwoScenesOfOneNameAreRefused) {
  const LabWorkspace files;
  const std::string script =
      "[[script]]\nname = \"NAME\"\ncode = 'function exact() return 1 end'\n";
  std::string a = script, b = script;
  files.Write("my.toml",
              kThrown + a.replace(a.find("NAME"), 4, "a") + b.replace(b.find("NAME"), 4, "b"));
  const auto said = [](const std::vector<std::string>& paths) -> std::string {
    try {
      SceneCases(paths, 0);
    } catch (const OperatorError& e) {
      return e.what();
    }
    return "nothing";
  };
  EXPECT_EQ(said({files / "my.toml"}),
            files / "my.toml" + ":12: scripts 'a' and 'b' both say exact(t)");
  files.Write("one.toml", kThrown);
  EXPECT_EQ(said({files / "one.toml", files / "one.toml"}),
            files / "one.toml" + ": there is another case 'one'");
  EXPECT_EQ(said({files / "none.toml"}), files / "none.toml" + ": no such scene file");
}

TEST(ExactCase, RefusesASceneWithoutMovingParts) {
  const LabWorkspace files;
  files.Write("wall.toml", "[[part]]\nname = \"wall\"\nbox = [1, 1]\nanchored = true\n");
  try {
    SceneCase(files / "wall.toml", 0);
    ADD_FAILURE() << "accepted";
  } catch (const OperatorError& e) {
    EXPECT_EQ(e.what(), files / "wall.toml" + ": nothing moves, and no script says exact(t)");
  }
}

TEST(ExactCase, AHardScenesFileIsItsHardCases) {
  const std::vector<HardCase> cases = SceneCases({"scenes/hard/pendulum.toml"}, 0);
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "pendulum-energy");
  EXPECT_EQ(cases[1].name, "pendulum-period");
  EXPECT_EQ(LoadHardScene(cases[0], "nowhere").name, "pendulum");
}

TEST(ExactCase, AScriptOfAGameMayStillBeginByChangingItsWorld) {
  const JudgedScene scene(
      "world.set(\"ball\", \"value0\", 1)\nworld.say(\"welcome\")\n"
      "local x0 = world.part(\"ball\").x\n"
      "function exact(t) return {ball = {x = x0 + 3 * t}} end");
  EXPECT_LT(scene.Error(), 1e-5);
}

}  // namespace lab_exact_case_test
}  // namespace seam
