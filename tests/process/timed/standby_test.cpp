/// Standbys of a fleet as programs: their holder is killed, paused, or cut off from one client.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>

#include "common/base/process.h"
#include "common/net/http_page.h"
#include "server/fleet/take_over_rule.h"
#include "tests/process/timed/fleet_programs.h"
#include "tests/support/soak.h"

namespace seam {
namespace fleet_test {

class Standby : public FleetPrograms {
 protected:
  /// Begins the room at "a", two players in it, and "b" with these flags as its standby.
  void Begin(const std::vector<std::string>& more) {
    a_ = Server("a", {"crossing", "--wait", "0", "--state", State()});
    ASSERT_TRUE(a_->WaitForErrors("Ctrl-C ends it", kPatience)) << a_->Story();
    for (const char* name : {"ann", "bob"}) {
      clients_.push_back(Client(name, {"--directory", directory_}));
    }
    ASSERT_TRUE(WaitFor(kPatience, [&] { return BothCame(*a_, 1); })) << a_->Story();
    b_ = Next("b", more);
    ASSERT_TRUE(WaitFor(kPatience, [&] { return StandbyOf() == "b"; })) << b_->Story();
    usleep(1000000);  // clients look for it each 0.25 s
  }
  std::unique_ptr<Program> Next(const std::string& id, const std::vector<std::string>& more) {
    std::vector<std::string> flags = {"--resume", State()};
    flags.insert(flags.end(), more.begin(), more.end());
    return Server(id, flags);
  }

  std::unique_ptr<Program> a_, b_;
  std::vector<std::unique_ptr<Program>> clients_;
};

/// Stops a server while it does not hold the directory's lock: with it, nobody could take its room.
void StopWithoutLock(const std::string& directory, Program& server) {
  const std::string lock = directory.substr(std::string("file:").size()) + "/directory.lock";
  const int fd = open(lock.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(fd, 0) << lock;
  ASSERT_EQ(flock(fd, LOCK_EX), 0);
  server.Signal(SIGSTOP);
  usleep(10000);
  close(fd);
}

void PrintTimes(const char* what, std::vector<double>* all_s) {
  std::sort(all_s->begin(), all_s->end());
  std::printf("%s: %zu kills: both players are in again %.2f s (median), %.2f s (most) after\n",
              what, all_s->size(), (*all_s)[(all_s->size() - 1) / 2], all_s->back());
}

/// Kills the holder again and again; the one that was killed comes back as the next standby.
TEST_F(Standby, TakesTheRoomOfAKilledServerLongBeforeItsLeaseEnds) {
  SEAM_INSIDE_ONLY();
  const int rounds = Soak(2);
  for (const bool warm : {true, false}) {
    const std::vector<std::string> more =
        warm ? std::vector<std::string>{"--standby"} : std::vector<std::string>{};
    clients_.clear();
    a_.reset();
    b_.reset();
    directory_ = "file:" + (folder_ / (warm ? "d1" : "d2"));
    rooms_ = warm ? "warm" : "cold";
    ASSERT_NO_FATAL_FAILURE(Begin(more));
    std::vector<double> back_s;
    for (int round = 0; round < rounds; ++round) {
      usleep(static_cast<useconds_t>(2500000 + 170000 * (round % 7)));
      const std::int64_t kill_us = SteadyClockUs();
      a_->Signal(SIGKILL);
      EXPECT_TRUE(WaitFor(kPatience, [&] { return BothCame(*b_, 1); })) << b_->Story();
      back_s.push_back(static_cast<double>(SteadyClockUs() - kill_us) * 1e-6);
      ASSERT_TRUE(a_->Wait(kPatience));
      EXPECT_EQ(Held(), round + 2);
      EXPECT_NE(b_->errors().find(" of 2 player(s) ask for it here"), std::string::npos)
          << "the lease's end is not what was waited for: " << b_->Story();
      if (round + 1 == rounds) break;
      a_ = std::move(b_);
      const std::string id = round % 2 == 0 ? "a" : "b";
      usleep(kFleetLeaseS * 1000000);  // the dead one's entry goes with its lease
      b_ = Next(id, more);
      ASSERT_TRUE(WaitFor(kPatience, [&] { return StandbyOf() == id; })) << b_->Story();
    }
    for (const auto& client : clients_) EXPECT_EQ(client->status(), -1) << client->Story();
    PrintTimes(warm ? "with --standby" : "from saved state", &back_s);
    EXPECT_LT(back_s[(back_s.size() - 1) / 2], warm ? 2.0 : 3.0);
  }
}

TEST_F(Standby, AHolderThatWasOnlyPausedStopsAndItsPlayersStayWhereTheyAre) {
  SEAM_INSIDE_ONLY();
  ASSERT_NO_FATAL_FAILURE(Begin({"--standby"}));
  ASSERT_NO_FATAL_FAILURE(StopWithoutLock(directory_, *a_));
  EXPECT_TRUE(WaitFor(kPatience, [&] { return BothCame(*b_, 1); })) << b_->Story();
  usleep(1000000);
  a_->Signal(SIGCONT);
  ASSERT_TRUE(WaitFor(kPatience, [&] {
    return a_->errors().find("another server has its epoch 2") != std::string::npos;
  })) << a_->Story();
  usleep(2000000);
  EXPECT_EQ(Held(), 2);
  EXPECT_EQ(Came(*b_, "ann"), 1) << b_->Story();
  EXPECT_EQ(Came(*a_, "ann"), 1) << a_->Story();
  for (const auto& client : clients_) EXPECT_EQ(client->status(), -1) << client->Story();
}

TEST_F(Standby, AShortPauseChangesNothing) {
  SEAM_INSIDE_ONLY();
  ASSERT_NO_FATAL_FAILURE(Begin({"--standby"}));
  for (int pause = 0; pause < 3; ++pause) {
    const std::int64_t begin_us = SteadyClockUs();
    a_->Signal(SIGSTOP);
    usleep(TakeOverRule::kHolderSilentUs / 2);
    a_->Signal(SIGCONT);
    if (SteadyClockUs() - begin_us > TakeOverRule::kHolderSilentUs * 3 / 4) {
      GTEST_SKIP() << "the machine has paused for longer";
    }
    usleep(1500000);
  }
  EXPECT_EQ(Held(), 1) << b_->Story();
  EXPECT_EQ(Came(*a_, "ann"), 1) << a_->Story();
}

TEST_F(Standby, TellsOnItsMetricsPageWhichRoomsItFollowsAndHowFarBehind) {
  SEAM_INSIDE_ONLY();
  ASSERT_NO_FATAL_FAILURE(Begin({"--standby", "--metrics", "9464"}));
  std::string page;
  EXPECT_TRUE(WaitFor(10,
                      [&] {
                        page.clear();
                        const bool read = FetchPage("127.0.0.1:9464", 2000000, &page).ok();
                        return read && page.find("seam_standby_behind_ticks{room=\"main\"} 0") !=
                                           std::string::npos;
                      }))
      << page << b_->Story();
  EXPECT_EQ(b_->errors().find("is not followed"), std::string::npos) << b_->Story();
}

TEST_F(Standby, TheFlagWithoutADirectoryOrAFolderIsOneLine) {
  SEAM_INSIDE_ONLY();
  Program alone({BuiltProgram("seam-server"), "--resume", State(), "--standby"});
  ASSERT_TRUE(alone.Wait(kPatience));
  EXPECT_EQ(alone.status(), 2);
  EXPECT_NE(alone.errors().find("--standby follows the rooms of a fleet"), std::string::npos)
      << alone.Story();
}

}  // namespace fleet_test
}  // namespace seam
