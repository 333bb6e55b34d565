/// seam-lab run: the same settings give the same bytes, in this process and in others, and the
/// result is an ordinary recording.

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/measure/measure.h"
#include "common/record/log_file.h"
#include "tests/lab/commands.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_run_test {

RunCommand Short(const std::string& log) {
  RunCommand command;
  command.settings.scene = "scenes/crossing.toml";
  command.settings.duration_s = 2;
  command.settings.impair = "4g";
  command.log = log;
  return command;
}

TEST(LabRun, TheSameSettingsGiveTheSameBytesAndAnotherSeedDiffers) {
  const LabWorkspace files;
  RunCommand command = Short(files / "a.lcm");
  EXPECT_EQ(RunLog(command), 0);
  command.log = files / "b.lcm";
  EXPECT_EQ(RunLog(command), 0);
  EXPECT_GT(files.Read("a.lcm").size(), 100000u);
  EXPECT_TRUE(files.Read("a.lcm") == files.Read("b.lcm"));
  command.settings.seed = 2;
  command.force = true;
  EXPECT_EQ(RunLog(command), 0);
  EXPECT_FALSE(files.Read("a.lcm") == files.Read("b.lcm"));
}

TEST(LabRun, TwoProcessesWriteTheSameBytesAsThisOne) {
  const LabWorkspace files;
  EXPECT_EQ(RunLog(Short(files / "here.lcm")), 0);
  for (const char* name : {"one.lcm", "two.lcm"}) {
    ChildProcess lab({LabProgram(), "run", "scenes/crossing.toml", "--duration", "2", "--impair",
                      "4g", "-o", files / name});
    ASSERT_TRUE(lab.Wait(120));
    ASSERT_EQ(lab.exit_status(), 0) << lab.output();
    EXPECT_NE(lab.output().find("120 ticks, "), std::string::npos) << lab.output();
    EXPECT_TRUE(files.Read(name) == files.Read("here.lcm")) << name;
  }
}

TEST(LabRun, TheLogEqualsTheMessagesPublishedInVirtualTime) {
  const LabWorkspace files;
  const RunCommand command = Short(files / "a.lcm");
  EXPECT_EQ(RunLog(command), 0);
  const Recording read = ReadRecording(command.log);
  Cluster cluster(Configure(command.settings));
  cluster.Run();
  cluster.server().Shutdown(cluster.now_us(), "the time is over");
  const Recording& direct = cluster.recording();
  // The log ends with the seals that were not kept on the way: one of each peer and its own.
  EXPECT_GE(read.events_read, direct.events_read);
  EXPECT_LE(read.events_read, direct.events_read + 4);
  EXPECT_EQ(read.room.scene_text, direct.room.scene_text);
  EXPECT_EQ(read.room.scene_name, "crossing");
  EXPECT_EQ(read.room.impair, "4g");
  EXPECT_EQ(read.views.size(), 3u);
  EXPECT_EQ(read.last_tick, 120);
  EXPECT_EQ(read.bus_gaps + read.foreign + read.undecodable + read.skipped_bytes, 0);
  EXPECT_EQ(Measure(read, ComputeOracle(read)).error_rms_m,
            Measure(direct, ComputeOracle(direct)).error_rms_m);
  // It ends as a session of seam-server does.
  ASSERT_FALSE(read.summaries.empty());
  EXPECT_EQ(read.summaries.back().ended, static_cast<std::int8_t>(Ended::kEnded));
  EXPECT_EQ(read.summaries.back().tick, 120);
  EXPECT_EQ(read.events.back().text, "the room ends: the time is over");
  // One clock stamps all events, independent of the clients' clocks.
  LogReader log(command.log);
  LogEvent event;
  std::int64_t last_us = 0, first_us = -1;
  while (log.Next(&event)) {
    EXPECT_GE(event.timestamp_us, last_us);
    last_us = event.timestamp_us;
    if (first_us < 0) first_us = last_us;
  }
  EXPECT_GT(last_us - first_us, 2000000);
  EXPECT_LT(last_us, 10000000);
}

TEST(LabRun, AnOperatorsMistakeIsOneLineAndWritesNothing) {
  const LabWorkspace files;
  files.Write("kept.lcm", "mine");
  const std::string scene = "scenes/crossing.toml";
  const std::vector<std::vector<std::string>> mistakes = {
      {"run", scene, "-o", files / "kept.lcm"},
      {"run", "scenes/none.toml", "-o", files / "x.lcm"},
      {"run", scene, "-o", files / "x.lcm", "--mode", "magic"},
      {"run", scene, "-o", files / "x.lcm", "--reconcile", "magic"},
      {"run", scene, "-o", files / "x.lcm", "--mode", "strict", "--reconcile", "fade"},
      {"run", scene, "-o", files / "x.lcm", "--impair", "magic"},
      {"run", scene, "-o", files / "x.lcm", "--seed", "-1"},
      {"run", scene, "-o", files / "x.lcm", "--drive", "keyboard"},
      {"run", scene, "-o", files / "x.lcm", "--duration", "nan"},
      {"run", scene, "-o", files / "x.lcm", "--set", "solver.substeps=99"},
      {"run", scene, "-o", files / "x.lcm", "--set", "solver.magic=1"},
      {"run", scene, "-o", files / "x.lcm", "--set", "buffer=5", "--buffer", "6"},
      {"run", scene, "-o", files / "x.lcm", "--buffer", "-1"},
      {"run", scene, "-o", files / "no/folder/x.lcm"},
      {"run", scene},
      {"fly"},
      {}};
  for (std::vector<std::string> words : mistakes) {
    words.insert(words.begin(), LabProgram());
    ChildProcess lab(words);
    ASSERT_TRUE(lab.Wait(60));
    const std::string said = lab.output();
    EXPECT_EQ(lab.exit_status(), 2) << said;
    EXPECT_EQ(said.rfind("seam-lab: ", 0), 0u) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_EQ(files.Names(), std::vector<std::string>{"kept.lcm"}) << said;
  }
  EXPECT_EQ(files.Read("kept.lcm"), "mine");
}

TEST(LabRun, ReportsANetworkThatLetsNobodyIn) {
  SessionSettings settings;
  settings.scene = "scenes/crossing.toml";
  settings.impair = "loss=100%";
  EXPECT_THROW(RunSession(Configure(settings)), OperatorError);
}

}  // namespace lab_run_test
}  // namespace seam
