/// seam-log with segments of a log, logs with far ticks, and logs of clients.

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/codec/codec.h"
#include "common/record/damage.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"
#include "common/record/room_log.h"
#include "render/log/log_copy.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace log_odd_test {

using Words = std::vector<std::string>;

class OddLogs : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = std::make_unique<LabWorkspace>();
    Program lab({LabProgram(), "run", (Root() / "scenes/crossing.toml").string(), "--impair", "4g",
                 "--seed", "7", "--duration", "4", "--no-floor", "-o", At("run.lcm")});
    ASSERT_TRUE(lab.Wait(120));
    ASSERT_EQ(lab.status(), 0) << lab.Story();
  }
  static void TearDownTestSuite() { files_.reset(); }
  static std::string At(const std::string& name) { return *files_ / name; }

  static std::string Run(Words words, int status = 0, bool errors = false) {
    words.insert(words.begin(), BuiltProgram("seam-log"));
    Program program(words);
    EXPECT_TRUE(program.Wait(120));
    EXPECT_EQ(program.status(), status) << program.Story();
    return errors ? program.errors() : program.output();
  }

  static std::unique_ptr<LabWorkspace> files_;
};
std::unique_ptr<LabWorkspace> OddLogs::files_;

TEST_F(OddLogs, SegmentsMergeToAWholeLog) {
  {
    RoomLog log(At("long.lcm"), true, nullptr, nullptr, 100000);
    LogReader reader(At("run.lcm"));
    for (LogEvent event; reader.Next(&event);) {
      const AnyMessage message = Decode(event.data);
      if (const std::optional<LogSeal> seal = SealOf(message)) {
        log.EndTick(event.channel, *seal, true);
      } else {
        log.Publish(event.channel, event.timestamp_us, event.data);
      }
    }
  }
  ASSERT_TRUE(std::filesystem::exists(At("long.s0002.lcm")));
  const std::vector<Words> merges = {{"long.lcm", "long.s0001.lcm"},
                                     {"long.s0002.lcm", "long.lcm"},
                                     {"long.s0001.lcm", "long.s0002.lcm"},
                                     {"long.lcm", "long.s0002.lcm", "long.s0001.lcm"}};
  for (const Words& logs : merges) {
    Words words = {"merge", "--force", "-o", At("series.lcm")};
    for (const std::string& log : logs) words.push_back(At(log));
    Run(words);
    const Recording merged = ReadRecording(At("series.lcm"));
    EXPECT_TRUE(DamageLines(merged).empty()) << logs[0] << ": " << DamageLines(merged).front();
    Run({"verify", At("series.lcm")});
  }
  Run({"merge", "--force", At("long.lcm"), At("long.s0001.lcm"), "-o", At("series.lcm")});
  const Recording all = ReadRecording(At("run.lcm")), merged = ReadRecording(At("series.lcm"));
  EXPECT_EQ(merged.views.at(1).size(), all.views.at(1).size());
  EXPECT_EQ(merged.inputs.at(0).size(), all.inputs.at(0).size());
  EXPECT_EQ(merged.events.size(), all.events.size());
}

TEST_F(OddLogs, AFarTickAndAFarTimeDoNotCountInTheList) {
  {
    LogReader reader(At("run.lcm"));
    LogWriter writer(At("far.lcm"), true);
    std::int64_t n = 0;
    for (LogEvent event; reader.Next(&event); ++n) {
      AnyMessage message = Decode(event.data);
      auto* const view = std::get_if<View>(&message);
      if (view != nullptr && view->tick == 100) {
        view->tick = 1000000000000;
        event.data = Encode(*view);
      }
      const bool far = n == 300;
      writer.Publish(event.channel, far ? INT64_MAX / 2 : event.timestamp_us, event.data);
    }
  }
  const Recording whole = ReadRecording(At("run.lcm"));
  const std::string ticks = "ticks 0.." + std::to_string(whole.last_tick) + " ";
  Program list({BuiltProgram("seam-log"), "list", At("far.lcm")});
  ASSERT_TRUE(list.Wait(120));
  EXPECT_NE(list.output().find(ticks), std::string::npos) << list.output();
  EXPECT_EQ(list.output().find("4611"), std::string::npos) << list.output();
}

TEST_F(OddLogs, AClientsLogIsToldThatItsServersIsNeeded) {
  LogReader reader(At("run.lcm"));
  {
    LogWriter writer(At("client.lcm"), true);
    for (LogEvent event; reader.Next(&event);) {
      const AnyMessage message = Decode(event.data);
      if (std::holds_alternative<Room>(message) || std::holds_alternative<ScenePart>(message))
        continue;
      writer.Publish(event.channel, event.timestamp_us, event.data);
    }
  }
  for (const char* command : {"list", "stats", "events"}) {
    const std::string why = Run({command, At("client.lcm")}, 2, true);
    EXPECT_NE(why.find("as in a client's: its server's has it"), std::string::npos) << why;
  }
}

}  // namespace log_odd_test
}  // namespace seam
