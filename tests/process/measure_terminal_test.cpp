/// seam-measure at a terminal prints the table for people; into a pipe, and with --wide, a line a
/// run.

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace measure_terminal_test {

/// Two logs of one setting.
class MeasureAtATerminal : public ::testing::Test {
 protected:
  static std::string Log(int seed) { return *folder_ / (std::to_string(seed) + ".lcm"); }

  static void SetUpTestSuite() {
    folder_ = std::make_unique<Workspace>();
    for (const int seed : {1, 2}) {
      Program lab({BuiltProgram("seam-lab"), "run", "crossing", "--duration", "3", "--no-floor",
                   "--force", "--seed", std::to_string(seed), "-o", Log(seed)},
                  Root().string());
      ASSERT_TRUE(lab.Wait(60) && lab.status() == 0) << lab.Story();
    }
  }

  /// Returns the output of seam-measure with these words; in a terminal of 80 columns, or a pipe.
  static std::string Measured(const std::string& words, bool terminal) {
    const std::string command = BuiltProgram("seam-measure") + " " + words + " 2>/dev/null";
    Program program(terminal ? std::vector<std::string>{"script", "-qec", command, "/dev/null"}
                             : std::vector<std::string>{"sh", "-c", command});
    EXPECT_TRUE(program.Wait(60));
    EXPECT_EQ(program.status(), 0) << program.Story();
    return program.output();
  }

  static void TearDownTestSuite() { folder_.reset(); }
  inline static std::unique_ptr<const Workspace> folder_;
};

TEST_F(MeasureAtATerminal, PrintsMeasuresDownwardsAndThePipeARow) {
  const std::string logs = Log(1) + " " + Log(2);
  const std::string people = Measured(logs, true);
  EXPECT_NE(people.find("crossing, network demo"), std::string::npos) << people;
  EXPECT_NE(people.find("median of 2"), std::string::npos) << people;
  EXPECT_NE(people.find("others' error, as shown"), std::string::npos) << people;
  EXPECT_EQ(people.find("error_others_m"), std::string::npos) << people;
  const std::string pipe = Measured(logs, false);
  EXPECT_EQ(pipe.rfind("scene     run  mode ", 0), 0u) << pipe;
  EXPECT_EQ(pipe.find("median"), std::string::npos) << pipe;
  std::string wide = Measured("--wide " + logs, true);
  std::string without;
  for (const char c : wide) without += c == '\r' ? "" : std::string(1, c);
  EXPECT_EQ(without, pipe);
}

TEST_F(MeasureAtATerminal, NamesKeepRunsApart) {
  const std::string people = Measured("--names first,second " + Log(1) + " " + Log(2), true);
  EXPECT_NE(people.find("first"), std::string::npos) << people;
  EXPECT_NE(people.find("second"), std::string::npos) << people;
  EXPECT_EQ(people.find("median"), std::string::npos) << people;
}

}  // namespace measure_terminal_test
}  // namespace seam
