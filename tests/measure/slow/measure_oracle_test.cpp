/// The computed oracle repeats the recorded session to the bit; and seam-measure as a program.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/measure/table.h"
#include "common/physics/world.h"
#include "common/record/log_file.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace measure_oracle_test {

/// A box that its motor-less player may kick, and another that it hits.
const char* const kScene = R"(
title = "Kick"
gravity = [0, -10]
duration = 2
[[part]]
name = "ground"
chain = [[-100, 0], [100, 0]]
[[part]]
name = "box"
box = [1, 1]
position = [0, 0.5]
friction = 0
[[part]]
name = "other"
box = [1, 1]
position = [3, 0.5]
[[part]]
name = "wheel"
circle = 0.5
position = [-9, 0.51]
[[part]]
name = "axle"
box = [1, 0.4]
position = [-9, 0.51]
[[joint]]
name = "hub"
kind = "wheel"
a = "axle"
b = "wheel"
frequency = 5
motor = {player = "ann", speed = 20, torque = 20}
[[player]]
name = "ann"
vehicle = "axle"
actions = [{button = 2, part = "box", impulse = [6, 0]}]
script = [[0.0, {drive = 1.0}]]
[[watch]]
struck = "other"
around = 0.2
)";
constexpr PartId kBox = 1, kOther = 2, kWheel = 3;

/// The view of everything in a world, by one peer.
View ViewOf(const World& world, int peer) {
  View view;
  view.peer = peer;
  view.tick = world.tick();
  view.sequence = static_cast<std::int32_t>(world.tick());
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState state = world.Read(body);
    view.id.push_back(world.id(body));
    view.role.push_back(peer == 0 ? kRoleAuthority : kRoleSecondary);
    view.authority.push_back(0);
    view.x.push_back(state.position.x());
    view.y.push_back(state.position.y());
    view.angle.push_back(state.angle);
    view.vx.push_back(state.velocity.x());
    view.vy.push_back(state.velocity.y());
    view.spin.push_back(state.spin);
    view.age.push_back(0);
  }
  return view;
}

Room MakeRoom(const std::string& mode) {
  Room room;
  room.room = "test";
  room.scene_name = "kick";
  room.scene_text = kScene;
  room.mode = mode;
  room.impair = "perfect";
  return room;
}

Input Drive(int drive, int buttons) {
  Input input;
  input.drive = static_cast<std::int8_t>(drive);
  input.buttons = static_cast<std::int16_t>(buttons);
  return input;
}

/// Ann's inputs: full speed, then a kick while she brakes.
Input InputAt(std::int64_t tick) {
  if (tick < 10) return Drive(0, 0);
  if (tick < 20) return Drive(127, 0);
  return Drive(-60, tick < 35 ? 4 : 0);
}

/// Two seconds of a world on its own, recorded; ann's inputs in overlapping pieces of four ticks.
Recording Simulate(const std::string& mode) {
  Recording recording;
  recording.room = MakeRoom(mode);
  World world(ParseScene(kScene, "kick.toml"));
  recording.views[0][0] = ViewOf(world, 0);
  recording.views[1][0] = ViewOf(world, 1);
  for (std::int64_t tick = 1; tick <= 120; ++tick) {
    world.SetInput(0, InputAt(tick));
    if (tick == 20) world.Act(0, 0);
    world.Step();
    for (const int peer : {0, 1}) recording.views[peer][tick] = ViewOf(world, peer);
    Inputs& inputs = recording.inputs[0][tick];
    inputs.first_tick = tick;
    for (std::int64_t t = tick; t < tick + 4; ++t) {
      inputs.drive.push_back(InputAt(t).drive);
      inputs.lift.push_back(InputAt(t).lift);
      inputs.buttons.push_back(InputAt(t).buttons);
    }
  }
  recording.last_tick = 120;
  return recording;
}

bool SameState(const BodyState& a, const BodyState& b) {
  return a.position == b.position && a.angle == b.angle && a.velocity == b.velocity &&
         a.spin == b.spin;
}

TEST(ComputedOracle, RepeatsARecordedSessionToTheBit) {
  const Recording recording = Simulate("oracle");
  const Oracle computed = ComputeOracle(recording), given = OracleFromRecording(recording);
  ASSERT_EQ(computed.ids, given.ids);
  ASSERT_EQ(computed.ticks.size(), given.ticks.size());
  for (std::size_t t = 0; t < computed.ticks.size(); ++t) {
    for (std::size_t b = 0; b < computed.ids.size(); ++b) {
      ASSERT_TRUE(SameState(computed.ticks[t][b], given.ticks[t][b])) << t << " " << b;
    }
  }
  const Measures m = Measure(recording, computed);
  EXPECT_EQ(m.error_max_m, 0);
  EXPECT_EQ(m.stutter_mps2, 0);
  EXPECT_EQ(m.backsteps, 0);
  EXPECT_EQ(m.rebound.value(), 1);
  EXPECT_GT(computed.At(120, kOther)->position.x(), 3.05f);  // it really was hit
}

TEST(ComputedOracle, FollowsTheRecordedInputsAndNotTheScript) {
  Recording recording = Simulate("buffer");
  const Oracle driven = ComputeOracle(recording);
  recording.inputs.clear();
  const Oracle alone = ComputeOracle(recording);
  EXPECT_GT(driven.At(20, kWheel)->spin, 1);
  EXPECT_NEAR(alone.At(120, kWheel)->spin, 0, 1e-3);
  EXPECT_NEAR(alone.At(120, kOther)->position.x(), 3, 1e-3);
}

TEST(ComputedOracle, HoldsAxesOverMissingTicksAndPressesOncePerPress) {
  Recording recording = Simulate("buffer");
  const Oracle whole = ComputeOracle(recording);
  // Only where something changes, each for one tick: everything else is held.
  auto& inputs = recording.inputs[0];
  for (auto piece = inputs.begin(); piece != inputs.end();) {
    const bool keep = piece->first == 10 || piece->first == 20 || piece->first == 35;
    piece->second.drive.resize(1);
    piece->second.lift.resize(1);
    piece->second.buttons.resize(1);
    piece = keep ? std::next(piece) : inputs.erase(piece);
  }
  const Oracle sparse = ComputeOracle(recording);
  for (const std::int64_t tick : {19, 21, 60, 120}) {
    for (const PartId id : {kBox, kOther, kWheel}) {
      EXPECT_TRUE(SameState(*whole.At(tick, id), *sparse.At(tick, id))) << tick << " " << id;
    }
  }
}

TEST(ComputedOracle, IgnoresInputsOfPlayersTheSceneDoesNotHave) {
  Recording recording = Simulate("buffer");
  const Oracle right = ComputeOracle(recording);
  recording.inputs[31] = recording.inputs[0];
  recording.inputs[-1] = recording.inputs[0];
  EXPECT_TRUE(SameState(*right.At(120, kBox), *ComputeOracle(recording).At(120, kBox)));
}

TEST(ComputedOracle, RefusesASceneThatDoesNotParseAndASessionWithoutEnd) {
  Recording recording = Simulate("buffer");
  recording.last_tick = std::int64_t{1} << 60;
  EXPECT_THROW((void)ComputeOracle(recording), OperatorError);
  recording.room.scene_text = "[[part]]\nshape = 7\n";
  EXPECT_THROW((void)ComputeOracle(recording), OperatorError);
}

// ---- the program

/// Writes a recording as a log.
void WriteLog(const Recording& recording, const std::string& path) {
  LogWriter log(path, true);
  const auto publish = [&](const char* kind, int peer, const Bytes& message) {
    log.Publish(ChannelName("test", kind, peer), 0, message);
  };
  publish("room", -1, Encode(recording.room));
  for (const auto& [first_tick, inputs] : recording.inputs.at(0)) {
    publish("inputs", 0, Encode(inputs));
  }
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) publish("view", peer, Encode(view));
  }
}

class MeasureProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("SEAM_BIN");
    if (folder == nullptr) GTEST_SKIP() << "SEAM_BIN does not say where the programs are";
    program_ = std::string(folder) + "/seam-measure";
    Recording run = Simulate("buffer");
    std::int32_t sequence = 0;
    for (auto& [tick, inputs] : run.inputs.at(0)) inputs.sequence = sequence++;
    WriteLog(run, log_.path());
  }

  /// Runs it; its output is in output_. Returns the exit status.
  int Run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program_);
    ChildProcess child(arguments);
    EXPECT_TRUE(child.Wait(60));
    output_ = child.output();
    return child.exit_status();
  }

  /// Lines that it wrote.
  std::ptrdiff_t Lines() const { return std::count(output_.begin(), output_.end(), '\n'); }

  TemporaryFile log_, other_;
  std::string program_, output_;
};

TEST_F(MeasureProgram, PrintsATableAndWritesTheSameAsCsv) {
  EXPECT_EQ(Run({log_.path(), "--csv", other_.path(), "--names", "mine", "--more"}), 0) << output_;
  EXPECT_NE(output_.find("error_rms_m"), std::string::npos);
  EXPECT_NE(output_.find("hand-over"), std::string::npos);
  const std::string line = "kick,mine,buffer,,perfect,0,0,0,0,0,,,0,0,0,0,0,0,1,,,,,,0,\n";
  const Bytes csv = other_.Read();
  EXPECT_EQ(std::string(csv.begin(), csv.end()), CsvHeader() + "\n" + line);
  EXPECT_EQ(Run({"--csv", other_.path(), "--append", "--names", "mine", log_.path()}), 0);
  const Bytes longer = other_.Read();
  EXPECT_EQ(std::string(longer.begin(), longer.end()), CsvHeader() + "\n" + line + line);
}

TEST_F(MeasureProgram, TakesTheOracleFromAnotherRecordingOfTheSameScene) {
  WriteLog(Simulate("oracle"), other_.path());
  EXPECT_EQ(Run({"--oracle", other_.path(), log_.path()}), 0) << output_;
  EXPECT_EQ(Lines(), 2) << output_;
  Recording different = Simulate("oracle");
  different.room.scene_text += "# another file\n";
  WriteLog(different, other_.path());
  EXPECT_EQ(Run({"--oracle", other_.path(), log_.path()}), 2);
  EXPECT_EQ(Lines(), 1) << output_;
  EXPECT_EQ(Run({"--oracle", log_.path(), log_.path()}), 2);  // not made with --mode oracle
  EXPECT_EQ(Lines(), 1) << output_;
}

TEST_F(MeasureProgram, AnswersMistakesWithOneLineAndStatusTwo) {
  const std::vector<std::vector<std::string>> mistakes = {
      {},
      {"--nonsense", log_.path()},
      {"/nowhere/no.lcm"},
      {log_.path(), "--names", "a,b"},
      {log_.path(), "--append"},
      {log_.path(), "--csv", "/nowhere/out.csv"},
      {"--oracle", "/nowhere/no.lcm", log_.path()}};
  for (const auto& arguments : mistakes) {
    EXPECT_EQ(Run(arguments), 2) << output_;
    EXPECT_EQ(Lines(), 1) << output_;
    EXPECT_EQ(output_.rfind("seam-measure: ", 0), 0u) << output_;
  }
  EXPECT_EQ(Run({"--help"}), 0);
}

TEST_F(MeasureProgram, WarnsOfDamageAndMeasuresTheRest) {
  Bytes bytes = log_.Read();
  for (std::size_t at = bytes.size() / 2; at < bytes.size() / 2 + 700; ++at) bytes[at] = 0;
  other_.Write(bytes);
  EXPECT_EQ(Run({other_.path()}), 1) << output_;
  EXPECT_NE(output_.find("warning"), std::string::npos) << output_;
  EXPECT_NE(output_.find("kick"), std::string::npos) << output_;
}

}  // namespace measure_oracle_test
}  // namespace seam
