/// An operator changes a room that runs: all clients follow, and the log has it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "common/measure/screen/input_delays.h"
#include "common/record/events/event_text.h"
#include "common/record/room_log.h"
#include "server/control/room_control.h"
#include "tests/lab/replay/replayed_room.h"
#include "tests/support/lone_room.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace control_cluster_test {

/// A room with an operator.
class Operated {
 public:
  explicit Operated(const ClusterConfig& config)
      : cluster(config), control(cluster.server(), cluster.server_net(), config.impair) {
    cluster.each_instant = [this] { control.BeforeTick(cluster.now_us()); };
  }
  Status Do(const std::string& command) { return control.Do(cluster.now_us(), command); }
  /// Does it for so many ticks, again each quarter of a second, as a page does while a hand is
  /// held.
  void Hold(const std::string& command, int ticks) {
    for (const std::int64_t end = cluster.server().tick() + ticks; cluster.server().tick() < end;) {
      EXPECT_EQ(Do(command).why(), "");
      cluster.RunToTick(std::min(end, cluster.server().tick() + 15));
    }
  }

  Cluster cluster;
  RoomControl control;
};

/// Returns the texts of the operator's events.
std::vector<std::string> Said(const Recording& recording) {
  std::vector<std::string> said;
  for (const Event& event : recording.events) {
    if (std::string(EventKindName(event.kind)) == "control") said.push_back(event.text);
  }
  return said;
}

ClusterConfig Crossing(const std::string& impair, const std::string& mode = "buffer") {
  ClusterConfig config;
  config.scene = "crossing";
  config.impair = impair;
  config.mode = mode;
  config.drive = Drive::kBot;
  return config;
}

TEST(Control, ANetworkThatChangesIsMeasuredByItsClients) {
  Operated room(Crossing("delay=20ms"));
  room.cluster.RunToTick(240);
  EXPECT_NEAR(room.cluster.client(0)->stats().rtt_us, 40000, 12000);
  EXPECT_EQ(room.Do("impair delay=100ms").why(), "");
  room.cluster.RunToTick(1200);
  for (int c = 0; c < 2; ++c) {
    EXPECT_NEAR(room.cluster.client(c)->stats().rtt_us, 200000, 12000) << c;
  }
  EXPECT_EQ(room.Do("impair perfect").why(), "");
  room.cluster.RunToTick(2160);
  EXPECT_LT(room.cluster.client(1)->stats().rtt_us, 12000);
  EXPECT_EQ(Said(room.cluster.recording()),
            (std::vector<std::string>{"network is now delay=100ms", "network is now perfect"}));
}

/// A wheel that its motor alone moves: ann presses from 2 s to 5 s, and from 7 s on.
const char* const kWheel = R"(
duration = 12
gravity = [0, 0]
[[player]]
name = "ann"
vehicle = "wheel"
region = [[-1000, -1000], [-0.001, 1000]]
script = [[2.0, {drive = 1.0}], [5.0, {}], [7.0, {drive = 1.0}]]
[[player]]
name = "bob"
region = [[0, -1000], [1000, 1000]]
[[part]]
name = "hub"
position = [-5, 5]
circle = 0.2
anchored = true
[[part]]
name = "wheel"
position = [-5, 5]
circle = 1
owner = "ann"
[[joint]]
name = "axle"
kind = "hinge"
a = "hub"
b = "wheel"
motor = {player = "ann", speed = 5, torque = 100}
)";

/// Returns the ticks in which ann's recorded drive changes.
std::vector<std::int64_t> ChangesOfAnn(const Recording& recording) {
  std::map<std::int64_t, int> drive;
  for (const auto& [first, inputs] : recording.inputs.at(0)) {
    for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
      drive[first + static_cast<std::int64_t>(i)] = inputs.drive[i];
    }
  }
  std::vector<std::int64_t> changes;
  int before = 0;
  for (const auto& [tick, now] : drive) {
    if (now != before) changes.push_back(tick);
    before = now;
  }
  return changes;
}

TEST(Control, TheInputDelayChangesAtOneTickAndLosesNoPress) {
  ClusterConfig config;
  config.scene = "wheel";
  config.scene_text = kWheel;
  config.impair = "delay=40ms";
  Operated still(config), changed(config);
  still.cluster.RunToTick(720);
  const std::vector<std::int64_t> presses = ChangesOfAnn(still.cluster.recording());
  ASSERT_EQ(presses.size(), 3u);
  changed.cluster.RunToTick(180);  // she holds
  EXPECT_EQ(changed.Do("input_delay 6").why(), "");
  changed.cluster.RunToTick(360);
  EXPECT_EQ(changed.Do("input_delay 2").why(), "");
  changed.cluster.RunToTick(720);
  const Recording& recording = changed.cluster.recording();
  // The press that is held while the delay grows stays one press.
  EXPECT_EQ(ChangesOfAnn(recording),
            (std::vector<std::int64_t>{presses[0], presses[1] + 6, presses[2] + 2}));
  // The measures know when each was read.
  const InputDelays delays(recording);
  EXPECT_EQ(delays.Of(0, presses[0]), 0);
  EXPECT_EQ(delays.Of(0, presses[1] + 6), 6);
  EXPECT_EQ(delays.Of(0, presses[2] + 2), 2);
  EXPECT_EQ(delays.Of(1, presses[2] + 2), 2) << "of every player";
  EXPECT_EQ(InputDelays(still.cluster.recording()).Of(0, presses[1]), 0);
  EXPECT_EQ(Said(recording),
            (std::vector<std::string>{"input delay is now 6 ticks", "input delay is now 2 ticks"}));
}

/// Returns the greatest age that bob's view of a tick shows, ticks.
float AgeAt(const Recording& recording, std::int64_t tick) {
  const View& view = recording.views.at(2).at(tick);
  return *std::max_element(view.age.begin(), view.age.end());
}

TEST(Control, TheShowAgeChangesOnEveryScreenAndNoPhysicsWithIt) {
  ClusterConfig config = Crossing("delay=80ms");
  config.scene = "scrum";
  Operated room(config);
  room.cluster.RunToTick(300);
  EXPECT_GT(AgeAt(room.cluster.recording(), 290), 3);
  EXPECT_EQ(room.Do("show_age 0").why(), "");
  room.cluster.RunToTick(420);
  EXPECT_EQ(AgeAt(room.cluster.recording(), 410), 0);
  EXPECT_EQ(room.Do("show_age 20").why(), "");
  room.cluster.RunToTick(600);
  EXPECT_GT(AgeAt(room.cluster.recording(), 590), kShowAgeTicks) << "as far as 160 ms need";
  Operated other(config);
  other.cluster.RunToTick(600);
  EXPECT_EQ(other.cluster.server().replica().world().Hash(),
            room.cluster.server().replica().world().Hash());
}

/// Returns the place of a body in a view, m.
Vec2 PlaceOf(const View& view, PartId id) {
  const auto place = std::find(view.id.begin(), view.id.end(), id);
  if (place == view.id.end()) return {0, 0};
  const auto index = static_cast<std::size_t>(place - view.id.begin());
  return {view.x[index], view.y[index]};
}

TEST(Control, ADraggedBodyMovesInEveryViewAndTheLogIsDoneAgainAsItWas) {
  for (const char* mode : {"buffer", "central", "strict"}) {
    SCOPED_TRACE(mode);
    TemporaryFile file;
    Recording recording;
    PartId brick = -1;
    {
      RoomLog log(file.path(), true, nullptr);
      ClusterConfig config = Crossing("4g", mode);
      config.recorder = &log;
      Operated room(config);
      room.cluster.RunToTick(30);
      room.Hold("drag brick 0 0 6 12", 120);
      EXPECT_EQ(room.Do("release brick").why(), "");
      room.cluster.RunToTick(200);
      recording = room.cluster.recording();
      for (const Part& part : room.cluster.scene().parts) {
        if (part.name == "brick") brick = part.id;
      }
    }
    for (int peer = 0; peer <= 2; ++peer) {
      float highest = 0;
      for (const auto& [tick, view] : recording.views.at(peer)) {
        highest = std::max(highest, PlaceOf(view, brick).y());
      }
      EXPECT_GT(highest, 8) << peer;
      // In strict the server's own copy is late, so that the brick swings about the hand.
      if (mode == std::string("strict")) continue;
      const Vec2 place = PlaceOf(recording.views.at(peer).at(145), brick);
      EXPECT_LT((place - Vec2(6, 12)).norm(), 1.5f) << peer;
    }
    EXPECT_EQ(Said(recording), (std::vector<std::string>{"brick is dragged", "brick is let go"}));
    const auto pushes = static_cast<int>(recording.edits.size());
    EXPECT_GT(pushes, 35) << "twenty a second";
    EXPECT_LT(pushes, 45);
    const LoggedRoom logged = ReadLoggedRoom(file.path(), "");
    ReplayedRoom again(logged);
    while (!again.done()) ASSERT_EQ(again.Step(), ReplayedRoom::Tick::kSame) << again.next();
    EXPECT_GE(again.next(), 199u);
  }
}

TEST(Control, AHandThatIsSilentLetsGo) {
  Operated room(Crossing("perfect"));
  room.cluster.RunToTick(30);
  EXPECT_EQ(room.Do("drag brick 0 0 30 12").why(), "");
  room.cluster.RunToTick(180);
  EXPECT_EQ(Said(room.cluster.recording()),
            (std::vector<std::string>{"brick is dragged", "brick is let go"}));
  EXPECT_EQ(room.Do("release brick").why(), "brick is not dragged");
}

TEST(Control, RefusesEachMistakeByOneLineAndChangesNothing) {
  Operated room(Crossing("demo"));
  room.cluster.RunToTick(30);
  const std::string before = room.control.Json();
  for (const char* command : {"",
                              " ",
                              "jump",
                              "impair",
                              "impair 4gg",
                              "impair delay=-1ms",
                              "impair delay=50",
                              "input_delay",
                              "input_delay 13",
                              "input_delay -1",
                              "input_delay 1.5",
                              "input_delay 2 3",
                              "input_delay x",
                              "input_delay 1e999",
                              "input_delay nan",
                              "show_age 31",
                              "show_age",
                              "drag",
                              "drag brick",
                              "drag brick 0 0 1",
                              "drag brick 0 0 1 nan",
                              "drag brick 0 0 1 1 1",
                              "drag brik 0 0 1 1",
                              "drag ground 0 0 1 1",
                              "release",
                              "release brick",
                              "push brick 1",
                              "push brick 1 x",
                              "push brick 1e30 0",
                              "remove brik",
                              "blast 0 0 99 1 1",
                              "impair demo\n",
                              "show_age 3\x01",
                              "push br\xc3\x28ick 1 1"}) {
    const Status done = room.Do(command);
    EXPECT_FALSE(done.ok()) << command;
    EXPECT_EQ(done.why().find('\n'), std::string::npos) << done.why();
  }
  EXPECT_FALSE(room.Do(std::string(5000, 'x')).ok());
  EXPECT_EQ(room.control.Json(), before);
  EXPECT_TRUE(Said(room.cluster.recording()).empty());
  EXPECT_EQ(room.Do("push brick 900 2000").why(), "");
  room.cluster.RunToTick(60);
  EXPECT_EQ(room.cluster.recording().edits.size(), 1u);
  EXPECT_EQ(Said(room.cluster.recording()), std::vector<std::string>{"push brick 900 2000"});
}

TEST(Control, AnOracleHasNobodyWhoFollows) {
  Operated room(Crossing("perfect", "oracle"));
  room.cluster.RunToTick(30);
  EXPECT_FALSE(room.Do("input_delay 3").ok());
  EXPECT_EQ(room.Do("impair demo").why(), "");
}

TEST(Control, SettingsLastWithTheRoom) {
  LoneRoom first(LoadScene("scenes/crossing.toml"));
  first.StepTo(20);
  const LiveSetting& delay = *FindLiveSetting("input_delay");
  EXPECT_EQ(first.server->settings().newest(delay), 0);
  EXPECT_TRUE(first.server->settings().Change(delay, 5).ok());
  first.StepTo(24);
  LoneRoom second(first.Save(), "buffer");
  ASSERT_NE(second.server, nullptr) << second.status.why();
  EXPECT_EQ(second.server->settings().newest(delay), 5);
  EXPECT_EQ(second.server->settings().newest(*FindLiveSetting("show_age")), kShowAgeTicks);
}

}  // namespace control_cluster_test
}  // namespace seam
