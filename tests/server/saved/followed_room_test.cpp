/// A room that is followed by its log while its server writes it, in virtual time.

#include "server/saved/followed_room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "client/embed/cluster.h"
#include "common/base/check.h"
#include "common/record/disk_thread.h"
#include "common/record/room_log.h"
#include "server/saved/snapshot_file.h"
#include "server/saved/trial_load.h"
#include "tests/support/arena.h"
#include "tests/support/program.h"
#include "tests/support/soak/server_log.h"

namespace seam {
namespace followed_room_test {

struct Silence : Recorder {
  void Publish(const std::string&, std::int64_t, ByteView) override {}
  bool listening() const override { return false; }
};

/// A server whose room is kept in a folder, with its clients.
class Kept {
 public:
  explicit Kept(ClusterConfig config, bool syncs = true, std::int64_t segment_bytes = 0)
      : log_(folder_ / "main.lcm", segment_bytes, syncs ? &disk_ : nullptr) {
    config.keep = false;
    config.recorder = &log_;
    cluster = std::make_unique<Cluster>(config);
  }
  void RunTo(std::int64_t tick) { cluster->RunToTick(tick); }
  void Save(std::int32_t epoch = 1) {
    RoomSnapshot snapshot;
    snapshot.log = log_.log.Pin();
    snapshot.tick = server().tick();
    snapshot.room = server().Save(cluster->now_us());
    EXPECT_TRUE(WriteSnapshot(folder_.path(), "main", snapshot, epoch).ok());
  }
  std::unique_ptr<FollowedRoom> Open(std::int32_t epoch = 1) const {
    return std::make_unique<FollowedRoom>(folder_.path(), "main", epoch, nullptr);
  }
  std::string Log() const { return folder_ / "main.lcm"; }
  Server& server() const { return cluster->server(); }

 private:
  Workspace folder_;
  DiskThread disk_;
  ServerLog log_;

 public:
  std::unique_ptr<Cluster> cluster;  // ends before its log
};

/// The next server of a room.
struct Next {
  explicit Next(const ResumedRoom& resumed) : net(network.Attach({1, 7777})) {
    ServerConfig config = ConfigOf(resumed.saved->room());
    config.epoch = resumed.epoch;
    server = std::make_unique<Server>(*resumed.saved, config, *net, silence, entropy);
    const Status status = server->Resume(*resumed.saved, 5000000, &resumed.tail);
    EXPECT_TRUE(status.ok()) << status.why();
  }
  MemoryNetwork network;
  std::unique_ptr<Net> net;
  Silence silence;
  SeededEntropy entropy{3};
  std::unique_ptr<Server> server;
};

double Jump(const Server& dead, const Server& next) {
  const World &was = dead.replica().world(), &is = next.replica().world();
  EXPECT_EQ(is.body_count(), was.body_count());
  double most = 0;
  for (int body = 0; body < std::min(is.body_count(), was.body_count()); ++body) {
    const Vec2 off = is.Read(body).position - was.Read(body).position;
    most = std::max(most, std::hypot(static_cast<double>(off.x()), static_cast<double>(off.y())));
  }
  return most;
}

/// Follows until there is nothing left to do.
Status CatchUp(FollowedRoom& followed, std::int64_t now_us) {
  Status status = followed.Follow(now_us);
  while (status.ok() && followed.behind() > 0) status = followed.Follow(now_us);
  return status;
}

TEST(FollowedRoomCluster, IsAtTheServersBitsInEachTickAndGoesOnWithThem) {
  struct Case {
    const char *scene, *impair;
    bool syncs;
    std::int64_t segment_bytes;
  };
  for (const Case& each : {Case{"crossing", "demo", true, 0}, Case{"crossing", "4g", false, 0},
                           Case{"rally", "demo", true, 40000}, Case{"gluehouse", "demo", true, 0},
                           Case{"playground", "terrible", true, 0}}) {
    SCOPED_TRACE(std::string(each.scene) + " over " + each.impair);
    ClusterConfig config;
    config.scene = each.scene;
    config.impair = each.impair;
    config.drive = Drive::kBot;
    Kept kept(config, each.syncs, each.segment_bytes);
    kept.RunTo(300);
    kept.Save();
    kept.RunTo(340);
    const auto followed = kept.Open();
    EXPECT_EQ(followed->tick(), 300);
    for (std::int64_t tick = 341; tick < 600; tick += 1 + tick % 5) {
      kept.RunTo(tick);
      if (tick == 400) kept.Save();  // as servers do each few seconds
      const Status status = CatchUp(*followed, 1000000 + tick * 16667);
      ASSERT_TRUE(status.ok()) << status.why();
      ASSERT_EQ(followed->tick(), tick);
    }
    kept.RunTo(615);
    EXPECT_EQ(followed->present().size(), kept.server().scene().players.size());
    const std::shared_ptr<ResumedRoom> resumed = followed->Finish(20000000, 2);
    EXPECT_EQ(resumed->tick(), 615) << "with what came since the last call";
    EXPECT_EQ(resumed->epoch, 2);
    EXPECT_TRUE(resumed->new_log);
    EXPECT_EQ(resumed->notes.size(), 0u);
    const Next next(*resumed);
    EXPECT_EQ(next.server->tick(), 615);
    EXPECT_EQ(next.server->unlike_log(), -1);
    EXPECT_EQ(Jump(kept.server(), *next.server), 0);
  }
}

TEST(FollowedRoomCluster, KeepsScoresScriptsAndEdits) {
  ClusterConfig config;
  config.scene_text = kArena;
  Kept kept(config);
  kept.RunTo(60);
  kept.Save();
  const auto followed = kept.Open();
  for (std::int64_t tick = 64; tick <= 356; tick += 4) {
    kept.RunTo(tick);
    const Status status = CatchUp(*followed, 1000000 + tick * 16667);
    ASSERT_TRUE(status.ok()) << status.why();
  }
  const Next next(*followed->Finish(20000000, 2));
  EXPECT_EQ(next.server->replica().revision(), kept.server().replica().revision());
  EXPECT_EQ(next.server->replica().world().composition().hash,
            kept.server().replica().world().composition().hash);
  EXPECT_LT(Jump(kept.server(), *next.server), 0.01);
}

TEST(FollowedRoomCluster, ATickOfWhichAPartIsThereWaitsForTheRest) {
  ClusterConfig config;
  config.scene = "crossing";
  Kept kept(config);
  kept.RunTo(120);
  kept.Save();
  kept.RunTo(200);
  const auto followed = kept.Open();
  ASSERT_TRUE(CatchUp(*followed, 1000000).ok());
  ASSERT_EQ(followed->tick(), 200);
  const auto whole = std::filesystem::file_size(kept.Log());
  std::ifstream in(kept.Log(), std::ios::binary);
  const std::string before((std::istreambuf_iterator<char>(in)), {});
  kept.RunTo(201);
  std::ifstream again(kept.Log(), std::ios::binary);
  const std::string after((std::istreambuf_iterator<char>(again)), {});
  const auto write = [&](const std::string& bytes) {
    std::ofstream(kept.Log(), std::ios::binary | std::ios::trunc) << bytes;
  };
  for (std::size_t bytes = whole - 200; bytes < after.size(); bytes += 37) {
    // A write that has come so far, over what was there.
    std::string part = after.substr(0, bytes);
    if (part.size() < before.size()) part += before.substr(part.size());
    write(part);
    const Status status = CatchUp(*followed, 1100000);
    ASSERT_TRUE(status.ok()) << bytes << " bytes: " << status.why();
    ASSERT_EQ(followed->tick(), 200) << bytes;
  }
  write(after);
  ASSERT_TRUE(CatchUp(*followed, 1200000).ok());
  EXPECT_EQ(followed->tick(), 201);
}

TEST(FollowedRoomCluster, DamageIsToldInOneLineAndEndsIt) {
  ClusterConfig config;
  config.scene = "crossing";
  Kept kept(config);
  kept.RunTo(120);
  kept.Save();
  const auto saved = static_cast<std::streamoff>(std::filesystem::file_size(kept.Log()));
  kept.RunTo(400);
  {
    std::fstream file(kept.Log(), std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(saved + 2000);
    file << "damage";
  }
  const auto followed = kept.Open();
  EXPECT_TRUE(CatchUp(*followed, 1000000).ok()) << "it may be a write under way";
  const Status status = CatchUp(*followed, 1000000 + FollowedRoom::kDamagedUs);
  EXPECT_FALSE(status.ok());
  EXPECT_NE(status.why().find("is damaged after tick"), std::string::npos) << status.why();
  EXPECT_EQ(status.why().find('\n'), std::string::npos);
}

TEST(FollowedRoomCluster, SeesTheEndOfTheRoomAlsoBehindATickThatItHasRead) {
  for (int ticks = 1; ticks <= 12; ++ticks) {
    for (const bool read : {true, false}) {
      SCOPED_TRACE(std::to_string(ticks) + (read ? ", read" : ", not read"));
      ClusterConfig config;
      config.scene = "crossing";
      Kept kept(config);
      kept.RunTo(60);
      kept.Save();
      const auto followed = kept.Open();
      kept.RunTo(60 + ticks);
      if (read) {
        ASSERT_TRUE(CatchUp(*followed, 3000000).ok());
        EXPECT_FALSE(followed->ended());
      }
      Redirect to;
      to.address = "10.0.0.2:7777";
      to.room = "main";
      to.epoch = 2;
      kept.server().RedirectAll(kept.cluster->now_us(), to);
      ASSERT_TRUE(CatchUp(*followed, 3010000).ok());
      EXPECT_TRUE(followed->ended());
      EXPECT_EQ(followed->Finish(3020000, 2)->tick(), 60 + ticks);
    }
  }
}

TEST(FollowedRoomCluster, OneThatFallsBehindIsGivenUp) {
  ClusterConfig config;
  config.scene = "crossing";
  Kept kept(config);
  kept.RunTo(60);
  kept.Save();
  kept.RunTo(60 + (FollowedRoom::kFollowBehindS + 1) * 60);
  const auto followed = kept.Open();
  const Status status = followed->Follow(1000000);
  EXPECT_FALSE(status.ok());
  EXPECT_NE(status.why().find("ticks behind"), std::string::npos) << status.why();
}

TEST(FollowedRoomCluster, RefusesAnotherEpochAndARoomWithoutSnapshot) {
  ClusterConfig config;
  config.scene = "crossing";
  Kept kept(config);
  kept.RunTo(120);
  EXPECT_THROW(kept.Open(), OperatorError);
  kept.Save();
  EXPECT_THROW(kept.Open(2), OperatorError) << "of a server before this one";
  EXPECT_EQ(kept.Open()->tick(), 120);
}

}  // namespace followed_room_test
}  // namespace seam
