/// seam-export as a user runs it: each format is read back and compared with the recording.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "common/base/json_text.h"
#include "common/measure/mean_square.h"
#include "common/measure/table.h"
#include "common/record/log_file.h"
#include "render/export/formats.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace export_test {

using Words = std::vector<std::string>;

/// A line of CSV without quotes.
Words Fields(const std::string& line) {
  Words fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  if (!line.empty() && line.back() == ',') fields.emplace_back();
  return fields;
}

Words LinesOf(const std::string& text) {
  Words lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

class ExportProgram : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = std::make_unique<LabWorkspace>();
    Program lab({LabProgram(), "run", (Root() / "scenes/crossing.toml").string(), "--reconcile",
                 "fade", "--impair", "4g", "--seed", "7", "--duration", "4", "--no-floor", "-o",
                 Log()});
    ASSERT_TRUE(lab.Wait(120));
    ASSERT_EQ(lab.status(), 0) << lab.Story();
  }
  static void TearDownTestSuite() { files_.reset(); }

  static std::string Log() { return *files_ / "run.lcm"; }
  static std::string At(const std::string& name) { return *files_ / name; }

  /// Runs a program with these words; returns its stdout.
  static std::string Run(Words words, int status = 0) {
    words[0] = BuiltProgram(words[0]);
    Program program(words);
    EXPECT_TRUE(program.Wait(120));
    EXPECT_EQ(program.status(), status) << program.Story();
    errors_ = program.errors();
    return program.output();
  }
  static std::string Export(Words more, int status = 0) {
    Words words = {"seam-export", Log()};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words, status);
  }

  /// Returns seam-measure's value in a column of its table.
  static double Measured(const std::string& column, const Words& range) {
    Words words = {"seam-measure", Log(), "--csv", At("measure.csv")};
    words.insert(words.end(), range.begin(), range.end());
    Run(words);
    const Words columns = Fields(CsvHeader());
    const auto at = std::find(columns.begin(), columns.end(), column) - columns.begin();
    const Words row = Fields(LinesOf(files_->Read("measure.csv")).at(1));
    std::remove(At("measure.csv").c_str());
    return std::stod(row.at(static_cast<std::size_t>(at)));
  }

  static std::unique_ptr<LabWorkspace> files_;
  static std::string errors_;
};
std::unique_ptr<LabWorkspace> ExportProgram::files_;
std::string ExportProgram::errors_;

TEST_F(ExportProgram, TheTableHasEveryPoseOfTheRecordingAndItsError) {
  const Recording recording = ReadRecording(Log());
  const Oracle oracle = ComputeOracle(recording, JudgeOf(recording.room));
  const Scene scene = ParseScene(recording.room.scene_text, "crossing.toml");
  const Words lines = LinesOf(Export({"--csv"}));
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0], "tick,time_s,view,body,x,y,angle,vx,vy,spin,error_m");
  std::size_t next = 1, with_error = 0;
  for (std::int64_t tick = recording.first_tick; tick <= recording.last_tick; ++tick) {
    for (const auto& [peer, views] : recording.views) {
      const View* view = FindView(views, tick);
      for (std::size_t i = 0; view != nullptr && i < view->id.size(); ++i) {
        ASSERT_LT(next, lines.size());
        const Words row = Fields(lines[next++]);
        ASSERT_EQ(row.size(), 11u) << lines[next - 1];
        EXPECT_EQ(row[0], std::to_string(tick));
        EXPECT_NEAR(std::stod(row[1]), static_cast<double>(tick) / recording.room.tick_hz, 1e-6);
        EXPECT_EQ(row[2], peer == 0 ? "server" : scene.players[peer - 1u].name);
        EXPECT_EQ(row[3], scene.parts[static_cast<std::size_t>(view->id[i])].name);
        const float values[] = {view->x[i],  view->y[i],  view->angle[i],
                                view->vx[i], view->vy[i], view->spin[i]};
        for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(std::stof(row[4 + c]), values[c]);
        const auto truth = oracle.At(tick, view->id[i]);
        ASSERT_EQ(truth.has_value(), !row[10].empty()) << lines[next - 1];
        if (!truth) continue;
        ++with_error;
        const double error = std::hypot(double{view->x[i]} - double{truth->position.x()},
                                        double{view->y[i]} - double{truth->position.y()});
        EXPECT_NEAR(std::stod(row[10]), error, 1e-8 * (1 + error));
      }
    }
  }
  EXPECT_EQ(next, lines.size());
  EXPECT_GT(with_error, 1000u);
}

/// Root mean square of the last column.
double RootMeanSquare(const std::string& csv) {
  MeanSquare all;
  const Words lines = LinesOf(csv);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Words row = Fields(lines[i]);
    if (!row.back().empty()) all.Add(std::stod(row.back()) * std::stod(row.back()));
  }
  return all.RootOrZero();
}

TEST_F(ExportProgram, TheErrorsOfARangeAreThoseThatSeamMeasureFindsInIt) {
  std::vector<double> found;
  for (const Words& range : {Words{}, Words{"--from", "2", "--to", "3"}, Words{"--from", "2.5"}}) {
    Words words = {"--csv"};
    words.insert(words.end(), range.begin(), range.end());
    const double rms = RootMeanSquare(Export(words));
    const double measured = Measured("error_rms_m", range);
    EXPECT_GT(measured, 0.001);
    EXPECT_NEAR(rms, measured, 1e-5 * measured);
    found.push_back(rms);
  }
  EXPECT_NE(found[0], found[1]);  // the range does choose
  EXPECT_NE(found[1], found[2]);
}

TEST_F(ExportProgram, BothEndsOfARangeBelongToIt) {
  const Words lines = LinesOf(Export({"--csv", "--from", "1", "--to", "1.5", "--view", "ann"}));
  const int hz = ReadRecording(Log()).room.tick_hz;
  ASSERT_GT(lines.size(), 2u);
  EXPECT_EQ(Fields(lines[1])[0], std::to_string(hz));
  EXPECT_EQ(Fields(lines.back())[0], std::to_string(hz * 3 / 2));
}

TEST_F(ExportProgram, NamesChooseViewsAndBodies) {
  const Words all = LinesOf(Export({"--csv"}));
  Words expected = {all[0]};
  for (const std::string& line : all) {
    const Words row = Fields(line);
    if ((row[2] == "server" || row[2] == "bob") && row[3] == "car") expected.push_back(line);
  }
  ASSERT_GT(expected.size(), 100u);
  EXPECT_EQ(LinesOf(Export({"--csv", "--view", "server,bob", "--body", "car"})), expected);
  EXPECT_EQ(LinesOf(Export({"--csv", "--view", "bob", "--view", "server", "--body", "car"})),
            expected);
}

TEST_F(ExportProgram, JsonAndTraceAgreeWithTheTable) {
  for (const char* format : {"csv", "json", "trace"}) {
    Export({std::string("--") + format, "-o", At(std::string("all.") + format), "--force"});
  }
  Program check({"python3", (Root() / "tests/render/check_export.py").string(), At("all.csv"),
                 At("all.json"), At("all.trace")});
  ASSERT_TRUE(check.Wait(60));
  if (check.status() == 127) GTEST_SKIP() << "there is no python3";
  EXPECT_EQ(check.status(), 0) << check.Story();
}

TEST_F(ExportProgram, TheTracesStutterIsTheMeasuredOne) {
  // All views of this scene show the same number of bodies: each counter weighs the same.
  const std::string begin = "\"name\":\"stutter_mps2\",\"args\":{\"rms\":";
  MeanSquare all;
  for (const std::string& line : LinesOf(Export({"--trace"}))) {
    const std::size_t at = line.find(begin);
    if (at == std::string::npos) continue;
    const double value = std::stod(line.substr(at + begin.size()));
    all.Add(value * value);
  }
  const double measured = Measured("stutter_shown_mps2", {});
  EXPECT_GT(measured, 0.1);
  EXPECT_NEAR(all.RootOrZero(), measured, 1e-5 * measured);
}

TEST_F(ExportProgram, TheSameLogMakesTheSameBytes) {
  for (const char* format : {"--csv", "--json", "--mcap", "--trace"}) {
    EXPECT_EQ(Export({format}), Export({format})) << format;
  }
}

TEST_F(ExportProgram, MistakesAreOneLineAndStatusTwoAndLeaveFilesAsTheyWere) {
  files_->Write("old.csv", "precious");
  const Words names = files_->Names();
  const std::pair<Words, const char*> mistakes[] = {
      {{}, "one of --csv"},
      {{"--csv", "--json"}, "one of --csv"},
      {{"--csv", "--body", "carr"}, "did you mean 'car'?"},
      {{"--csv", "--body", "qqqqqqqqqqqq"}, "known are "},
      {{"--csv", "--view", "an"}, "did you mean 'ann'?"},
      {{"--csv", "--view", "nobody-here"}, "known are server ann bob"},
      {{"--csv", "--from", "3", "--to", "2"}, "--from must not be after --to"},
      {{"--csv", "--from", "900"}, "leave nothing"},
      {{"--csv", "-o", "/nowhere/a.csv"}, "/nowhere/a.csv: cannot be written: No such file"},
      {{"--csv", "-o", At("old.csv")}, "exists (--force replaces it)"},
      {{"--csv", "-o", Log(), "--force"}, "is read"},
      {{"--csv", "--room", "other"}, "other"},
      {{"--csv", "--nonsense"}, "--nonsense"}};
  for (const auto& [words, said] : mistakes) {
    EXPECT_EQ(Export(words, 2), "");
    EXPECT_EQ(std::count(errors_.begin(), errors_.end(), '\n'), 1) << errors_;
    EXPECT_EQ(errors_.rfind("seam-export: ", 0), 0u) << errors_;
    EXPECT_NE(errors_.find(said), std::string::npos) << errors_ << "does not say: " << said;
  }
  EXPECT_EQ(files_->Read("old.csv"), "precious");
  EXPECT_EQ(files_->Names(), names);  // no unfinished file either
  Export({"--csv", "-o", At("old.csv"), "--force"});
  EXPECT_EQ(files_->Read("old.csv"), Export({"--csv"}));
}

TEST_F(ExportProgram, ADiskThatIsFullIsOneLine) {
  const std::string command = BuiltProgram("seam-export") + " " + Log() + " --csv > /dev/full";
  Program shell({"sh", "-c", command});
  ASSERT_TRUE(shell.Wait(60));
  EXPECT_EQ(shell.status(), 2);
  EXPECT_EQ(shell.errors(), "seam-export: stdout: cannot be written: No space left on device\n");
}

TEST_F(ExportProgram, ADamagedLogIsExportedAsFarAsItIsGood) {
  std::string bytes = files_->Read("run.lcm");
  const std::string whole = Export({"--csv"});
  for (std::size_t at = bytes.size() / 2; at < bytes.size() / 2 + 2000; ++at) bytes[at] = 0;
  files_->Write("damaged.lcm", bytes);
  const std::string part = Run({"seam-export", At("damaged.lcm"), "--csv"}, 1);
  EXPECT_NE(errors_.find("damaged bytes skipped"), std::string::npos) << errors_;
  EXPECT_GT(part.size(), whole.size() / 2);
  EXPECT_LT(LinesOf(part).size(), LinesOf(whole).size());
  files_->Write("noise.lcm", std::string(5000, 'x'));
  EXPECT_EQ(Run({"seam-export", At("noise.lcm"), "--csv"}, 2), "");
  EXPECT_EQ(std::count(errors_.begin(), errors_.end(), '\n'), 1) << errors_;
}

/// The events of a log but for those of a channel.
void WriteWithout(const std::string& from, const std::string& to, const std::string& channel) {
  LogReader in(from);
  LogWriter out(to);
  for (LogEvent event; in.Next(&event);) {
    if (event.channel.find(channel) == std::string::npos) {
      out.Publish(event.channel, event.timestamp_us, {event.data.data(), event.data.size()});
    }
  }
}

TEST_F(ExportProgram, AMissingViewIsNamedAndTheRestIsExported) {
  WriteWithout(Log(), At("no-bob.lcm"), ".view.2");
  const std::string csv = Run({"seam-export", At("no-bob.lcm"), "--csv"});
  EXPECT_NE(errors_.find("no view of bob"), std::string::npos) << errors_;
  EXPECT_EQ(csv, Export({"--csv", "--view", "server,ann"}));
  EXPECT_EQ(errors_, "");  // who was not asked for is not missed
  WriteWithout(Log(), At("no-view.lcm"), ".view.");
  for (const char* format : {"--csv", "--json", "--mcap", "--trace"}) {
    EXPECT_FALSE(Run({"seam-export", At("no-view.lcm"), format}).empty()) << format;
    EXPECT_NE(errors_.find("no view of server, ann, bob"), std::string::npos) << errors_;
  }
}

TEST_F(ExportProgram, ThePagesPythonReadsTheExports) {
  std::ifstream file(Root() / "docs/read-a-log.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = page.find("```python\n") + 10, end = page.find("```", begin);
  ASSERT_LT(end, page.size());
  files_->Write("read_log.py", page.substr(begin, end - begin));
  Program python({"python3", At("read_log.py"), Log()});
  ASSERT_TRUE(python.Wait(60));
  if (python.status() == 127) GTEST_SKIP() << "there is no python3";
  ASSERT_EQ(python.status(), 0) << python.Story();
  // From "tick,peer,id,x,y,angle" and from the table, as lines "tick,view,body,x,y,angle".
  const Recording recording = ReadRecording(Log());
  const Scene scene = ParseScene(recording.room.scene_text, "crossing.toml");
  Words read = LinesOf(python.output()), exported;
  EXPECT_EQ(read.at(0), "tick,peer,id,x,y,angle");
  read.erase(read.begin());
  for (std::string& line : read) {
    Words row = Fields(line);
    const auto peer = std::stoul(row[1]);
    row[1] = peer == 0 ? "server" : scene.players.at(peer - 1).name;
    row[2] = scene.parts.at(std::stoul(row[2])).name;
    line = row[0] + ',' + row[1] + ',' + row[2] + ',' + row[3] + ',' + row[4] + ',' + row[5];
  }
  for (const std::string& line : LinesOf(Export({"--csv"}))) {
    const Words row = Fields(line);
    if (row[0] == "tick") continue;
    exported.push_back(row[0] + ',' + row[2] + ',' + row[3] + ',' + row[4] + ',' + row[5] + ',' +
                       row[6]);
  }
  std::sort(read.begin(), read.end());
  std::sort(exported.begin(), exported.end());
  EXPECT_EQ(read, exported);
  EXPECT_GT(read.size(), 1000u);
}

TEST(ExportText, HostileNamesStayOneFieldAndOneString) {
  EXPECT_EQ(CsvField("crate.1"), "crate.1");
  EXPECT_EQ(CsvField("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvField("say \"hi\"\n"), "\"say \"\"hi\"\"\n\"");
  EXPECT_EQ(JsonText("a\"b\\c\n\x01\x7f"), "\"a\\u0022b\\u005cc\\u000a\\u0001\\u007f\"");
  EXPECT_EQ(JsonText("</script>"), "\"\\u003c/script\\u003e\"");
  EXPECT_EQ(JsonText("é"), "\"\\u00e9\"");
  EXPECT_EQ(JsonNumber(0.1f), "0.100000001");
  EXPECT_EQ(JsonNumber(std::numeric_limits<double>::infinity()), "null");
}

}  // namespace export_test
}  // namespace seam
