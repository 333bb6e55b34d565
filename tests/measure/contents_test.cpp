/// The contents of a log, as --list prints them.

#include "common/measure/contents/contents.h"

#include <gtest/gtest.h>

#include "client/embed/cluster.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace contents_test {

Recording Played() {
  ClusterConfig config;
  config.scene = "crossing";
  config.seed = 3;
  config.duration_s = 2;
  return RunCluster(config);
}

void ExpectIn(const std::string& text, const std::string& all) {
  EXPECT_NE(all.find(text), std::string::npos) << "no \"" << text << "\" in\n" << all;
}

TEST(Contents, ListDurationMethodPlayersViewsBodiesAndEvents) {
  const Recording recording = Played();
  const std::string text = FormatContents("a.lcm", recording);
  ExpectIn("a.lcm: crossing, ", text);
  ExpectIn(" s, ticks " + std::to_string(recording.first_tick) + " to " +
               std::to_string(recording.last_tick) + " at 60 Hz\n",
           text);
  ExpectIn("  method     buffer/rollback, network demo, seed 3, 30 states/s, input delay 0 ticks\n",
           text);
  ExpectIn("  players    ann, bob\n", text);
  ExpectIn("  views      server " + std::to_string(recording.views.at(0).size()) + " (", text);
  ExpectIn("  bodies     " + std::to_string(recording.views.at(0).begin()->second.id.size()) +
               " moving at first; the scene has ",
           text);
  ExpectIn(std::to_string(recording.states.size()) + " states", text);
  ExpectIn("  events     " + std::to_string(recording.events.size()) + "\n", text);
  ExpectIn("s  ann is ready as peer 1\n", text);
  EXPECT_EQ(text.find("damage"), std::string::npos);
}

TEST(Contents, ReportMissingAndDamagedData) {
  Recording recording = Played();
  recording.views.erase(2);
  recording.skipped_bytes = 12;
  const std::string text = FormatContents("a.lcm", recording);
  ExpectIn("  players    ann, bob (no view)\n", text);
  ExpectIn("  damage     12 damaged bytes", text);
  recording.room.scene_text = "nonsense = 1";
  ExpectIn("  scene      cannot be read: crossing.toml:1: ", FormatContents("a.lcm", recording));
}

TEST(Contents, EscapeControlCharactersOfARecording) {
  Recording recording = Played();
  recording.room.impair = "\033[31mred";
  Event event;
  event.text = "\033]0;title\007\nnext";
  recording.events.assign(30, event);
  const std::string text = FormatContents("\033[2J.lcm", recording);
  EXPECT_EQ(text.find('\033'), std::string::npos);
  EXPECT_EQ(text.find('\007'), std::string::npos);
  EXPECT_EQ(text.find("\nnext"), std::string::npos);
  ExpectIn("    and 10 more\n", text);
}

TEST(ContentsProgram, RenderAndMeasureListTheSame) {
  const Workspace folder;
  Program lab({BuiltProgram("seam-lab"), "run", (Root() / "scenes/crossing.toml").string(), "-o",
               "a.lcm", "--duration", "1", "--no-floor"},
              folder.path());
  ASSERT_TRUE(lab.Wait(60) && lab.status() == 0) << lab.Story();
  const std::vector<std::string> before = folder.Content();
  std::string first;
  for (const char* name : {"seam-render", "seam-measure"}) {
    Program list({BuiltProgram(name), "--list", "a.lcm"}, folder.path());
    ASSERT_TRUE(list.Wait(60));
    EXPECT_EQ(list.status(), 0) << list.Story();
    EXPECT_EQ(list.output().rfind("a.lcm: crossing, ", 0), 0u) << list.Story();
    if (!first.empty()) {
      EXPECT_EQ(list.output(), first);
    }
    first = list.output();
  }
  EXPECT_EQ(folder.Content(), before) << "nothing is written";
}

}  // namespace contents_test
}  // namespace seam
