/// No program replaces a file that is there without --force, and none a file that it reads; and one
/// log of two sessions gives each session's own figures.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/plain_file.h"
#include "tests/support/program.h"

namespace seam {
namespace overwrite_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string ContentOf(const std::string& path) { return ReadPlainFile(path, 1 << 26); }

/// Runs a program in the folder; returns its status, and its story through `story`.
int RunIn(const Workspace& folder, Words words, std::string* story) {
  words.front() = BuiltProgram(words.front());
  Program program(words, folder.path());
  EXPECT_TRUE(program.Wait(120));
  *story = program.Story();
  return program.status();
}

class Overwrite : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file("scenes/crossing.toml", folder_ / "crossing.toml");
    std::string story;
    for (const char* method : {"rollback", "fade"}) {
      ASSERT_EQ(RunIn(folder_,
                      {"seam-lab", "run", "crossing.toml", "--reconcile", method, "--impair", "4g",
                       "--duration", "4", "--no-floor", "-o", std::string(method) + ".lcm"},
                      &story),
                0)
          << story;
    }
  }
  const Workspace folder_;
};

TEST_F(Overwrite, EachWriterAsksForForce) {
  const std::string log = "rollback.lcm";
  const std::vector<Words> writers = {
      {"seam-render", "--page", log, "-o", "out.html"},
      {"seam-render", "--strobe", log, "-o", "out.png"},
      {"seam-render", log, "--sheet", "2", "-o", "out.png"},
      {"seam-render", "crossing.toml", "-o", "out.png"},
      {"seam-export", log, "--csv", "-o", "out.csv"},
      {"seam-measure", log, "--losses-csv", "out.csv"},
      {"seam-lab", "run", "crossing.toml", "--duration", "1", "--no-floor", "-o", "out.lcm"},
      {"seam-server", "crossing.toml", "--bind", "127.0.0.1:0", "--lcm-url", "none", "--wait", "0",
       "--duration", "0.1", "--quiet", "--record", "out.lcm"}};
  for (Words words : writers) {
    const std::string out = words.back(), path = folder_ / out;
    folder_.Write(out, "mine");
    std::string story;
    EXPECT_EQ(RunIn(folder_, words, &story), 2) << story;
    EXPECT_NE(story.find(out + ": exists (--force replaces it)"), std::string::npos) << story;
    EXPECT_EQ(ContentOf(path), "mine") << words.front();
    words.push_back("--force");
    EXPECT_EQ(RunIn(folder_, words, &story), 0) << story;
    EXPECT_NE(ContentOf(path), "mine") << words.front();
    fs::remove(path);
  }
}

TEST_F(Overwrite, AFolderOfFramesAndATableAskForForceToo) {
  const Words frames = {"seam-render", "rollback.lcm", "-o", "frames", "--from", "1", "--to", "1"};
  const Words table = {"seam-measure", "rollback.lcm", "--csv", "table.csv"};
  for (Words words : {frames, table}) {
    std::string story;
    EXPECT_EQ(RunIn(folder_, words, &story), 0) << story;
    EXPECT_EQ(RunIn(folder_, words, &story), 2) << story;
    EXPECT_NE(story.find("--force"), std::string::npos) << story;
    words.push_back("--force");
    EXPECT_EQ(RunIn(folder_, words, &story), 0) << story;
  }
  Words append = table;
  append.push_back("--append");
  std::string story;
  EXPECT_EQ(RunIn(folder_, append, &story), 0) << story;
}

TEST_F(Overwrite, NothingThatIsReadIsReplacedEvenWithForce) {
  const std::string log = "rollback.lcm";
  fs::create_hard_link(folder_ / log, folder_ / "link.csv");
  fs::create_symlink("crossing.toml", folder_ / "scene.lcm");
  const std::string scene = ContentOf(folder_ / "crossing.toml"), events = ContentOf(folder_ / log);
  const std::vector<Words> writers = {
      {"seam-lab", "run", "crossing.toml", "-o", "crossing.toml", "--force"},
      {"seam-lab", "run", "crossing.toml", "-o", "scene.lcm", "--force"},
      {"seam-server", "crossing.toml", "--bind", "127.0.0.1:0", "--lcm-url", "none", "--record",
       "crossing.toml", "--force"},
      {"seam-measure", log, "--losses-csv", log, "--force"},
      {"seam-export", log, "--csv", "-o", "link.csv", "--force"}};
  for (const Words& words : writers) {
    std::string story;
    EXPECT_EQ(RunIn(folder_, words, &story), 2) << story;
    EXPECT_NE(story.find("is read, it cannot be written"), std::string::npos) << story;
  }
  EXPECT_EQ(ContentOf(folder_ / "crossing.toml"), scene);
  EXPECT_EQ(ContentOf(folder_ / log), events);
}

/// The row of a table without the run's name.
std::string RowOf(const Workspace& folder, const std::string& table) {
  const std::string text = ContentOf(folder / table), row = text.substr(text.find('\n') + 1);
  const std::size_t scene = row.find(','), name = row.find(',', scene + 1);
  return row.substr(0, scene) + row.substr(name);
}

TEST_F(Overwrite, OneLogOfTwoSessionsGivesEachItsOwnFigures) {
  folder_.Write("two.lcm", ContentOf(folder_ / "fade.lcm") + ContentOf(folder_ / "rollback.lcm"));
  std::string story;
  const auto measure = [&](const Words& words, const std::string& table) {
    Words all = {"seam-measure", "--csv", table};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(RunIn(folder_, all, &story), 0) << story;
    return RowOf(folder_, table);
  };
  const std::string fade = measure({"fade.lcm"}, "a.csv");
  const std::string rollback = measure({"rollback.lcm"}, "b.csv");
  EXPECT_NE(fade, rollback);
  EXPECT_EQ(measure({"two.lcm", "--session", "1"}, "c.csv"), fade);
  EXPECT_EQ(measure({"two.lcm"}, "d.csv"), rollback);
  EXPECT_NE(story.find("2 sessions: 1 (crossing, buffer/fade, 4g, seed 1,"), std::string::npos)
      << story;
  EXPECT_NE(story.find("this is 2, the last"), std::string::npos) << story;
  EXPECT_EQ(
      RunIn(folder_, {"seam-export", "two.lcm", "--csv", "--session", "1", "-o", "1.csv"}, &story),
      0);
  EXPECT_EQ(RunIn(folder_, {"seam-export", "fade.lcm", "--csv", "-o", "f.csv"}, &story), 0);
  EXPECT_EQ(ContentOf(folder_ / "1.csv"), ContentOf(folder_ / "f.csv"));
  EXPECT_EQ(
      RunIn(folder_,
            {"seam-render", "--page", "two.lcm", "two.lcm", "--session", "1,2", "-o", "both.html"},
            &story),
      0)
      << story;
  EXPECT_EQ(RunIn(folder_, {"seam-measure", "two.lcm", "--session", "3"}, &story), 2);
  EXPECT_NE(story.find("--session 3: two.lcm has 2 sessions"), std::string::npos) << story;
}

TEST_F(Overwrite, ValidSaysWhatARecordingLacks) {
  // Cut a hole into the log.
  const std::string whole = ContentOf(folder_ / "rollback.lcm");
  folder_.Write("hole.lcm",
                whole.substr(0, whole.size() / 2) + whole.substr(whole.size() * 6 / 10));
  std::string story;
  EXPECT_EQ(RunIn(folder_, {"seam-measure", "hole.lcm", "--csv", "hole.csv"}, &story), 1) << story;
  const std::string table = ContentOf(folder_ / "hole.csv");
  EXPECT_NE(table.find(" messages missing"), std::string::npos) << table;
  EXPECT_EQ(table.find(",,,,,,"), std::string::npos) << "the figures of the rest: " << table;
}

}  // namespace overwrite_test
}  // namespace seam
