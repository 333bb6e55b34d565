/// Messages of other programs to the scripts of a room: they act at every peer, and the log has
/// them, so that the room can be done again and resumed.

#include <gtest/gtest.h>

#include "client/embed/cluster.h"
#include "common/codec/codec.h"
#include "common/record/room_log.h"
#include "common/sync/method.h"
#include "server/room_state.h"
#include "server/rules/rules.h"
#include "server/saved/log_tail.h"
#include "tests/lab/replay/replayed_room.h"
#include "tests/support/soak/server_log.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace message_cluster_test {

/// A ball that the script kicks as a message says, and by chance.
constexpr const char* kYard = R"(title = "A yard"
[[player]]
name = "ann"
[[part]]
name = "ground"
chain = [[-90, 0], [90, 0]]
[[part]]
name = "ball"
circle = 0.5
position = [0, 0.5]
[[script]]
name = "kicker"
code = '''
function on_message(channel, m)
  room.heard = (room.heard or 0) + 1
  world.impulse("ball", m.values[1], m.values[2] + math.random(), m.text)
  world.set("ann", "value0", room.heard)
end
'''
[[lcm.message]]
channel = "KICK"
)";

ClusterConfig Yard(Recorder* recorder) {
  ClusterConfig config;
  config.scene_text = kYard;
  config.impair = "delay=40ms,loss=5%";
  config.recorder = recorder;
  return config;
}

/// Sends a message each 7 ticks, up to a tick.
void Play(Cluster* cluster, std::int64_t to) {
  while (cluster->server().tick() < to) {
    const std::int64_t tick = std::max<std::int64_t>(0, cluster->server().tick());
    const double kick = tick % 3 == 0 ? -0.4 : 0.7;
    EXPECT_TRUE(cluster->server().rules()->Queue({"KICK", {tick, "kick", {kick, 0.3}, "a kick"}}));
    cluster->RunToTick(std::min(to, tick + 7));
  }
}

float Heard(const Server& server) {
  return server.rules()->metadata().Get({kMetaPlayer, 0, kMetaScripts});
}

TEST(Messages, MoveABodyAtEveryPeer) {
  Cluster cluster(Yard(nullptr));
  Play(&cluster, 300);
  EXPECT_EQ(Heard(cluster.server()), 43);
  const float x = cluster.server().replica().world().Read(0).position.x();
  EXPECT_GT(std::abs(x), 1);
  cluster.RunToTick(600);
  EXPECT_NEAR(cluster.server().replica().world().Read(0).position.x(),
              cluster.client(0)->replica()->world().Read(0).position.x(), 0.01);
}

TEST(Messages, AreDoneAgainFromTheLog) {
  TemporaryFile file;
  {
    RoomLog log(file.path(), true, nullptr);
    Cluster cluster(Yard(&log));
    Play(&cluster, 300);
  }
  const LoggedRoom logged = ReadLoggedRoom(file.path(), "");
  ReplayedRoom room(logged);
  while (!room.done()) ASSERT_EQ(room.Step(), ReplayedRoom::Tick::kSame) << room.server().tick();
  EXPECT_EQ(room.server().tick(), 300);
  EXPECT_EQ(Heard(room.server()), 43);
  // Without one of them the room is another one.
  LoggedRoom less = logged;
  std::int64_t left_out = -1;
  for (TickMessages& tick : less.ticks) {
    for (AnyMessage& message : tick.before) {
      auto* accepted = std::get_if<Accepted>(&message);
      LcmHeard heard;
      if (accepted == nullptr || !Decode(accepted->data, &heard).ok() || tick.tick < 100) continue;
      if (left_out >= 0) continue;
      EXPECT_EQ(heard.channel, "KICK");
      EXPECT_EQ(heard.message.text, "a kick");
      accepted->data = Encode(Pong());
      left_out = tick.tick;
    }
  }
  ASSERT_GE(left_out, 100);
  ReplayedRoom other(less);
  std::int64_t first = -1;
  while (!other.done() && first < 0) {
    if (other.Step() != ReplayedRoom::Tick::kSame) first = other.server().tick();
  }
  EXPECT_EQ(first, left_out);
}

TEST(Messages, AreInTheTailOfAResumedRoom) {
  class Silence : public Recorder {
   public:
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };
  TemporaryFile file;
  ServerLog kept(file.path());
  Cluster cluster(Yard(&kept));
  Play(&cluster, 150);
  const LogPlace place = kept.log.Pin();
  const Bytes bytes = cluster.server().Save(cluster.now_us());
  Play(&cluster, 300);
  LogTail tail;
  Status status = ReadLogTail(file.path(), "main", place, 150, nullptr, &tail);
  ASSERT_TRUE(status.ok()) << status.why();
  ASSERT_EQ(tail.ticks.size(), 150u);
  const std::unique_ptr<const SavedRoom> saved = SavedRoom::Read(bytes, &status);
  ASSERT_TRUE(saved != nullptr) << status.why();
  ServerConfig config;
  config.sync = MakeSyncConfig(MethodNames{"buffer", "", ""});
  config.sync.tick_hz = saved->room().tick_hz;
  config.sync.send_hz = saved->room().send_hz;
  config.sync.input_delay_ticks = saved->room().input_delay_ticks;
  config.sync.seed = config.seed = saved->room().seed;
  MemoryNetwork network;
  const auto net = network.Attach({1, 7777});
  Silence silence;
  SeededEntropy entropy(8);
  Server again(*saved, config, *net, silence, entropy);
  status = again.Resume(*saved, 5000000, &tail);
  ASSERT_TRUE(status.ok()) << status.why();
  EXPECT_EQ(again.unlike_log(), -1);
  EXPECT_EQ(again.tick(), 300);
  EXPECT_EQ(Heard(again), Heard(cluster.server()));
  EXPECT_EQ(again.replica().world().Hash(), cluster.server().replica().world().Hash());
  // The script itself has heard them, too, and goes on with its count.
  EXPECT_TRUE(again.rules()->Queue({"KICK", {0, "kick", {0, 0}, "one more"}}));
  again.Tick(again.next_tick_us(), 0);
  EXPECT_EQ(again.tick(), 301);
  EXPECT_EQ(Heard(again), Heard(cluster.server()) + 1);
}

TEST(Messages, AreRefusedBeyondWhatATickMayHave) {
  Cluster cluster(Yard(nullptr));
  cluster.RunToTick(60);
  const LcmHeard heard{"KICK", {0, "kick", {0, 0}, "none"}};
  for (std::size_t i = 0; i < Rules::kMessagesMax; ++i) {
    ASSERT_TRUE(cluster.server().rules()->Queue(heard));
  }
  EXPECT_FALSE(cluster.server().rules()->Queue(heard));
  cluster.RunToTick(61);
  EXPECT_TRUE(cluster.server().rules()->Queue(heard));
}

}  // namespace message_cluster_test
}  // namespace seam
