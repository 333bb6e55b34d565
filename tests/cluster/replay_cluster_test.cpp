/// Rooms that are done again from their logs alone.

#include <gtest/gtest.h>

#include "client/embed/cluster.h"
#include "common/base/check.h"
#include "common/record/log_file.h"
#include "common/record/room_log.h"
#include "tests/lab/replay/replayed_room.h"
#include "tests/support/arena.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace replay_cluster_test {

/// Records a session.
void Play(ClusterConfig config, const std::string& path) {
  RoomLog log(path, true, nullptr);
  config.keep = false;
  config.recorder = &log;
  Cluster(config).Run();
}

/// Returns the first tick that differs; -1: none does.
std::int64_t FirstOther(const std::string& path, std::size_t* ticks) {
  const LoggedRoom logged = ReadLoggedRoom(path, "");
  *ticks = logged.ticks.size();
  ReplayedRoom room(logged);
  while (!room.done()) {
    if (room.Step() != ReplayedRoom::Tick::kSame) return room.server().tick();
  }
  return -1;
}

TEST(ReplayCluster, EachTickHasTheRecordedHash) {
  for (const auto& [scene, mode] :
       {std::pair("crossing", "buffer"), std::pair("rally", "buffer"),
        std::pair("gluehouse", "buffer"), std::pair("seesaw", "central"),
        std::pair("playground", "central")}) {
    TemporaryFile file;
    ClusterConfig config;
    config.scene = scene;
    config.mode = mode;
    config.drive = Drive::kBot;
    config.duration_s = 6;
    Play(config, file.path());
    std::size_t ticks = 0;
    EXPECT_EQ(FirstOther(file.path(), &ticks), -1) << scene << " " << mode;
    EXPECT_EQ(ticks, 360u);
  }
}

TEST(ReplayCluster, TheServersWordsForSilentHoldersAreNotTakenForTheirs) {
  int seeds = 0;
  for (const char* scene : {"crossing", "derby", "wall"}) {
    for (const int seed : {11, 12, 13}) {
      TemporaryFile file;
      ClusterConfig config;
      config.scene = scene;
      config.mode = "buffer";
      config.drive = Drive::kBot;
      config.impair = "delay=200ms,jitter=100ms,loss=20%";
      config.seed = seed;
      config.duration_s = 2;
      Play(config, file.path());
      std::size_t ticks = 0;
      EXPECT_EQ(FirstOther(file.path(), &ticks), -1) << scene << " " << seed;
      seeds += ticks > 0;
    }
  }
  EXPECT_EQ(seeds, 9);
}

TEST(ReplayCluster, RulesScriptsAndEditsAreDoneAgain) {
  for (const char* mode : {"buffer", "central"}) {
    TemporaryFile file;
    ClusterConfig config;
    config.scene_text = kArena;
    config.mode = mode;
    config.duration_s = 6;
    Play(config, file.path());
    std::size_t ticks = 0;
    EXPECT_EQ(FirstOther(file.path(), &ticks), -1) << mode;
  }
}

TEST(ReplayCluster, AnotherInputIsFoundInItsTick) {
  TemporaryFile file;
  ClusterConfig config;
  config.mode = "central";  // the server drives the cars
  config.drive = Drive::kBot;
  config.duration_s = 4;
  Play(config, file.path());
  LoggedRoom logged = ReadLoggedRoom(file.path(), "");
  // In each message of the one who drives that repeats it.
  std::int64_t changed = -1, at = -1;
  for (TickMessages& tick : logged.ticks) {
    for (AnyMessage& message : tick.before) {
      auto* inputs = std::get_if<Inputs>(&message);
      if (inputs == nullptr || inputs->player != 0 || tick.tick < 100) continue;
      const auto count = static_cast<std::int64_t>(inputs->drive.size());
      if (changed < 0) {
        if (inputs->first_tick + count - 1 <= tick.tick + 1) continue;  // too late, or nearly
        changed = tick.tick;
        at = inputs->first_tick + count - 1;
      }
      const std::int64_t i = at - inputs->first_tick;
      if (i < 0 || i >= count) continue;
      std::int8_t& drive = inputs->drive[static_cast<std::size_t>(i)];
      drive = static_cast<std::int8_t>(drive > 0 ? -127 : 127);
    }
  }
  ASSERT_GT(changed, 0);
  ReplayedRoom room(logged);
  std::int64_t first = -1;
  while (!room.done() && first < 0) {
    if (room.Step() != ReplayedRoom::Tick::kSame) first = room.server().tick();
  }
  EXPECT_GE(first, changed);
  EXPECT_LE(first, changed + 15) << "inputs come some ticks early";
}

TEST(ReplayCluster, ALogWithoutItsBeginningIsRefused) {
  TemporaryFile file, late;
  ClusterConfig config;
  config.duration_s = 2;
  Play(config, file.path());
  LogReader reader(file.path());
  {
    RoomLog log(late.path(), true, nullptr);
    std::int64_t n = 0;
    for (LogEvent event; reader.Next(&event); ++n) {
      const AnyMessage any = Decode(event.data);
      const auto* seal = std::get_if<LogSeal>(&any);
      if (seal != nullptr && n > 300) {
        log.EndTick(event.channel, *seal, true);
      } else if (seal == nullptr && (n > 300 || std::holds_alternative<Room>(any))) {
        log.Publish(event.channel, event.timestamp_us, event.data);
      }
    }
  }
  EXPECT_THROW(ReadLoggedRoom(late.path(), ""), OperatorError);
}

TEST(ReplayCluster, ALogThatIsCutOffIsNotTakenForAnOldOne) {
  TemporaryFile file;
  ClusterConfig config;
  config.duration_s = 1;
  Play(config, file.path());
  const Bytes whole = file.Read();
  std::size_t seal = whole.size();  // the first that is kept
  LogReader reader(file.path());
  std::size_t at = 0;
  for (LogEvent event; reader.Next(&event) && seal == whole.size();) {
    if (std::holds_alternative<LogSeal>(Decode(event.data))) seal = at;
    at = static_cast<std::size_t>(reader.place_bytes());
  }
  ASSERT_LT(seal, whole.size());
  for (const std::size_t bytes : {seal, seal + 20, seal - 100}) {
    file.Write(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(bytes)));
    try {
      ReadLoggedRoom(file.path(), "");
      ADD_FAILURE() << "has no hash of a tick";
    } catch (const OperatorError& error) {
      const std::string why = error.what();
      EXPECT_NE(why.find("is cut off before the first hash of a tick"), std::string::npos) << why;
    }
  }
}

}  // namespace replay_cluster_test
}  // namespace seam
