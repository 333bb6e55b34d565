/// seam-log as a user runs it: logs are checked, listed, cut and merged, and other programs take
/// the results.

#include <gtest/gtest.h>

#include <memory>
#include <sstream>

#include "common/base/check.h"
#include "common/base/random.h"
#include "common/measure/oracle.h"
#include "common/record/damage.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace log_program_test {

using Words = std::vector<std::string>;

class LogProgram : public ::testing::Test {
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
  /// Writes the events of a log for which `keep(n)` is true, with times `late_us` later, as a
  /// stock logger would have.
  template <class Keep>
  static void Capture(const std::string& name, std::int64_t late_us, const Keep& keep) {
    LogReader reader(At("run.lcm"));
    LogWriter writer(At(name), true);
    std::int64_t n = 0;
    for (LogEvent event; reader.Next(&event); ++n) {
      if (keep(n)) writer.Publish(event.channel, event.timestamp_us + late_us, event.data);
    }
  }

  static std::unique_ptr<LabWorkspace> files_;
};
std::unique_ptr<LabWorkspace> LogProgram::files_;

/// The bits of all that a recording's readers take from it.
std::string Content(const Recording& r) {
  std::ostringstream text;
  for (const auto& [peer, views] : r.views) {
    for (const auto& [tick, view] : views) {
      text << peer << ' ' << tick << ' ' << Fnv1a(Encode(view).data(), Encode(view).size()) << '\n';
    }
  }
  text << r.states.size() << ' ' << r.grants.size() << ' ' << r.edits.size() << ' '
       << r.inputs.size() << ' ' << r.events.size() << ' ' << r.impacts.size();
  return text.str();
}

TEST_F(LogProgram, VerifySaysThatALogIsWholeOrWhereItIsNot) {
  EXPECT_NE(Run({"verify", At("run.lcm")}).find("whole"), std::string::npos);
  std::string bytes = files_->Read("run.lcm");
  Random random(2);
  for (int i = 0; i < 8; ++i) {
    std::string bad = bytes;
    bad[random.Next() % bad.size()] ^= static_cast<char>(1 << random.Next() % 8);
    files_->Write("bad.lcm", bad);
    EXPECT_NE(Run({"verify", At("bad.lcm")}, 1).find("tick"), std::string::npos);
  }
  Run({"verify", At("run.lcm"), At("bad.lcm")}, 1);
  EXPECT_NE(Run({"verify", At("nothing.lcm")}, 2, true).find("nothing.lcm"), std::string::npos);
}

TEST_F(LogProgram, ListAndStatsNameSessionsAndChannels) {
  const std::string list = Run({"list", At("run.lcm")});
  for (const char* word : {"main", "crossing", "buffer", "ticks 0..240"}) {
    EXPECT_NE(list.find(word), std::string::npos) << list;
  }
  const std::string stats = Run({"stats", At("run.lcm"), "--csv"});
  EXPECT_NE(stats.find("\nSEAM.main.view.0,241,"), std::string::npos) << stats;
  Capture("gaps.lcm", 1, [](std::int64_t n) { return n < 500 || n > 540; });
  EXPECT_NE(Run({"stats", At("gaps.lcm")}).find("bus"), std::string::npos);
}

TEST_F(LogProgram, ACutHasTheTicksAndReadersTakeIt) {
  const Recording whole = ReadRecording(At("run.lcm"));
  for (const auto& [flags, first, last] :
       {std::tuple(Words{"--from", "1", "--to", "2"}, 60, 120),
        std::tuple(Words{"--from-tick", "33", "--to-tick", "77"}, 33, 77),
        std::tuple(Words{"--to", "0.5"}, 0, 30), std::tuple(Words{}, 0, 240)}) {
    Words words = {"cut", At("run.lcm"), "-o", At("cut.lcm"), "--force"};
    words.insert(words.end(), flags.begin(), flags.end());
    Run(words);
    const Recording cut = ReadRecording(At("cut.lcm"));
    EXPECT_TRUE(DamageLines(cut).empty()) << DamageLines(cut).front();
    EXPECT_EQ(cut.first_tick, first);
    EXPECT_EQ(cut.last_tick, last);
    EXPECT_EQ(cut.room.scene_text, whole.room.scene_text);
    for (const auto& [peer, views] : cut.views) {
      const auto& all = whole.views.at(peer);  // a client's begin a little later
      EXPECT_EQ(std::distance(all.lower_bound(first), all.upper_bound(last)),
                static_cast<std::ptrdiff_t>(views.size()))
          << peer;
      for (const auto& [tick, view] : views) {
        EXPECT_EQ(Encode(view), Encode(whole.views.at(peer).at(tick)));
      }
    }
    EXPECT_EQ(cut.inputs.count(0), whole.inputs.count(0));
    EXPECT_NE(Run({"verify", At("cut.lcm")}).find("whole"), std::string::npos);
  }
  EXPECT_NE(Run({"cut", At("run.lcm"), "-o", At("cut.lcm")}, 2, true).find("--force"),
            std::string::npos);
  Run({"cut", At("run.lcm"), "-o", At("run.lcm"), "--force"}, 2);
  Run({"cut", At("run.lcm"), "--from", "100", "-o", At("no.lcm")}, 2);
  Run({"cut", At("run.lcm"), "--from", "1", "--to-tick", "9", "-o", At("no.lcm")}, 2);
  Run({"cut", At("run.lcm"), "--from-tick", "9", "--to-tick", "3", "-o", At("no.lcm")}, 2);
  for (const std::string& name : files_->Names()) EXPECT_EQ(name.find("no.lcm"), std::string::npos);
}

TEST_F(LogProgram, ACutIsWholeWhereverItEnds) {
  for (int first = 10; first < 220; first += 23) {
    Run({"cut", At("run.lcm"), "--from-tick", std::to_string(first), "--to-tick",
         std::to_string(first + 17), "-o", At("part.lcm"), "--force"});
    const Recording part = ReadRecording(At("part.lcm"));
    EXPECT_TRUE(DamageLines(part).empty()) << first << ": " << DamageLines(part).front();
    EXPECT_EQ(part.first_tick, first);
    EXPECT_EQ(part.last_tick, first + 17);
  }
}

std::int64_t EventsOf(const std::string& path) {
  std::int64_t events = 0;
  LogReader reader(path);
  for (LogEvent event; reader.Next(&event);) ++events;
  return events;
}

TEST_F(LogProgram, ItCountsTheEventsThatItWrites) {
  const std::string cut =
      Run({"cut", At("run.lcm"), "--from", "0", "--to", "1", "-o", At("counted.lcm")});
  EXPECT_NE(cut.find(": " + std::to_string(EventsOf(At("counted.lcm"))) + " events"),
            std::string::npos)
      << cut;
  // A merge with itself has each event once; one that the log itself has twice stays so.
  const std::string all = std::to_string(EventsOf(At("run.lcm")));
  const std::string merged = Run({"merge", At("run.lcm"), At("run.lcm"), "-o", At("twice.lcm")});
  EXPECT_NE(merged.find(all + " events, " + all + " that came twice"), std::string::npos) << merged;
}

TEST_F(LogProgram, RangesAreNumbers) {
  for (const std::string flag : {"--from", "--to"}) {
    const std::string why = Run({"cut", At("run.lcm"), flag, "nan", "-o", At("nan.lcm")}, 2, true);
    EXPECT_NE(why.find("nan is not a number"), std::string::npos) << why;
  }
}

TEST_F(LogProgram, DamageIsNotCopiedUnderNewChecksums) {
  std::string bytes = files_->Read("run.lcm");
  bytes[bytes.size() / 2] ^= 1;
  files_->Write("bad.lcm", bytes);
  const std::string why = Run({"cut", At("bad.lcm"), "-o", At("cut2.lcm")}, 2, true);
  const std::size_t at = why.find("--to-tick ");
  ASSERT_NE(at, std::string::npos) << why;
  const std::string tick = std::to_string(std::atoi(why.c_str() + at + 10));
  Run({"cut", At("bad.lcm"), "--to-tick", tick, "-o", At("cut2.lcm")}, 1);  // says the damage
  EXPECT_NE(Run({"verify", At("cut2.lcm")}).find("whole"), std::string::npos);
  Run({"merge", At("bad.lcm"), At("run.lcm"), "-o", At("both2.lcm")}, 2);
}

/// Returns the number in "... N messages missing".
int MissingIn(const std::string& text) {
  const std::size_t end = text.find(" messages missing");
  if (end == std::string::npos) return -1;
  return std::atoi(text.c_str() + text.rfind(' ', end - 1));
}

TEST_F(LogProgram, AllCountTheSameMessagesAsMissing) {
  const std::string whole = files_->Read("run.lcm");
  int most = 0;
  for (const std::size_t bytes : {1, 500, 5000, 20000}) {
    std::string bad = whole;
    bad.erase(bad.size() / 3, bytes);
    files_->Write("bad.lcm", bad);
    const int by_verify = MissingIn(Run({"verify", At("bad.lcm")}, 1));
    EXPECT_EQ(by_verify, MissingIn(Run({"stats", At("bad.lcm")}, 1, true))) << bytes;
    EXPECT_EQ(by_verify, MissingIn(Run({"cut", At("bad.lcm"), "-o", At("cut3.lcm")}, 2, true)));
    EXPECT_EQ(by_verify, static_cast<int>(ReadRecording(At("bad.lcm")).bus_gaps));
    most = std::max(most, by_verify);
  }
  EXPECT_GT(most, 10);
}

TEST_F(LogProgram, VerifyCountsWhatALoggerHasMissed) {
  {
    LogReader reader(At("run.lcm"));
    LogWriter writer(At("lost.lcm"), true);
    std::int64_t n = 0;
    for (LogEvent event; reader.Next(&event); ++n) {
      const bool sum = event.channel.find(".chain.") != std::string::npos;  // a log of its own
      if (!sum && (n < 500 || n > 540)) {
        writer.Publish(event.channel, event.timestamp_us, event.data);
      }
    }
  }
  const int missing = static_cast<int>(ReadRecording(At("lost.lcm")).bus_gaps);
  EXPECT_GT(missing, 10);
  const std::string says = Run({"verify", At("lost.lcm")}, 1);
  EXPECT_NE(says.find("are as they were written, but " + std::to_string(missing) + " messages"),
            std::string::npos)
      << says;
}

TEST_F(LogProgram, CapturesOfOtherMachinesMergeIntoTheWholeWithoutDuplicates) {
  // Each logger missed others; one has a clock that is 7 s ahead.
  Capture("a.lcm", 0, [](std::int64_t n) { return n < 10 || n % 5 != 0; });
  Capture("b.lcm", 7000000, [](std::int64_t n) { return n < 10 || n % 7 != 3; });
  Capture("c.lcm", -300, [](std::int64_t n) { return n > 8 && (n % 5 == 0 || n % 3 != 1); });
  Run({"merge", At("a.lcm"), At("b.lcm"), At("c.lcm"), "-o", At("all.lcm")});
  const Recording whole = ReadRecording(At("run.lcm")), merged = ReadRecording(At("all.lcm"));
  EXPECT_GT(ReadRecording(At("a.lcm")).bus_gaps, 100);
  EXPECT_EQ(merged.duplicates, 0);
  EXPECT_EQ(merged.bus_gaps, 0);
  EXPECT_EQ(Content(merged), Content(whole));
  EXPECT_TRUE(DamageLines(merged).empty());
  LogReader reader(At("all.lcm"));
  std::int64_t before_us = 0;
  for (LogEvent event; reader.Next(&event);) {
    if (event.channel.find(".chain") != std::string::npos) continue;
    EXPECT_GE(event.timestamp_us, before_us);
    before_us = event.timestamp_us;
  }
  Run({"merge", At("a.lcm"), "-o", At("one.lcm")}, 2);
}

TEST_F(LogProgram, ACutWithoutTheBeginningHasNoErrors) {
  Run({"cut", At("run.lcm"), "--from", "1", "-o", At("late.lcm")});
  Run({"cut", At("run.lcm"), "--to", "3", "-o", At("early.lcm")});
  const std::string why = "the log begins at tick 60 of its session";
  EXPECT_EQ(WhyNoOracle(ReadRecording(At("late.lcm"))), why);
  EXPECT_EQ(WhyNoOracle(ReadRecording(At("early.lcm"))), "");
  EXPECT_THROW(ComputeOracle(ReadRecording(At("late.lcm"))), OperatorError);
  Program measure({BuiltProgram("seam-measure"), At("late.lcm"), At("early.lcm"), "--wide"});
  ASSERT_TRUE(measure.Wait(120));
  EXPECT_EQ(measure.status(), 0) << measure.Story();
  EXPECT_NE(measure.errors().find("no errors: " + why), std::string::npos) << measure.errors();
  EXPECT_NE(measure.output().find(why), std::string::npos) << measure.output();
  Program more({BuiltProgram("seam-measure"), At("late.lcm"), "--more"});
  ASSERT_TRUE(more.Wait(120));
  EXPECT_NE(more.output().find("error shown      does not apply"), std::string::npos)
      << more.output();
  Program limit({BuiltProgram("seam-measure"), At("late.lcm"), "--limit"});
  ASSERT_TRUE(limit.Wait(120));
  EXPECT_EQ(limit.status(), 2) << limit.Story();
  EXPECT_NE(limit.errors().find(why), std::string::npos) << limit.errors();
  Program render(
      {BuiltProgram("seam-render"), At("late.lcm"), "--sheet", "2", "-o", At("late.png")});
  ASSERT_TRUE(render.Wait(120));
  EXPECT_EQ(render.status(), 0) << render.Story();
  EXPECT_NE(render.errors().find(why), std::string::npos) << render.errors();
}

}  // namespace log_program_test
}  // namespace seam
