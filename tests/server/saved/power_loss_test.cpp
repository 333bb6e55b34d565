/// A machine that loses power while a room is kept: the disk has what was synced, and any mixture
/// of old and new sectors of the rest.

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>

#include "client/embed/cluster.h"
#include "common/base/process.h"
#include "common/base/random.h"
#include "common/record/disk_thread.h"
#include "common/sync/method.h"
#include "server/saved/resumed_room.h"
#include "server/saved/room_keeper.h"
#include "server/saved/snapshot_file.h"
#include "tests/support/arena.h"
#include "tests/support/lone_room.h"
#include "tests/support/program.h"

namespace seam {
namespace power_loss_test {

Bytes ReadOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

/// The content of a file as of the begin of its last sync that has ended.
struct Synced {
  std::mutex mutex;  // guards all
  std::string path;  // "": nothing is watched
  Bytes content;
  std::vector<std::int64_t> times_us;  // that its syncs took
};
Synced g_synced;

}  // namespace power_loss_test
}  // namespace seam

/// In the place of the C library's, for this program.
extern "C" int fdatasync(int fd) {
  using seam::power_loss_test::g_synced;
  seam::Bytes content;
  std::string watched;
  {
    const std::lock_guard<std::mutex> lock(g_synced.mutex);
    watched = g_synced.path;
  }
  std::error_code ignored;
  const std::string open = "/proc/self/fd/" + std::to_string(fd);
  const bool is = !watched.empty() && std::filesystem::read_symlink(open, ignored) == watched;
  if (is) content = seam::power_loss_test::ReadOf(watched);
  const std::int64_t begin_us = seam::SteadyClockUs();
  const auto result = static_cast<int>(syscall(SYS_fdatasync, fd));
  if (is && result == 0) {
    const std::lock_guard<std::mutex> lock(g_synced.mutex);
    g_synced.content = std::move(content);
    g_synced.times_us.push_back(seam::SteadyClockUs() - begin_us);
  }
  return result;
}

namespace seam {
namespace power_loss_test {

constexpr std::int64_t kTickUs = 1000000 / 60;
static_assert(RoomLog::kSyncUs + kTickUs <= 60000, "at most 60 ms are lost");

std::int64_t Median(std::vector<std::int64_t> all) {
  std::sort(all.begin(), all.end());
  return all.at(all.size() / 2);
}

/// Watches the syncs of a file.
class Watched {
 public:
  explicit Watched(const std::string& path) {
    const std::lock_guard<std::mutex> lock(g_synced.mutex);
    g_synced.path = path;
    g_synced.content.clear();
    g_synced.times_us.clear();
  }
  ~Watched() {
    const std::lock_guard<std::mutex> lock(g_synced.mutex);
    g_synced.path.clear();
  }
  Bytes Content() const {
    const std::lock_guard<std::mutex> lock(g_synced.mutex);
    return g_synced.content;
  }
  std::int64_t MedianTimeUs() const {
    const std::lock_guard<std::mutex> lock(g_synced.mutex);
    return Median(g_synced.times_us);
  }
};

/// The server's messages of a cluster, in a log that a thread syncs.
class KeptLog : public Recorder {
 public:
  explicit KeptLog(const std::string& path) : log(path, false, &disk) {}
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
    if (PublisherOfChannel(channel) == 0) log.Publish(channel, utime, message);
  }
  void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override {
    if (seal.peer == 0) log.EndTick(channel, seal, kept);
  }
  DiskThread disk;
  RoomLog log;
};

/// A moment at which the power goes.
struct Loss {
  std::int64_t tick = 0, at_us = 0;
  Bytes synced, written;  ///< the log
};

/// Returns what a disk may have: of each sector that was written since the last sync the old bytes,
/// the new ones, or, beyond the old end, zeros.
Bytes Torn(const Loss& loss, Random* random) {
  constexpr std::size_t kSector = 512;
  Bytes disk = loss.written;
  for (std::size_t at = 0; at < disk.size(); at += kSector) {
    if (random->Next() % 2 == 0) continue;
    for (std::size_t i = at; i < std::min(at + kSector, disk.size()); ++i) {
      disk[i] = i < loss.synced.size() ? loss.synced[i] : std::uint8_t{0};
    }
  }
  return disk;
}

/// A room that is played in real time, with a snapshot at tick 60.
class PowerLoss : public ::testing::Test {
 protected:
  /// Plays until the power has gone so many times, each after the snapshot is on the disk.
  void Play(const std::string& scene_text, std::size_t losses) {
    const std::string path = StateLogOf(folder_.path(), "main");
    KeptLog kept(path);
    const Watched watched(path);
    ClusterConfig config;
    config.scene_text = scene_text;
    config.keep = false;
    config.recorder = &kept;
    Cluster cluster(config);
    std::int64_t next_us = 0, tick = cluster.server().tick();
    cluster.each_instant = [&] {
      if (cluster.server().tick() == tick) return;
      tick = cluster.server().tick();
      written_us_[tick] = SteadyClockUs();
      hashes_[tick] = cluster.server().replica().world().Hash();
      next_us = std::max(next_us, written_us_[tick]) + kTickUs;
      const std::int64_t left_us = next_us - SteadyClockUs();
      if (left_us > 0) usleep(static_cast<useconds_t>(left_us));
      if (tick == 60) {
        place_ = kept.log.Pin();
        room_ = cluster.server().Save(cluster.now_us());
        hashes_[tick] = cluster.server().replica().world().Hash();
      }
      const Bytes synced = watched.Content();
      if (tick > 70 && tick % 7 == 0 && synced.size() > static_cast<std::size_t>(place_.bytes)) {
        losses_.push_back({tick, SteadyClockUs(), synced, ReadOf(path)});
      }
    };
    while (losses_.size() < losses && tick < 6000) cluster.RunToTick(tick + 1);
    sync_us_ = watched.MedianTimeUs();
  }

  /// Returns the tail of the log that the disk has.
  LogTail ReadDisk(const Bytes& disk) {
    const std::string path = folder_ / "disk.lcm";
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(disk.data()), static_cast<long>(disk.size()));
    LogTail tail;
    const Status status = ReadLogTail(path, "main", place_, 60, nullptr, &tail);
    EXPECT_TRUE(status.ok()) << status.why();
    return tail;
  }

  Workspace folder_;
  LogPlace place_;
  Bytes room_;
  std::map<std::int64_t, std::int64_t> written_us_;
  std::map<std::int64_t, std::uint64_t> hashes_;
  std::vector<Loss> losses_;
  std::int64_t sync_us_ = 0;  // that the disk takes for a sync, in the median
};

std::int64_t LastTick(const LogTail& tail) {
  return tail.ticks.empty() ? 60 : tail.ticks.back().tick;
}

TEST_F(PowerLoss, SyncedTicksAreThereWhateverBecameOfTheRest) {
  Play(kArena, 24);
  ASSERT_EQ(losses_.size(), 24u);
  Random random(3);
  std::vector<std::int64_t> lost_us;
  for (const Loss& loss : losses_) {
    const std::int64_t synced = LastTick(ReadDisk(loss.synced));
    // The sync may have met a write, and the last seal may be open, and is written over then.
    Bytes promised = loss.synced;
    promised.pop_back();
    const std::int64_t kept = LastTick(ReadDisk(promised));
    lost_us.push_back(loss.at_us - written_us_[synced]);
    for (int i = 0; i < 20; ++i) {
      EXPECT_GE(LastTick(ReadDisk(Torn(loss, &random))), kept) << loss.tick << " " << i;
    }
  }
  const std::int64_t median_us = Median(lost_us);
  std::printf("lost: %.1f ms in the median; a sync takes %.1f ms\n",
              static_cast<double>(median_us) * 1e-3, static_cast<double>(sync_us_) * 1e-3);
  // A tick is on the disk when the sync after the one under way has ended.
  EXPECT_LE(median_us, 60000 + 2 * sync_us_);
}

TEST_F(PowerLoss, TheRoomGoesOnAfterTheLastTickOfTheDisk) {
  Play(kArena, 11);
  ASSERT_FALSE(losses_.empty());
  Random random(4);
  for (const std::size_t n : {std::size_t{0}, losses_.size() / 2, losses_.size() - 1}) {
    const LogTail tail = ReadDisk(Torn(losses_[n], &random));
    Status status;
    const std::unique_ptr<const SavedRoom> saved = SavedRoom::Read(room_, &status);
    ASSERT_TRUE(saved != nullptr) << status.why();
    ServerConfig config;
    config.sync = MakeSyncConfig({"buffer", "", ""});
    config.sync.tick_hz = saved->room().tick_hz;
    config.sync.send_hz = saved->room().send_hz;
    config.sync.input_delay_ticks = saved->room().input_delay_ticks;
    config.seed = config.sync.seed = saved->room().seed;
    MemoryRecorder nothing;
    SeededEntropy entropy(5);
    MemoryNetwork network;
    const std::unique_ptr<Net> net = network.Attach({1, 7777});
    Server server(*saved, config, *net, nothing, entropy);
    status = server.Resume(*saved, 1000000, &tail);
    ASSERT_TRUE(status.ok()) << status.why();
    EXPECT_EQ(server.tick(), LastTick(tail));
    EXPECT_EQ(server.replica().world().Hash(), hashes_[server.tick()]);
  }
}

TEST_F(PowerLoss, ASnapshotIsNeverAheadOfItsLog) {
  const std::string path = StateLogOf(folder_.path(), "main");
  const Watched watched(path);
  Sink sink("none", path, false, "main");
  LoneRoom room(Arena());
  RoomKeeper keeper(folder_.path(), "main", sink);
  for (int i = 0; i < 5; ++i) {
    room.Step();
    Event event;
    event.session = 5;
    sink.Publish("SEAM.main.event.0", room.now_us, Encode(event));
    LogSeal seal;
    seal.session = 5;
    seal.tick = room.server->tick();
    sink.EndTick("SEAM.main.chain.0", seal, false);
    keeper.Finish(*room.server, room.now_us);
    RoomSnapshot snapshot;
    const std::vector<SnapshotName> files = ListSnapshots(folder_.path(), "main");
    ASSERT_FALSE(files.empty());
    ASSERT_TRUE(ReadSnapshot(files.front().path, &snapshot).ok());
    EXPECT_GE(static_cast<std::int64_t>(watched.Content().size()), snapshot.log.bytes);
    EXPECT_GT(snapshot.log.bytes, 0);
  }
}

}  // namespace power_loss_test
}  // namespace seam
