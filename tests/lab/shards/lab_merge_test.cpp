/// Shards of a table, made by processes that know nothing of each other, and put together.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "common/base/check.h"
#include "tests/lab/experiment/build_id.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/experiment/shard.h"
#include "tests/lab/shards/merge.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_merge_test {

const std::set<std::string> kTimes = {"cpu_s"};

/// Squares of 0 to 39, in two scenes, and a time that differs from run to run.
Experiment Squares(const std::string& commit = "abc", const std::string& folder = "some") {
  Experiment experiment;
  experiment.key_columns = "version,commit,scene,scene_hash,number";
  experiment.value_columns = "square,cpu_s";
  for (int i = 0; i < 40; ++i) {
    experiment.keys.push_back(
        "1," + commit +
        (i % 2 == 0 ? ",\"" + folder + "/a,b.toml\",0f," : "," + folder + "/c.toml,1f,") +
        std::to_string(i));
  }
  experiment.measure = [](std::size_t row) {
    static int runs = 0;
    return std::to_string(row * row) + ",0.0" +
           std::to_string(row % 7 + static_cast<std::size_t>(++runs));
  };
  return experiment;
}

TableFlags Flags(const std::string& table, const std::string& shard = "") {
  TableFlags flags;
  flags.table = table;
  flags.shard = shard;
  flags.quiet = true;
  flags.jobs = 2;
  return flags;
}

/// Drops the last column, the times, of each line.
std::string WithoutTimes(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const std::size_t comma = text.rfind(',', end);
    out += text.substr(at, comma - at) + '\n';
    at = end + 1;
  }
  return out;
}

class Merge : public ::testing::Test {
 protected:
  void MakeShards(int count) {
    for (int i = 0; i < count; ++i) {
      const std::string shard = std::to_string(i) + "/" + std::to_string(count);
      EXPECT_EQ(CompleteShard(Squares(), Flags(files_ / "parts", shard), "squares"), 0);
      tables_.push_back(files_ / ("parts/squares." + std::to_string(i) + "-of-" +
                                  std::to_string(count) + ".csv"));
    }
  }
  MergeCommand Command() const {
    MergeCommand command;
    command.tables = tables_;
    command.whole = files_ / "whole.csv";
    command.force = true;
    return command;
  }
  /// Returns the one line that a merge is refused with; "": it is not.
  std::string Refusal(const Experiment& experiment, const MergeCommand& command) const {
    try {
      MergeTables(experiment, kTimes, command);
    } catch (const OperatorError& error) {
      return error.what();
    }
    return "";
  }
  void Change(const std::string& path, const std::string& from, const std::string& to) const {
    std::string text = files_.Read(path);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    files_.Write(path, text.replace(at, from.size(), to));
  }

  LabWorkspace files_;
  std::vector<std::string> tables_;
};

TEST_F(Merge, TheShardsTogetherAreTheTableOfOneProcess) {
  EXPECT_EQ(CompleteShard(Squares(), Flags(files_ / "one.csv"), "squares"), 0);
  MakeShards(8);
  std::reverse(tables_.begin(), tables_.end());
  EXPECT_EQ(MergeTables(Squares(), kTimes, Command()), 0);
  EXPECT_EQ(WithoutTimes(files_.Read("whole.csv")), WithoutTimes(files_.Read("one.csv")));
}

TEST_F(Merge, ShardsAreOfLikeSizeAndTheSameForAnotherBuild) {
  std::map<std::size_t, int> sizes;
  const std::vector<std::string> columns = {"version", "commit", "scene", "number"};
  for (int i = 0; i < 1000; ++i) {
    const std::string end = ".toml," + std::to_string(i);
    const std::size_t shard = ShardOf(columns, "1,abc,here/c" + end, 8);
    EXPECT_EQ(shard, ShardOf(columns, "2,def,there/c" + end, 8));
    ++sizes[shard];
  }
  ASSERT_EQ(sizes.size(), 8u);
  for (const auto& [shard, size] : sizes) EXPECT_NEAR(size, 125, 40) << shard;
}

TEST_F(Merge, AValueThatIsNoNumberOrIsMissingIsRefused) {
  MakeShards(2);
  Experiment squares = Squares();
  EXPECT_EQ(Refusal(squares, Command()), "");
  squares.filled = {"square"};
  EXPECT_EQ(Refusal(squares, Command()), "");
  const std::string whole = files_.Read("parts/squares.0-of-2.csv");
  const std::size_t end = whole.rfind(",0.0"), begin = whole.rfind(',', end - 1) + 1;
  for (const std::string value : {"many", ""}) {
    files_.Write("parts/squares.0-of-2.csv", whole.substr(0, begin) + value + whole.substr(end));
    EXPECT_NE(Refusal(squares, Command()).find("square"), std::string::npos) << value;
  }
  squares.texts = {"square"};
  squares.filled.clear();
  EXPECT_EQ(Refusal(squares, Command()), "");
}

TEST_F(Merge, AMissingShardIsNamedAndNothingIsWrittenUnlessPartial) {
  MakeShards(4);
  tables_.erase(tables_.begin() + 2);
  MergeCommand command = Command();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(MergeTables(Squares(), kTimes, command), 1);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("run --shard 2/4\n"), std::string::npos) << said;
  EXPECT_EQ(files_.Names(), std::vector<std::string>{"parts"});
  command.partial = true;
  EXPECT_EQ(MergeTables(Squares(), kTimes, command), 1);
  // What there is counts for another number of shards.
  TableFlags rest = Flags(files_ / "rest", "0/1");
  rest.have = files_ / "parts/*.csv";
  EXPECT_EQ(CompleteShard(Squares(), rest, "squares"), 0);
  EXPECT_EQ(CsvTable::Load(files_ / "rest/squares.0-of-1.csv").rows(), 0u) << "all four are there";
}

/// 0 of 2 was stopped in its 14th row, and another shard of the folder has done some of them, too.
TEST_F(Merge, AShardGoesOnWithItsOwnRowsAlsoIfHaveNamesItsTable) {
  MakeShards(2);
  const std::string whole = files_.Read("parts/squares.0-of-2.csv");
  std::size_t end = 0;
  for (int line = 0; line < 14; ++line) end = whole.find('\n', end) + 1;
  files_.Write("parts/squares.0-of-2.csv", whole.substr(0, end + 3));
  TableFlags flags = Flags(files_ / "parts", "0/2");
  flags.have = files_ / "parts/*.csv";
  EXPECT_EQ(CompleteShard(Squares(), flags, "squares"), 0);
  EXPECT_EQ(files_.Read("parts/squares.0-of-2.csv").substr(0, end), whole.substr(0, end));
  EXPECT_EQ(WithoutTimes(files_.Read("parts/squares.0-of-2.csv")), WithoutTimes(whole));
  EXPECT_EQ(CompleteShard(Squares(), Flags(files_ / "parts", "2/5"), "squares"), 0);
  EXPECT_EQ(CompleteShard(Squares(), flags, "squares"), 0);
  EXPECT_EQ(WithoutTimes(files_.Read("parts/squares.0-of-2.csv")), WithoutTimes(whole));
  flags.force = true;
  EXPECT_EQ(CompleteShard(Squares(), flags, "squares"), 0);
  tables_.push_back(files_ / "parts/squares.2-of-5.csv");
  EXPECT_EQ(MergeTables(Squares(), kTimes, Command()), 0) << "no row is lost";
}

TEST_F(Merge, TheFolderOfASceneIsNotOfTheKey) {
  EXPECT_EQ(CompleteShard(Squares(), Flags(files_ / "one.csv"), "squares"), 0);
  MakeShards(1);
  const std::string parts = files_ / "parts/";
  for (const auto& [folder, shard] : {std::pair("here/and", "0/2"), std::pair("there", "1/2")}) {
    EXPECT_EQ(CompleteShard(Squares("abc", folder), Flags(parts, shard), "squares"), 0);
  }
  tables_ = {parts + "squares.0-of-2.csv", parts + "squares.0-of-1.csv",
             parts + "squares.1-of-2.csv"};
  EXPECT_EQ(Refusal(Squares(), Command()), "");
  EXPECT_EQ(WithoutTimes(files_.Read("whole.csv")), WithoutTimes(files_.Read("one.csv")))
      << "with the paths of the sweep that is merged";
  TableFlags rest = Flags(files_ / "rest", "0/1");
  rest.have = parts + "squares.0-of-2.csv";
  EXPECT_EQ(CompleteShard(Squares(), rest, "squares"), 0);
  EXPECT_LT(CsvTable::Load(files_ / "rest/squares.0-of-1.csv").rows(), 30u);
  TableFlags again = Flags(parts, "0/2");
  EXPECT_EQ(CompleteShard(Squares("abc", "elsewhere"), again, "squares"), 0) << "goes on";
}

TEST_F(Merge, TablesThatDisagreeAreRefusedInOneLineAndNothingIsWritten) {
  MakeShards(2);
  EXPECT_NE(Refusal(Squares("def"), Command()).find("has the commit abc, and this program def"),
            std::string::npos);
  MergeCommand twice = Command();
  twice.tables.push_back(twice.tables.front());
  EXPECT_EQ(Refusal(Squares(), twice), "") << "the same rows twice are no contradiction";
  files_.Write("copy.csv", files_.Read("parts/squares.0-of-2.csv"));
  const std::size_t row = files_.Read("copy.csv").find("toml");
  ASSERT_NE(row, std::string::npos);
  twice.tables.push_back(files_ / "copy.csv");
  std::string text = files_.Read("copy.csv");
  const std::size_t comma = text.rfind(',');
  text.insert(comma, "7");  // another square
  files_.Write("copy.csv", text);
  EXPECT_NE(Refusal(Squares(), twice).find("differ in square"), std::string::npos)
      << Refusal(Squares(), twice);
  files_.Write("copy.csv", text.substr(0, text.size() - 3));
  EXPECT_NE(Refusal(Squares(), twice), "") << "cut in a line";
  files_.Write("copy.csv", "a,b\n1,2\n");
  EXPECT_NE(Refusal(Squares(), twice).find("other columns"), std::string::npos);
  files_.Write("copy.csv", "");
  EXPECT_NE(Refusal(Squares(), twice), "");
  twice.tables.back() = files_ / "none.csv";
  EXPECT_NE(Refusal(Squares(), twice), "");
}

TEST_F(Merge, VerifyingFindsARowThatIsNotWhatItWas) {
  EXPECT_EQ(CompleteShard(Squares(), Flags(files_ / "one.csv"), "squares"), 0);
  VerifyCommand command;
  command.table = files_ / "one.csv";
  command.share_percent = 100;
  command.jobs = 2;
  command.quiet = true;
  EXPECT_EQ(VerifyTable(Squares(), kTimes, command), 0);
  Change("one.csv", ",1521,", ",1522,");
  EXPECT_EQ(VerifyTable(Squares(), kTimes, command), 1);
  command.share_percent = 5;
  int found = 0;
  for (command.seed = 1; command.seed <= 40; ++command.seed) {
    found += VerifyTable(Squares(), kTimes, command);
  }
  EXPECT_GT(found, 0) << "2 of 40 rows, 40 times";
  EXPECT_LT(found, 20);
}

TEST_F(Merge, AWrongShardIsRefused) {
  for (const char* text : {"", "3", "3/", "/3", "3/3", "-1/3", "0/0", "1/2/3", "1/2 ", "x/2"}) {
    EXPECT_THROW(ParseShard(text), OperatorError) << text;
  }
  EXPECT_EQ(ParseShard("7/8").index, 7u);
}

TEST(BuildId, TheArithmeticIsHashedInMillisecondsAndTheCommitIsKnown) {
  EXPECT_EQ(Numerics().size(), 16u);
  EXPECT_EQ(Numerics(), Numerics());
  EXPECT_FALSE(BuiltCommit().empty());
}

}  // namespace lab_merge_test
}  // namespace seam
