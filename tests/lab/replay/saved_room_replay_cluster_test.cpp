/// A room that is saved while its log is written: the log is done again with the same bits, also
/// where saving makes a barrier that the mode has not.

#include <gtest/gtest.h>

#include "client/embed/cluster.h"
#include "server/room_state.h"
#include "server/saved/log_tail.h"
#include "server/saved/trial_load.h"
#include "tests/lab/replay/replayed_room.h"
#include "tests/support/program.h"
#include "tests/support/soak/server_log.h"

namespace seam {
namespace saved_room_replay_test {

struct Case {
  const char *mode, *reconcile;
};

class SavedRoomReplay : public ::testing::TestWithParam<Case> {
 protected:
  ClusterConfig Config(Recorder* log) const {
    ClusterConfig config;
    config.scene = "crossing";
    config.impair = "demo";
    config.drive = Drive::kBot;
    config.mode = GetParam().mode;
    config.reconcile = GetParam().reconcile;
    config.keep = false;
    config.recorder = log;
    return config;
  }
  /// Returns the tick that comes out otherwise, or -1.
  static std::int64_t FirstUnlike(const std::string& path) {
    const LoggedRoom logged = ReadLoggedRoom(path, "");
    EXPECT_GT(logged.ticks.size(), 200U);
    ReplayedRoom room(logged);
    while (!room.done()) {
      if (room.Step() != ReplayedRoom::Tick::kSame) return room.server().tick();
    }
    return -1;
  }
  Workspace folder_;
};

TEST_P(SavedRoomReplay, SnapshotsAreInTheLog) {
  const std::string path = folder_ / "main.lcm";
  {
    ServerLog log(path);
    Cluster cluster(Config(&log.log));
    for (const std::int64_t tick : {2, 101, 200}) {
      cluster.RunToTick(tick);
      (void)RoomState::Finish(cluster.server().CopyState(cluster.now_us(), 0));
    }
    cluster.RunToTick(260);
  }
  EXPECT_EQ(FirstUnlike(path), -1);
}

/// The modes whose rooms go on with the same bits after a restart.
class StoppedRoomReplay : public SavedRoomReplay {};

TEST_P(StoppedRoomReplay, AStopAtAnyTickIsInTheLogOfTheNextServer) {
  for (const std::int64_t stop : {101, 102}) {
    const std::string path = folder_ / ("stop" + std::to_string(stop) + ".lcm");
    {
      ServerLog log(path);
      Cluster cluster(Config(&log.log));
      cluster.RunToTick(stop);
      const LogPlace place = log.log.Pin();
      const Bytes bytes = RoomState::Finish(cluster.server().CopyState(cluster.now_us(), 0));
      Status status;
      const auto saved = SavedRoom::Read(bytes, &status);
      ASSERT_TRUE(saved != nullptr) << status.why();
      LogTail tail;
      tail.end = place;
      cluster.RestartServer(*saved, tail, 100000);
      cluster.RunToTick(260);
    }
    EXPECT_EQ(FirstUnlike(path), -1) << "stopped at " << stop;
  }
}

INSTANTIATE_TEST_SUITE_P(Cluster, SavedRoomReplay,
                         ::testing::Values(Case{"strict", ""}, Case{"touch", ""},
                                           Case{"buffer", "fade"}, Case{"buffer", "rollback"},
                                           Case{"central", ""}));
INSTANTIATE_TEST_SUITE_P(Cluster, StoppedRoomReplay,
                         ::testing::Values(Case{"buffer", "fade"}, Case{"buffer", "rollback"},
                                           Case{"central", ""}));

}  // namespace saved_room_replay_test
}  // namespace seam
