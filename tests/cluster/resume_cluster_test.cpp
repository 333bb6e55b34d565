/// A room that is killed and resumed from its last snapshot and its log, in virtual time.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "client/embed/cluster.h"
#include "common/sync/method.h"
#include "server/room_state.h"
#include "server/rules/rules.h"
#include "server/saved/log_begin.h"
#include "server/saved/log_tail.h"
#include "tests/lab/chaos/kept_log.h"
#include "tests/support/arena.h"
#include "tests/support/program.h"
#include "tests/support/soak/server_log.h"

namespace seam {
namespace resume_cluster_test {

/// Plays to `tick` with a snapshot at `saved_tick`, 0: with none, and resumes the room from its
/// log.
class Killed {
 public:
  Killed(ClusterConfig config, std::int64_t saved_tick, std::int64_t tick,
         std::int64_t segment_bytes = 0) {
    config.keep = false;
    const std::string path = folder_ / "main.lcm";
    ServerLog kept(path, segment_bytes);
    config.recorder = &kept;
    cluster_ = std::make_unique<Cluster>(config);
    Bytes bytes;
    if (saved_tick > 0) {
      cluster_->RunToTick(saved_tick);
      EXPECT_EQ(cluster_->server().tick(), saved_tick);
      place = kept.log.Pin();
      bytes = cluster_->server().Save(cluster_->now_us());
    }
    cluster_->RunToTick(tick);
    Status status = ReadLogTail(path, "main", place, saved_tick, nullptr, &tail);
    EXPECT_TRUE(status.ok()) << status.why();
    EXPECT_EQ(tail.damage, "");
    EXPECT_EQ(tail.ticks.empty() ? -1 : tail.ticks.back().tick, tick)
        << "in the log before its datagrams leave";
    const std::unique_ptr<const SavedRoom> saved =
        saved_tick > 0 ? SavedRoom::Read(bytes, &status) : RoomAtLogBegin(path, "main", &status);
    EXPECT_TRUE(saved != nullptr) << status.why();
    if (saved == nullptr) return;
    ServerConfig again;
    again.sync = MakeSyncConfig(MethodNames{config.mode, config.reconcile, config.predict});
    again.sync.tick_hz = saved->room().tick_hz;
    again.sync.send_hz = saved->room().send_hz;
    again.sync.input_delay_ticks = saved->room().input_delay_ticks;
    again.sync.seed = again.seed = saved->room().seed;
    net_ = network_.Attach({1, 7777});
    server = std::make_unique<Server>(*saved, again, *net_, silence_, entropy_);
    status = server->Resume(*saved, 5000000, &tail);
    EXPECT_TRUE(status.ok()) << status.why();
  }

  /// Farthest distance of a body from where the dead server had it, m.
  double Jump() const {
    const World& was = cluster_->server().replica().world();
    const World& is = server->replica().world();
    EXPECT_EQ(is.body_count(), was.body_count());
    double most = 0;
    for (int body = 0; body < std::min(is.body_count(), was.body_count()); ++body) {
      const Vec2 off = is.Read(body).position - was.Read(body).position;
      most = std::max(most, std::hypot(static_cast<double>(off.x()), static_cast<double>(off.y())));
    }
    return most;
  }
  Server& dead() { return cluster_->server(); }

  LogPlace place;  ///< of the snapshot
  LogTail tail;
  std::unique_ptr<Server> server;

 private:
  class Silence : public Recorder {
   public:
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };
  Workspace folder_;
  std::unique_ptr<Cluster> cluster_;
  MemoryNetwork network_;
  Silence silence_;
  SeededEntropy entropy_{3};
  std::unique_ptr<Net> net_;
};

/// Plays and resumes a room with bots; expects that the new server comes to the same bits in every
/// tick of the log. Returns the number of segments that the log had begun since the snapshot.
std::int32_t ExpectSameBits(ClusterConfig config, std::int64_t saved, std::int64_t killed,
                            std::int64_t segment_bytes = 0) {
  config.drive = Drive::kBot;
  SCOPED_TRACE(config.scene + " over " + config.impair + ", seed " + std::to_string(config.seed) +
               ", ticks " + std::to_string(saved) + " to " + std::to_string(killed));
  Killed room(config, saved, killed, segment_bytes);
  EXPECT_TRUE(room.server != nullptr);
  if (room.server == nullptr) return 0;
  EXPECT_EQ(room.server->tick(), killed);
  EXPECT_EQ(room.server->replica().world().composition().hash,
            room.dead().replica().world().composition().hash);
  EXPECT_EQ(room.server->unlike_log(), -1);
  EXPECT_EQ(room.Jump(), 0);
  return room.tail.end.segment - room.place.segment;
}

constexpr const char* kScenes[] = {"crossing", "arena", "rally", "playground", "seesaw",
                                   "ragdolls", "derby", "wall",  "gluehouse",  "heap"};

TEST(ResumeCluster, TheWorldIsWhereItWas) {
  for (const char* scene : {"crossing", "rally", "seesaw", "gluehouse", "playground"}) {
    ClusterConfig config;
    config.scene = scene;
    for (const std::int64_t killed : {301, 450, 590}) ExpectSameBits(config, 300, killed);
  }
}

TEST(ResumeCluster, ALogWithoutSnapshotsBringsTheWorldBack) {
  for (const char* scene : kScenes) {
    ClusterConfig config;
    config.scene = scene;
    ExpectSameBits(config, 0, 301);
    config.impair = "4g";
    ExpectSameBits(config, 0, 150, 20000);
  }
  ClusterConfig central;
  central.mode = "central";
  ExpectSameBits(central, 0, 301);
}

TEST(ResumeCluster, ALogInSegmentsBringsTheWorldBackToo) {
  for (const char* scene : {"crossing", "rally", "gluehouse"}) {
    ClusterConfig config;
    config.scene = scene;
    for (const std::int64_t killed : {450, 590}) {
      EXPECT_GE(ExpectSameBits(config, 300, killed, 20000), 2);
    }
  }
}

TEST(ResumeCluster, LateInputsAndStatesOfBadNetworksActInTheirOwnTicks) {
  const std::vector<const char*> profiles = {"4g", "3g", "terrible"};
  std::size_t next = 0;
  for (const char* scene : kScenes) {
    ClusterConfig config;
    config.scene = scene;
    config.seed = 11;
    for (const char* line :
         {profiles[next++ % profiles.size()], "delay=200ms,jitter=100ms,loss=20%"}) {
      config.impair = line;
      ExpectSameBits(config, 120, 240);
    }
  }
}

TEST(ResumeCluster, ScoresScriptsAndEditsAreThoseOfTheDeadServer) {
  ClusterConfig config;
  config.scene_text = kArena;
  for (const std::int64_t killed : {62, 100, 201, 355}) {
    Killed room(config, 60, killed);
    ASSERT_TRUE(room.server != nullptr);
    EXPECT_EQ(room.server->replica().revision(), room.dead().replica().revision());
    EXPECT_EQ(room.server->replica().world().composition().hash,
              room.dead().replica().world().composition().hash);
    EXPECT_EQ(room.server->rules()->metadata().values(), room.dead().rules()->metadata().values());
    EXPECT_LT(room.Jump(), 0.01);
  }
}

/// Plays with bob's client gone and back between the snapshot and the death of the server, and
/// expects both players back soon after.
void ExpectBothBack(const std::function<void(Cluster*)>& leave, int restarts) {
  KeptLog kept;
  ClusterConfig config;
  config.keep = false;
  config.recorder = &kept;
  Cluster cluster(config);
  cluster.each_instant = [&] { kept.Look(cluster); };
  cluster.RunToTick(310);  // a snapshot is of tick 300
  leave(&cluster);
  cluster.RunToTick(340);
  cluster.Revive(1);
  cluster.RunToTick(450);
  ASSERT_EQ(cluster.server().player_count(), 2);
  std::vector<std::string> broken;
  for (int i = 0; i < restarts; ++i) {
    ASSERT_TRUE(kept.Restart(cluster, 100000, &broken));
    cluster.RunToTick(cluster.server().tick() + 30);
  }
  cluster.RunToTick(cluster.server().tick() + 180);
  EXPECT_EQ(cluster.server().player_count(), 2);
  for (const std::string& line : broken) ADD_FAILURE() << line;
}

TEST(ResumeCluster, APlaceTakenSinceTheSnapshotIsItsOwners) {
  ExpectBothBack([](Cluster* cluster) { cluster->Leave(1); }, 1);  // another key
  ExpectBothBack([](Cluster* cluster) { cluster->Kill(1); }, 1);   // the same key
}

TEST(ResumeCluster, AServerThatDiesAgainBeforeASnapshotLosesNoPlace) {
  ExpectBothBack([](Cluster* cluster) { cluster->Leave(1); }, 3);
}

}  // namespace resume_cluster_test
}  // namespace seam
