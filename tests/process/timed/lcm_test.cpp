/// Other programs at a session of real processes, over LCM: docs/examples/rover.cpp drives the
/// scene `rover`, and wrong messages do nothing.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

#include "common/codec/lcm_types.h"
#include "common/record/bus.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"
#include "tests/support/in_namespace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace lcm_test {

using Words = std::vector<std::string>;
constexpr double kWithin_s = 60;
constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

/// The scene `rover` with a server that records and a client that drives by LCM.
class LcmRover : public InNamespace {
 protected:
  void Serve() {
    server_ = std::make_unique<Program>(Words{
        BuiltProgram("seam-server"), (Root() / "scenes/rover.toml").string(), "--bind", "127.0.0.1",
        "--port", "7811", "--lcm-url", kUrl, "--duration", "0", "--record", Log()});
    ASSERT_TRUE(server_->WaitForErrors("Ctrl-C", kWithin_s)) << server_->Story();
  }
  void Start(const Words& drive = {"--drive", "lcm"}) {
    Serve();
    if (HasFatalFailure()) return;
    Words words = {BuiltProgram("seam-client"),
                   "127.0.0.1:7811",
                   "--name",
                   "ann",
                   "--lcm-url",
                   kUrl,
                   "--quiet"};
    words.insert(words.end(), drive.begin(), drive.end());
    client_ = std::make_unique<Program>(words);
    ASSERT_TRUE(server_->WaitForErrors("ann", kWithin_s)) << server_->Story();
  }
  /// Ends the session and returns its record.
  Recording End() {
    for (Program* program : {client_.get(), server_.get()}) {
      program->Signal(SIGINT);
      EXPECT_TRUE(program->Wait(kWithin_s)) << program->Story();
      EXPECT_EQ(program->status(), 0) << program->Story();
    }
    return ReadRecording(Log());
  }
  std::string Log() const { return folder_ / "rover.lcm"; }

  Workspace folder_;
  std::unique_ptr<Program> server_, client_;
};

/// Runs a program that must succeed.
void RunWell(const Words& words) {
  Program program(words, Root().string());
  ASSERT_TRUE(program.Wait(kWithin_s)) << words[0] << " hangs";
  ASSERT_EQ(program.status(), 0) << program.Story();
}

TEST_F(LcmRover, IsParkedByTheExampleProgram) {
  SEAM_INSIDE_ONLY();
  RunWell({"lcm-gen", "--cpp", "--cpp-hpath", folder_ / "types", "lcmtypes/drive_t.lcm",
           "lcmtypes/message_t.lcm", "lcmtypes/pose_t.lcm"});
  RunWell({"c++", "-Wall", "-Werror=unused", "-I", folder_ / "types", "docs/examples/rover.cpp",
           "-llcm", "-o", folder_ / "rover"});
  Program logger(
      {"lcm-logger", "--lcm-url=" + std::string(kUrl), "--quiet", folder_ / "stock.lcm"});
  Start();
  if (HasFatalFailure()) return;
  Program rover({"env", "LCM_DEFAULT_URL=" + std::string(kUrl), folder_ / "rover"});
  ASSERT_TRUE(rover.Wait(kWithin_s)) << rover.Story() << server_->Story() << client_->Story();
  EXPECT_EQ(rover.output(), "parked\n");
  logger.Signal(SIGINT);
  EXPECT_TRUE(logger.Wait(kWithin_s));
  const Recording recording = End();
  int opened = 0;
  for (const Event& event : recording.events) {
    opened += event.text.find("the gate opens for a rover ") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(opened, 1);
  bool scored = false;
  for (const Meta& meta : recording.meta) {
    for (std::size_t i = 0; i < meta.key.size(); ++i) {
      scored = scored ||
               (meta.kind[i] == kMetaPlayer && meta.key[i] == kMetaScore && meta.value[i] == 10);
    }
  }
  EXPECT_TRUE(scored) << "it stands in the bay";

  // The stock logger has the poses: at 30 a second one for two ticks.
  LogReader reader(folder_ / "stock.lcm");
  std::int64_t before = -1;
  int poses = 0;
  for (LogEvent event; reader.Next(&event);) {
    LcmPose pose;
    if (event.channel != "ROVER.POSE" || !Decode(event.data, &pose).ok()) continue;
    if (pose.name != "rover") continue;
    EXPECT_GT(pose.tick / 2, before / 2);
    before = pose.tick;
    ++poses;
  }
  EXPECT_GT(poses, 60);

  Program replay({BuiltProgram("seam-lab"), "replay", Log()});
  ASSERT_TRUE(replay.Wait(kWithin_s));
  EXPECT_EQ(replay.status(), 0) << replay.Story();
  EXPECT_NE(replay.output().find(" ticks done again"), std::string::npos) << replay.Story();
}

TEST_F(LcmRover, IsParkedByAPythonClientThatAPythonProgramDrives) {
  SEAM_INSIDE_ONLY();
  const std::string module =
      std::filesystem::path(BuiltProgram("seam")).parent_path().string() + "/python";
  if (!std::filesystem::exists(module + "/seam/_seam.so")) GTEST_SKIP() << "make python";
  const Words python = {"env", "PYTHONPATH=" + module, "LCM_DEFAULT_URL=" + std::string(kUrl),
                        "/usr/bin/python3"};
  const auto with = [&](Words words) {
    words.insert(words.begin(), python.begin(), python.end());
    return words;
  };
  Bus bus(kUrl);
  int poses = 0;
  double x = 0;
  bus.Subscribe("ROVER\\.SEEN", [&](const std::string&, std::int64_t, ByteView bytes) {
    LcmPose pose;
    if (!Decode(bytes, &pose).ok() || pose.name != "rover" || pose.peer != 1) return;
    ++poses;
    x = pose.x;
  });
  Serve();
  if (HasFatalFailure()) return;
  Program robot(with({"docs/examples/robot.py", "127.0.0.1:7811"}), Root().string());
  Program rover(with({"docs/examples/rover.py"}), Root().string());
  for (int i = 0; i < 600 && !rover.Wait(0); ++i) bus.Poll(100000);
  ASSERT_TRUE(rover.Wait(kWithin_s)) << rover.Story() << robot.Story() << server_->Story();
  EXPECT_EQ(rover.output(), "parked\n") << rover.Story();
  for (int i = 0; i < 100; ++i) bus.Poll(1000);
  EXPECT_GT(poses, 60) << "one for each tick that it sees";
  EXPECT_NEAR(x, 10, 0.6) << "it sees itself in the bay";
  server_->Signal(SIGINT);
  EXPECT_TRUE(server_->Wait(kWithin_s));
  EXPECT_TRUE(robot.Wait(kWithin_s) && robot.status() == 0) << robot.Story();
}

TEST_F(LcmRover, StandsStillUnderWrongMessagesAndWhenItsDriverIsSilent) {
  SEAM_INSIDE_ONLY();
  Start({"--drive", "lcm:OTHER"});
  if (HasFatalFailure()) return;
  Bus bus(kUrl);
  std::vector<LcmPose> poses;
  bus.Subscribe("ROVER\\.POSE", [&](const std::string&, std::int64_t, ByteView bytes) {
    LcmPose pose;
    if (Decode(bytes, &pose).ok() && pose.name == "rover") poses.push_back(pose);
  });
  const auto poll = [&](int milliseconds, const Bytes& drive) {
    for (int i = 0; i < milliseconds; i += 20) {
      if (!drive.empty()) bus.Publish("OTHER", 0, drive);
      bus.Poll(1000);
      usleep(19000);
    }
    return poses.empty() ? 0.0 : poses.back().x;
  };
  for (int i = 0; i < 50 && poses.empty(); ++i) poll(200, {});
  ASSERT_FALSE(poses.empty()) << server_->Story();
  const double start = poll(1000, {});
  poll(500, Encode(LcmDrive{0, std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  poll(500, Encode(LcmDrive{0, 1e9, 0, 0}));
  poll(500, Encode(LcmMessage{0, "drive", {1}, ""}));
  EXPECT_NEAR(poll(500, Bytes(100, 0xff)), start, 0.01);
  for (const std::string why : {"has a drive that is not in -1..1", "is no seam.drive_t"}) {
    const std::string line = "seam-client: LCM channel OTHER: 1 refused: a message " + why;
    EXPECT_TRUE(client_->WaitForErrors(line, kWithin_s)) << client_->Story();
  }
  const double driven = poll(1500, Encode(LcmDrive{0, 1, 0, 0}));
  EXPECT_GT(driven, start + 1);
  poll(2500, {});  // it is stale after half a second, and a motor at rest holds
  EXPECT_NEAR(poll(500, {}), poses.back().x, 0.01);
  EXPECT_LT(std::abs(poses.back().vx), 0.02);
  // A flood of sensor messages, and wrong ones, neither stop the script nor the room.
  for (int i = 0; i < 3000; ++i) {
    bus.Publish("ROVER.SENSOR", 0, Encode(LcmMessage{0, "rain", {9}, ""}));
  }
  bus.Publish("ROVER.SENSOR", 0, Bytes(30, 7));
  poll(500, {});
  EXPECT_TRUE(
      server_->WaitForErrors("ROVER.SENSOR: 100 refused: a message comes too often", kWithin_s));
  usleep(500000);
  bus.Publish("ROVER.SENSOR", 0, Bytes(30, 7));
  EXPECT_TRUE(
      server_->WaitForErrors("ROVER.SENSOR: 1 refused: a message is no seam.message_t", kWithin_s));
  bus.Publish("ROVER.SENSOR", 0, Encode(LcmMessage{0, "gate", {2}, ""}));
  poll(1000, {});
  const Recording recording = End();
  int opened = 0;
  for (const Event& event : recording.events) {
    opened += event.text == "the gate opens for a rover 2.0 m away" ? 1 : 0;
  }
  EXPECT_EQ(opened, 1) << "the script lives";
}

TEST_F(LcmRover, MistakesAreOneLine) {
  SEAM_INSIDE_ONLY();
  const std::pair<Words, const char*> mistakes[] = {
      {{"--drive", "lcm:a b"}, "--drive lcm:CHANNEL: channel must be 1 to 63 letters"},
      {{"--drive", "lcm:SEAM.x"}, "is used by the rooms themselves: choose another name"},
      {{"--drive", "lcm", "--lcm-url", "none"}, "--drive lcm: not with --lcm-url none"}};
  for (const auto& [words, says] : mistakes) {
    Words all = {BuiltProgram("seam-client"), "127.0.0.1:7811", "--name", "ann"};
    all.insert(all.end(), words.begin(), words.end());
    Program client(all);
    ASSERT_TRUE(client.Wait(kWithin_s));
    EXPECT_EQ(client.status(), 2) << client.Story();
    EXPECT_NE(client.errors().find(says), std::string::npos) << client.Story();
  }
  Program server({BuiltProgram("seam-server"), (Root() / "scenes/crossing.toml").string(), "--bind",
                  "127.0.0.1", "--port", "7812", "--lcm-url", "none", "--duration", "0"});
  ASSERT_TRUE(server.WaitForErrors("Ctrl-C", kWithin_s)) << server.Story();
  Program client({BuiltProgram("seam-client"), "127.0.0.1:7812", "--name", "ann", "--drive", "lcm",
                  "--quiet", "--lcm-url", kUrl});
  ASSERT_TRUE(client.Wait(kWithin_s));
  EXPECT_EQ(client.status(), 2) << client.Story();
  EXPECT_EQ(client.errors(),
            "seam-client: the scene has no [[lcm.drive]] for player ann: --drive lcm:CHANNEL names "
            "a channel\n");
}

}  // namespace lcm_test
}  // namespace seam
