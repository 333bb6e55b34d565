/// A session in a log of many segments: its readers see it as in a log of one file.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "client/embed/cluster.h"
#include "common/base/check.h"
#include "common/base/process.h"
#include "common/record/disk_thread.h"
#include "common/record/room_log.h"
#include "common/record/segments/log_segments.h"
#include "tests/lab/replay/replayed_room.h"
#include "tests/support/program.h"

namespace seam {
namespace log_segments_cluster_test {

namespace fs = std::filesystem;

/// Gives all messages to several logs.
class Tee : public Recorder {
 public:
  explicit Tee(std::vector<RoomLog*> logs) : logs_(std::move(logs)) {}
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
    for (RoomLog* log : logs_) log->Publish(channel, utime, message);
  }
  void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override {
    for (RoomLog* log : logs_) log->EndTick(channel, seal, kept);
  }

 private:
  std::vector<RoomLog*> logs_;
};

std::string TextOf(const std::string& path) {
  std::ifstream file(path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

std::string RunProgram(std::vector<std::string> words, int status = 0) {
  words[0] = BuiltProgram(words[0]);
  Program program(words);
  EXPECT_TRUE(program.Wait(300));
  EXPECT_EQ(program.status(), status) << program.Story();
  return program.output() + program.errors();
}

/// 20 s of a room with inserted, broken and scored parts, in one file and in segments of 100 kB.
class LogSegmentsCluster : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = std::make_unique<Workspace>();
    for (const char* name : {"whole", "kept"}) fs::create_directory(*files_ / name);
    RoomLog one(*files_ / "whole/main.lcm", false, nullptr);
    RoomLog many(*files_ / "kept/main.lcm", false, nullptr, nullptr, 100000);
    Tee tee({&one, &many});
    ClusterConfig config;
    config.scene = "gluehouse";
    config.keep = false;
    config.recorder = &tee;
    Cluster cluster(config);
    cluster.RunToTick(1200);
  }
  static void TearDownTestSuite() { files_.reset(); }
  static std::string Whole() { return *files_ / "whole/main.lcm"; }
  static std::string Kept() { return *files_ / "kept"; }
  static std::vector<LogSegment> Segments() { return ListSegments(*files_ / "kept/main.lcm"); }

  static std::unique_ptr<Workspace> files_;
};
std::unique_ptr<Workspace> LogSegmentsCluster::files_;

TEST_F(LogSegmentsCluster, AreMeasuredAsTheLogInOneFile) {
  ASSERT_GT(Segments().size(), 10u);
  const std::string one = *files_ / "one.csv", many = *files_ / "many.csv";
  RunProgram({"seam-measure", Whole(), "--names", "run", "--csv", one});
  RunProgram({"seam-measure", Kept(), "--names", "run", "--csv", many});
  EXPECT_GT(TextOf(one).size(), 100u);
  EXPECT_EQ(TextOf(many), TextOf(one));
}

TEST_F(LogSegmentsCluster, AreWholeAndDoneAgain) {
  EXPECT_NE(RunProgram({"seam-log", "verify", Kept()}).find(": whole: "), std::string::npos);
  const LoggedRoom whole = ReadLoggedRoom(Whole(), ""), kept = ReadLoggedRoom(Kept(), "");
  ASSERT_EQ(kept.ticks.size(), whole.ticks.size());
  for (std::size_t i = 0; i < kept.ticks.size(); ++i) {
    EXPECT_EQ(kept.ticks[i].hash, whole.ticks[i].hash);
    EXPECT_EQ(kept.ticks[i].before.size(), whole.ticks[i].before.size());
    EXPECT_EQ(kept.ticks[i].after.size(), whole.ticks[i].after.size());
  }
  ReplayedRoom room(kept);
  while (!room.done()) ASSERT_EQ(room.Step(), ReplayedRoom::Tick::kSame);
}

TEST_F(LogSegmentsCluster, ALaterOneAloneIsMeasuredButNotDoneAgain) {
  const std::string path = Segments()[5].path;
  const std::string verified = RunProgram({"seam-log", "verify", path});
  EXPECT_NE(verified.find("; what precedes tick "), std::string::npos) << verified;
  RunProgram({"seam-measure", path});
  RunProgram({"seam-export", path, "--csv", "-o", *files_ / "segment.csv"});
  const std::string refused = RunProgram({"seam-lab", "replay", path}, 2);
  EXPECT_NE(refused.find("a room is done again from its first tick on"), std::string::npos);
  EXPECT_EQ(std::count(refused.begin(), refused.end(), '\n'), 1) << refused;
}

/// The CPU time of the calls in which segments begin, in a server's log: other programs, and tests,
/// may have the processors meanwhile.
TEST(LogSegmentsTime, AChangeOfSegmentMakesNoTickLate) {
  class Timed : public Tee {
   public:
    Timed(RoomLog* log, std::string path) : Tee({log}), path_(std::move(path)) {}
    void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
      if (PublisherOfChannel(channel) != 0) return;
      const std::int64_t begin_us = ThreadCpuUs();
      Tee::Publish(channel, utime, message);
      const std::int64_t cost_us = ThreadCpuUs() - begin_us;
      if (!fs::exists(SegmentPath(path_, segments + 1))) return;
      ++segments;
      costs_us.push_back(cost_us);
    }
    void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override {
      if (seal.peer == 0) Tee::EndTick(channel, seal, kept);
    }
    std::vector<std::int64_t> costs_us;
    std::int32_t segments = 0;

   private:
    std::string path_;
  };
  Workspace folder;
  const std::string path = folder / "main.lcm";
  DiskThread disk;
  RoomLog log(path, false, &disk, nullptr, 1000000);
  Timed timed(&log, path);
  ClusterConfig config;
  config.scene = "swarm";
  config.players = 2;
  config.keep = false;
  config.recorder = &timed;
  Cluster cluster(config);
  cluster.RunToTick(120);
  ASSERT_GE(timed.costs_us.size(), 5u);
  std::sort(timed.costs_us.begin(), timed.costs_us.end());
  const double median_ms = static_cast<double>(timed.costs_us[timed.costs_us.size() / 2]) * 1e-3;
  std::printf("swarm, %zu changes of segment: %.2f ms in the median, %.2f ms at most\n",
              timed.costs_us.size(), median_ms, static_cast<double>(timed.costs_us.back()) * 1e-3);
  EXPECT_LT(median_ms, 2);
}

}  // namespace log_segments_cluster_test
}  // namespace seam
