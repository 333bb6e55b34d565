/// `seam-lab tune gait`: the search, the values of an objective, and reproducible runs.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/check.h"
#include "tests/lab/gait/cma_es.h"
#include "tests/lab/gait/gains_text.h"
#include "tests/lab/gait/gait_tune.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_gait_test {

/// Least value found in so many generations.
template <class Function>
double Least(Function f, int n, int generations, std::uint64_t seed) {
  CmaEs search(CmaEs::Point::Constant(n, 1.5), 0.5, 0, seed);
  double least = 1e300;
  for (int g = 0; g < generations; ++g) {
    std::vector<double> values;
    for (const CmaEs::Point& x : search.Ask()) values.push_back(f(x));
    for (const double value : values) least = std::min(least, value);
    search.Tell(values);
  }
  return least;
}

/// Axes a thousand times as long as others, and none along a coordinate.
double RotatedEllipsoid(const CmaEs::Point& x) {
  const Eigen::Index n = x.size();
  CmaEs::Point y = x;
  for (Eigen::Index i = 0; i + 1 < n; ++i) {  // Givens rotations by 0.7 rad
    const double a = y[i], b = y[i + 1];
    y[i] = std::cos(0.7) * a - std::sin(0.7) * b;
    y[i + 1] = std::sin(0.7) * a + std::cos(0.7) * b;
  }
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    sum += std::pow(1e6, static_cast<double>(i) / static_cast<double>(n - 1)) * y[i] * y[i];
  }
  return sum;
}

double Rosenbrock(const CmaEs::Point& x) {
  double sum = 0;
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i) {
    sum += 100 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1 - x[i], 2);
  }
  return sum;
}

TEST(CmaEs, FindsTheMinimumOfARotatedEllipsoid) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    EXPECT_LT(Least(RotatedEllipsoid, 8, 600, seed), 1e-9) << seed;
    // It can fail: so few generations are not enough.
    EXPECT_GT(Least(RotatedEllipsoid, 8, 30, seed), 1e-3) << seed;
  }
}

TEST(CmaEs, FindsTheEndOfRosenbrocksValley) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    EXPECT_LT(Least(Rosenbrock, 6, 800, seed), 1e-9) << seed;
  }
}

TEST(CmaEs, ANanValueIsTheWorst) {
  const auto half = [](const CmaEs::Point& x) { return x[0] > 1.6 ? NAN : x.squaredNorm(); };
  EXPECT_LT(Least(half, 3, 150, 1), 1e-9);
}

/// The file of the jump with other lines, written to a scratch file.
class LabGait : public testing::Test {
 protected:
  std::string Write(const std::string& text) const {
    files_.Write("objective.toml", text);
    return files_ / "objective.toml";
  }
  std::string Mistake(const std::string& text) const {
    try {
      ReadGaitFile(Write(text));
    } catch (const OperatorError& error) {
      const std::string what = error.what();
      return what.substr(what.find("objective.toml"));
    }
    return "none";
  }
  const LabWorkspace files_;
};

constexpr const char* kStarts =
    "train = {from = 1, count = 2}\nheld_out = {from = 11, count = 2}\n";
constexpr const char* kGain =
    "[[gain]]\nname = \"step_time\"\nsigma = 0.03\nmin = 0.2\nmax = 0.5\n";

TEST_F(LabGait, ATuneOfTwoGenerationsIsReproducibleAtAnyNumberOfJobs) {
  GaitFile file = ReadGaitFile(Write(std::string("ability = \"walk\"\nlambda = 4\n") + kStarts +
                                     "generations = 2\n" + kGain));
  const auto run = [&](int jobs, int seed) {
    file.seed = seed;
    std::vector<double> seen;
    const GaitResult result = TuneGait(file, jobs, [&](const GaitGeneration& g) {
      seen.insert(seen.end(), {g.best, g.median, g.sigma});
    });
    seen.push_back(static_cast<double>(result.gains.step_time));
    EXPECT_LE(result.after, result.before);
    return seen;
  };
  const std::vector<double> once = run(1, 1);
  EXPECT_EQ(once.size(), 7u);
  EXPECT_EQ(run(3, 1), once);
  EXPECT_NE(run(3, 2), once);
}

TEST_F(LabGait, EachAbilityOfTheFolderIsReadAndItsTrialsRun) {
  for (const Ability& ability : Abilities()) {
    const GaitFile file = ReadGaitFile("tests/lab/gaits/" + ability.name + ".toml");
    EXPECT_EQ(file.ability, ability.name);
    const GaitTrial trial = ability.run({file.solver, file.character}, CharacterGains{}, 1);
    EXPECT_TRUE(std::isfinite(trial.cost)) << ability.name;
    EXPECT_GE(trial.cost, 0) << ability.name;
    EXPECT_FALSE(trial.group.empty()) << ability.name;
  }
}

TEST_F(LabGait, ACharacterWithOtherGainsMovesDifferently) {
  CharacterGains weak;
  weak.torso_stiffness = weak.swing_stiffness = 0.01f;
  const Ability& walk = *FindAbility("walk");
  EXPECT_TRUE(walk.run({"substeps = 4", ""}, CharacterGains{}, 1).good);
  EXPECT_FALSE(walk.run({"substeps = 4", ""}, weak, 1).good);
}

TEST_F(LabGait, EachMistakeIsOneLine) {
  const std::string ability = "ability = \"walk\"\n";
  EXPECT_EQ(Mistake(ability + kStarts + kGain), "none");
  EXPECT_EQ(Mistake("ability = \"fly\"\n" + std::string(kStarts) + kGain),
            "objective.toml:1: objective: no ability 'fly' (there are jump, swim, float, plunge, "
            "rise, stairs, descent, slope, shove, walk, climb, limp)");
  EXPECT_EQ(
      Mistake(ability + kStarts + "[[gain]]\nname = \"step_tim\"\nsigma = 0.1\nmin = 0\nmax = 1\n"),
      "objective.toml:5: gain: there is no gain 'step_tim'; see character_gains.inc");
  EXPECT_EQ(
      Mistake(ability + kStarts +
              "[[gain]]\nname = \"step_time\"\nsigma = 0.1\nmin = 0.5\nmax = 1\n"),
      fmt::format("objective.toml:4: gain: step_time is built in as {}, outside of its bounds",
                  CharacterGains{}.step_time));
  EXPECT_EQ(Mistake(ability + kStarts + kGain + kGain),
            "objective.toml:1: objective: gain 'step_time' stands there twice");
  EXPECT_EQ(Mistake(ability + "train = {from = 1, count = 9}\nheld_out = {from = 9, count = 2}\n" +
                    kGain),
            "objective.toml:3: objective: a start that is trained on is not held out");
  EXPECT_EQ(Mistake(ability + kStarts),
            "objective.toml:1: objective: which gains? each is a [[gain]]");
}

TEST_F(LabGait, AnAbilityThatIsAlsoTrainedCountsByItsWeight) {
  const std::string text =
      std::string("ability = \"walk\"\nlambda = 4\n") + kStarts + "generations = 1\n" + kGain;
  const auto before = [&](const std::string& more) {
    GaitFile file = ReadGaitFile(Write(text + more));
    file.generations = 0;
    return TuneGait(file, 1, [](const GaitGeneration&) {}).before;
  };
  const double alone = before("");
  EXPECT_GT(alone, 0);
  const std::string also =
      "[[also]]\nability = \"walk\"\nweight = 2\ntrain = {from = 1, count = 2}\n";
  EXPECT_NEAR(before(also), 3 * alone, 1e-9);
  EXPECT_EQ(Mistake(text + "[[also]]\nability = \"fly\"\n").substr(0, 40),
            "objective.toml:12: also: no ability 'fly");
}

TEST_F(LabGait, OnlyTheValuesOfTheGainsFileChange) {
  const std::string path = "common/stages/character/character_gains.inc";
  std::ifstream in(path);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  CharacterGains gains;
  EXPECT_EQ(WithGains(text, gains).size(), text.size()) << "shortest decimals stand there already";
  gains.step_time = 0.1f;
  const std::string changed = WithGains(text, gains);
  EXPECT_NE(changed.find("\nSEAM_GAIN(step_time, 0.1f)\n"), std::string::npos);
  EXPECT_THROW(WithGains("SEAM_GAIN(servo_rate, 1.0f)\n", gains), OperatorError);
}

TEST(LabGaitProgram, WritesTheGainsFileOnlyWhenAsked) {
  const LabWorkspace files;
  files.Write("walk.toml",
              std::string("ability = \"walk\"\nlambda = 4\ngenerations = 1\n") + kStarts + kGain);
  const auto run = [&](const std::vector<std::string>& more, int status) {
    std::vector<std::string> words = {LabProgram(), "tune", "gait", files / "walk.toml"};
    words.insert(words.end(), more.begin(), more.end());
    ChildProcess lab(words);
    EXPECT_TRUE(lab.Wait(120));
    EXPECT_EQ(lab.exit_status(), status) << lab.output();
    return lab.output();
  };
  const std::string said = run({}, 0);
  EXPECT_NE(said.find("generation   1: best "), std::string::npos) << said;
  EXPECT_NE(said.find("held out, starts 11 to 12"), std::string::npos) << said;
  EXPECT_EQ(files.Names(), std::vector<std::string>{"walk.toml"});
  files.Write("wrong.inc", "SEAM_GAIN(servo_rate, 25.0f)\n");
  run({"-o", files / "wrong.inc"}, 2);
  std::ifstream in("common/stages/character/character_gains.inc");
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  files.Write("right.inc", text + "// the end\n");
  run({"--generations", "0", "-o", files / "right.inc"}, 0);
  EXPECT_EQ(files.Read("right.inc"), text + "// the end\n") << "nothing was searched";
}

}  // namespace lab_gait_test
}  // namespace seam
