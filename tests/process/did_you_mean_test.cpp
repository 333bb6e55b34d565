/// A mistyped flag, subcommand, scene or name is one line with a suggestion.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/base/nearest.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace did_you_mean_test {

using Words = std::vector<std::string>;

TEST(NearestName, AllowsOneMistakeInAShortWordAndAThirdInALongOne) {
  const Words known = {"ann", "bob", "rollback"};
  EXPECT_EQ(NearestName("bbo", known), "bob") << "two letters swapped are one mistake";
  EXPECT_EQ(NearestName("an", known), "ann");
  EXPECT_EQ(NearestName("abc", known), "");
  EXPECT_EQ(NearestName("rolback", known), "rollback");
  EXPECT_EQ(NearestName("rolkbac", known), "rollback");
  EXPECT_EQ(NearestName("fallback", known), "rollback");
  EXPECT_EQ(NearestName("feedback!", known), "");
  EXPECT_EQ(NearestName("", known), "");
}

/// The one line of a refused command, status 2.
std::string Refused(Words words) {
  words[0] = BuiltProgram(words[0]);
  Program run(words, Root().string());
  EXPECT_TRUE(run.Wait(60));
  EXPECT_EQ(run.status(), 2) << run.Story();
  EXPECT_EQ(run.output(), "");
  const std::string line = run.errors();
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
  return line;
}

TEST(DidYouMean, EveryProgramSuggestsFlags) {
  const std::pair<Words, const char*> mistakes[] = {
      {{"seam-server", "crossing", "--durtion", "3"}, "--duration"},
      {{"seam-client", "--nmae", "ann"}, "--name"},
      {{"seam-render", "a.lcm", "--zomo=2"}, "--zoom"},
      {{"seam-measure", "a.lcm", "--mroe"}, "--more"},
      {{"seam-export", "a.lcm", "--jsn"}, "--json"},
      {{"seam-lab", "run", "crossing", "--ipmair", "demo", "-o", "x.lcm"}, "--impair"}};
  for (const auto& [words, meant] : mistakes) {
    const std::string line = Refused(words);
    EXPECT_NE(line.find(std::string("(did you mean '") + meant + "'?)"), std::string::npos) << line;
    EXPECT_NE(line.find("; see " + words[0] + " --help"), std::string::npos) << line;
  }
  EXPECT_EQ(Refused({"seam-lab", "run", "crossing", "-o", "x.lcm", "--ipmair", "demo"}),
            "seam-lab: there is no flag --ipmair of run (did you mean '--impair'?); see seam-lab "
            "--help\n");
  EXPECT_EQ(Refused({"seam-server", "--xyzzyxyzzy"}),
            "seam-server: there is no flag --xyzzyxyzzy; see seam-server --help\n");
}

TEST(DidYouMean, AShippedSceneIsFoundFromAnyFolder) {
  const Workspace elsewhere;
  Program run({BuiltProgram("seam-lab"), "check", "crossing"}, elsewhere.path());
  EXPECT_TRUE(run.Wait(60));
  EXPECT_EQ(run.status(), 0) << run.Story();
}

TEST(DidYouMean, SuggestsSubcommandsScenesAndNames) {
  const std::pair<Words, const char*> mistakes[] = {
      {{"seam-lab", "sweeep", "x.toml"}, "sweep"},
      {{"seam-lab", "run", "--drive", "scrpt", "crossing", "-o", "x.lcm"}, "script"},
      {{"seam-lab", "physics", "-o", "x.csv", "--cases", "archh"}, "arch"},
      {{"seam-lab", "titles", "obstcle", "-o", "x.csv"}, "obstacle"},
      {{"seam-lab", "run", "archh", "-o", "x.lcm"}, "arch"},  // of scenes/hard
      {{"seam-server", "crosing"}, "crossing"},
      {{"seam-server", "crossing", "--mode", "bufer"}, "buffer"},
      {{"seam-server", "crossing", "--reconcile", "rolback"}, "rollback"},
      {{"seam-server", "crossing", "--impair", "dmeo"}, "demo"}};
  for (const auto& [words, meant] : mistakes) {
    const std::string line = Refused(words);
    EXPECT_NE(line.find(std::string("did you mean '") + meant + "'?"), std::string::npos) << line;
  }
}

}  // namespace did_you_mean_test
}  // namespace seam
