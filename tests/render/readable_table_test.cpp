/// The table of measures for a terminal.

#include "render/measure/readable_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace seam {
namespace readable_table_test {

MeasuredRun Made(const std::string& name, const std::string& mode, std::int64_t seed,
                 double error) {
  MeasuredRun run;
  run.run = name;
  run.room.scene_name = "crossing";
  run.room.mode = mode;
  run.room.impair = "demo";
  run.room.seed = seed;
  run.measures.compared = 100;
  run.measures.error_others_m = error;
  run.measures.path_error_rms_m = error / 10;
  run.measures.bytes_per_s = 4598.58;
  run.measures.seen = 0.0305;
  return run;
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Returns the number of characters of UTF-8 text.
long Characters(const std::string& text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
}

/// Returns the line that begins with `name`; "" if there is none.
std::string LineOf(const std::string& table, const std::string& name) {
  for (const std::string& line : LinesOf(table)) {
    if (line.rfind(name, 0) == 0) return line;
  }
  return "";
}

TEST(ReadableTable, HasMeasuresDownwardsRunsAcrossAndUnitsOfDailyLife) {
  const std::string table =
      FormatReadable({Made("a", "strict", 1, 2.39807), Made("b", "oracle", 2, 0.0244)}, 80, true);
  EXPECT_EQ(LinesOf(table)[0], "crossing, network demo") << table;
  const std::string error = LineOf(table, "others' error, present");
  EXPECT_NE(error.find(" 2.40 m "), std::string::npos) << table;
  EXPECT_NE(error.find(" 24 mm *"), std::string::npos) << "the best has a star\n" << table;
  EXPECT_NE(LineOf(table, "others' error, as shown").find(" 24 cm"), std::string::npos) << table;
  EXPECT_NE(LineOf(table, "errors seen").find("3.0 %    "), std::string::npos) << table;
  EXPECT_EQ(LineOf(table, "errors seen").find('*'), std::string::npos) << "both are equal";
  EXPECT_NE(LineOf(table, "traffic of a client").find("4.6 kB/s"), std::string::npos) << table;
  EXPECT_EQ(LineOf(table, "rebound"), "") << "no run has it";
  EXPECT_NE(LineOf(table, "method").find("strict"), std::string::npos);
}

TEST(ReadableTable, RunsOfOneSettingShareAColumnOfMedians) {
  std::vector<MeasuredRun> runs = {Made("a", "strict", 1, 3), Made("b", "oracle", 1, 0.5),
                                   Made("c", "strict", 2, 1), Made("d", "strict", 3, 2)};
  const std::string table = FormatReadable(runs, 80, true);
  EXPECT_NE(LinesOf(table)[1].find("median of 3"), std::string::npos) << table;
  EXPECT_NE(LineOf(table, "others' error, present").find("2.00 m"), std::string::npos) << table;
  EXPECT_NE(LineOf(table, "seed").find("1 2 3"), std::string::npos) << table;
  const std::string apart = FormatReadable(runs, 80, false);
  EXPECT_EQ(apart.find("median"), std::string::npos) << apart;
  EXPECT_NE(LineOf(apart, "others' error, present").find("3.00 m"), std::string::npos) << apart;
  // Of an even number the lower of the two in the middle, as in all tables; invalid ones do not
  // count.
  runs[3].valid = "no hand-over";
  const std::string two = FormatReadable(runs, 80, true);
  EXPECT_NE(two.find("median of 2"), std::string::npos) << two;
  EXPECT_NE(LineOf(two, "others' error, present").find(" 1.00 m"), std::string::npos) << two;
}

TEST(ReadableTable, ExplainsARunThatIsNotValidAndShowsNoFigureOfIt) {
  std::vector<MeasuredRun> runs = {Made("good", "strict", 1, 3), Made("bad", "oracle", 1, 0.001)};
  runs[1].valid = "no contact between two players' bodies";
  const std::string table = FormatReadable(runs, 80, true);
  const std::string error = LineOf(table, "others' error, present");
  EXPECT_NE(error.find("–"), std::string::npos) << table;
  EXPECT_EQ(error.find("1.0 mm"), std::string::npos) << table;
  EXPECT_EQ(error.find('*'), std::string::npos) << "there is nothing to be better than";
  EXPECT_NE(LineOf(table, "bad is not valid: no contact between two players' bodies: "), "")
      << table;
  runs[0].lacks = "50 messages missing";
  EXPECT_NE(LineOf(FormatReadable(runs, 80, true), "good lacks 50 messages missing"), "");
}

TEST(ReadableTable, NoLineIsWiderThanTheTerminal) {
  std::vector<MeasuredRun> runs;
  for (int i = 0; i < 23; ++i) {
    runs.push_back(Made("run-number-" + std::to_string(i), "strict", i, 1.0 + i));
  }
  for (const int width : {60, 80, 120, 200}) {
    const std::string table = FormatReadable(runs, static_cast<std::size_t>(width), false);
    std::istringstream stream(table);
    const std::set<std::string> words{std::istream_iterator<std::string>(stream), {}};
    for (const std::string& line : LinesOf(table)) EXPECT_LE(Characters(line), width) << line;
    for (const MeasuredRun& run : runs) {
      EXPECT_TRUE(words.count(run.run)) << run.run;
    }
  }
  EXPECT_EQ(FormatReadable({}, 80, true), "");
}

TEST(ReadableTable, OneRunNeedsNoStarsAndNoLegend) {
  const std::string table = FormatReadable({Made("a", "strict", 1, 2)}, 80, true);
  EXPECT_EQ(table.find('*'), std::string::npos) << table;
}

}  // namespace readable_table_test
}  // namespace seam
