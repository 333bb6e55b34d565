/// A room that is killed and resumed from its last snapshot and its log, in virtual time.

#include <gtest/gtest.h>

#include <cmath>

#include "client/embed/cluster.h"
#include "common/sync/method.h"
#include "server/room_state.h"
#include "server/rules/rules.h"
#include "server/saved/log_tail.h"
#include "tests/support/arena.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace resume_cluster_test {

/// The server of a cluster at its death, and what has come of it.
struct Revived {
  std::int64_t saved_tick = 0, killed_tick = 0;
  std::unique_ptr<Server> server;
  double farthest_m = 0;  ///< of the bodies, from the dead server's
};

/// Keeps the server's messages alone, as the log of its process has no others: a client's tick
/// would take the place of the server's last seal.
class ServerLog : public Recorder {
 public:
  explicit ServerLog(RoomLog& log) : log_(log) {}
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
    if (PublisherOfChannel(channel) == 0) log_.Publish(channel, utime, message);
  }
  void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override {
    if (PublisherOfChannel(channel) == 0) log_.EndTick(channel, seal, kept);
  }

 private:
  RoomLog& log_;
};

/// Plays to `tick` with a snapshot at `saved_tick`, and resumes the room from its log.
class Killed {
 public:
  Killed(ClusterConfig config, std::int64_t saved_tick, std::int64_t tick) {
    config.keep = false;
    RoomLog log(file_.path(), true, nullptr);
    ServerLog servers(log);
    config.recorder = &servers;
    cluster_ = std::make_unique<Cluster>(config);
    cluster_->RunToTick(saved_tick);
    EXPECT_EQ(cluster_->server().tick(), saved_tick);
    const LogPlace place = log.Pin();
    const Bytes bytes = cluster_->server().Save(cluster_->now_us());
    cluster_->RunToTick(tick);
    Status status = ReadLogTail(file_.path(), "main", place, nullptr, &tail);
    EXPECT_TRUE(status.ok()) << status.why();
    EXPECT_EQ(tail.damage, "");
    EXPECT_EQ(tail.last_tick, tick) << "the tick is in the log before its datagrams leave";
    const std::unique_ptr<const SavedRoom> saved = SavedRoom::Read(bytes, &status);
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

  LogTail tail;
  std::unique_ptr<Server> server;

 private:
  class Silence : public Recorder {
   public:
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };
  TemporaryFile file_;
  std::unique_ptr<Cluster> cluster_;
  MemoryNetwork network_;
  Silence silence_;
  SeededEntropy entropy_{3};
  std::unique_ptr<Net> net_;
};

TEST(ResumeCluster, TheWorldIsWhereItWas) {
  for (const char* scene : {"crossing", "rally", "seesaw", "gluehouse", "playground"}) {
    ClusterConfig config;
    config.scene = scene;
    config.drive = Drive::kBot;
    for (const std::int64_t killed : {301, 450, 590}) {
      Killed room(config, 300, killed);
      ASSERT_TRUE(room.server != nullptr);
      EXPECT_EQ(room.server->tick(), killed);
      EXPECT_EQ(room.server->replica().world().composition().hash,
                room.dead().replica().world().composition().hash)
          << scene << " " << killed;
      std::printf("%s, killed %lld ticks after its snapshot: jump %.2e m\n", scene,
                  static_cast<long long>(killed - 300), room.Jump());
      EXPECT_LT(room.Jump(), 0.05) << scene << " " << killed;
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

}  // namespace resume_cluster_test
}  // namespace seam
