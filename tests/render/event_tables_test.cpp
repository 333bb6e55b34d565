/// The events of a recording as other programs read them.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace event_tables_test {

using Words = std::vector<std::string>;

std::string Output(Words words, int status = 0) {
  if (words[0] != "python3") words[0] = BuiltProgram(words[0]);
  Program program(words);
  EXPECT_TRUE(program.Wait(120));
  EXPECT_EQ(program.status(), status) << program.Story();
  return status == 0 ? program.output() : program.errors();
}

TEST(EventTables, AStockReaderReadsBackWhatSeamLogPrints) {
  LabWorkspace files;
  Program lab({LabProgram(), "run", (Root() / "scenes/crossing.toml").string(), "--impair", "4g",
               "--duration", "4", "--no-floor", "-o", files / "run.lcm"});
  ASSERT_TRUE(lab.Wait(120));
  ASSERT_EQ(lab.status(), 0) << lab.Story();
  Output({"seam-export", files / "run.lcm", "--events", files / "events.csv", "--metrics",
          files / "metrics.csv"});
  files.Write("events.jsonl", Output({"seam-log", "events", files / "run.lcm", "--json"}));
  Output({"python3", (Root() / "tests/render/check_events.py").string(), files / "events.csv",
          files / "metrics.csv", files / "events.jsonl"});
  const std::string text = Output({"seam-log", "events", files / "run.lcm"});
  EXPECT_NE(text.find("joined        ann is ready as peer 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("session "), std::string::npos) << "and the sum: " << text;
  // The list counts them.
  const std::string list = Output({"seam-log", "list", files / "run.lcm"});
  const auto lines = std::count(text.begin(), text.end(), '\n') - 4;
  EXPECT_NE(list.find("  " + std::to_string(lines) + "\n"), std::string::npos) << list << text;
}

TEST(EventTables, MistakesAreOneLine) {
  LabWorkspace files;
  files.Write("there.csv", "x");
  EXPECT_NE(Output({"seam-export", files / "no.lcm"}, 2).find("--events FILE"), std::string::npos);
  const std::string errors =
      Output({"seam-export", files / "no.lcm", "--events", files / "there.csv"}, 2);
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  const std::string no_store = Output({"seam-log", "top", files / "absent.db"}, 2);
  EXPECT_EQ(std::count(no_store.begin(), no_store.end(), '\n'), 1) << no_store;
}

}  // namespace event_tables_test
}  // namespace seam
