/// Servers of a fleet as programs: killed, drained, and without their directory.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "common/base/process.h"
#include "common/net/http_page.h"
#include "common/record/log_file.h"
#include "server/saved/resumed_room.h"
#include "tests/fleet/etcd_here.h"
#include "tests/process/timed/fleet_programs.h"
#include "tests/support/soak.h"

namespace seam {
namespace fleet_test {

class Fleet : public FleetPrograms {
 protected:
  /// Returns the times of the first and last events of a log, us.
  static std::pair<std::int64_t, std::int64_t> TimesOf(const std::string& log) {
    LogReader reader(log);
    LogEvent event;
    std::pair<std::int64_t, std::int64_t> times{0, 0};
    while (reader.Next(&event)) {
      if (times.first == 0) times.first = event.timestamp_us;
      times.second = event.timestamp_us;
    }
    return times;
  }
};

TEST_F(Fleet, AnotherServerTakesOverTheRoomOfAKilledOneWithItsPlayers) {
  SEAM_INSIDE_ONLY();
  const int rounds = Soak(2);
  std::unique_ptr<Program> holder = Server("a", {"crossing", "--wait", "0", "--state", State()});
  ASSERT_TRUE(holder->WaitForErrors("Ctrl-C ends it", kPatience)) << holder->Story();
  std::vector<std::unique_ptr<Program>> clients;
  for (const char* name : {"ann", "bob"}) {
    clients.push_back(Client(name, {"--directory", directory_}));
  }
  ASSERT_TRUE(WaitFor(kPatience, [&] { return BothCame(*holder, 1); })) << holder->Story();
  std::vector<double> since_kill_s, since_end_s;
  for (int round = 0; round < rounds; ++round) {
    std::unique_ptr<Program> other = Server(round % 2 == 0 ? "b" : "a", {"--resume", State()});
    ASSERT_TRUE(other->WaitForErrors("member of fleet", kPatience)) << other->Story();
    usleep(static_cast<useconds_t>(3000000 + 170000 * (round % 7)));
    EXPECT_EQ(other->errors().find("taken over"), std::string::npos) << "its holder is there";
    holder->Signal(SIGKILL);
    ASSERT_TRUE(holder->Wait(kPatience));
    const std::int64_t kill_us = SteadyClockUs();
    const std::int32_t epoch = round + 1;
    ASSERT_TRUE(WaitFor(kPatience, [&] { return Held() != epoch; }));
    const std::int64_t end_us = SteadyClockUs();
    ASSERT_TRUE(WaitFor(kPatience, [&] { return BothCame(*other, 1); })) << other->Story();
    const std::int64_t back_us = SteadyClockUs();
    since_kill_s.push_back(static_cast<double>(back_us - kill_us) * 1e-6);
    since_end_s.push_back(static_cast<double>(back_us - end_us) * 1e-6);
    EXPECT_EQ(Held(), epoch + 1);
    holder = std::move(other);
  }
  for (const auto& client : clients) EXPECT_EQ(client->status(), -1) << client->Story();
  std::sort(since_kill_s.begin(), since_kill_s.end());
  std::sort(since_end_s.begin(), since_end_s.end());
  std::printf(
      "%d kills: both players are in again %.2f s (median), %.2f s (most) after the lease "
      "has ended, %.2f s and %.2f s after the kill\n",
      rounds, since_end_s[since_end_s.size() / 2], since_end_s.back(),
      since_kill_s[since_kill_s.size() / 2], since_kill_s.back());
  EXPECT_LT(since_end_s.back(), 3);
}

TEST_F(Fleet, AServerThatIsDrainedSendsItsPlayersToAnother) {
  SEAM_INSIDE_ONLY();
  const auto a =
      Server("a", {"crossing", "--wait", "0", "--state", State(), "--drain-to", "fleet"});
  ASSERT_TRUE(a->WaitForErrors("Ctrl-C ends it", kPatience)) << a->Story();
  const auto b = Server("b", {"--resume", State()});
  // One follows the redirect alone, and the gateway sends the other to its room.
  const auto gateway = Server("c", {"--gateway"});
  ASSERT_TRUE(gateway->WaitForErrors("gateway of fleet", kPatience)) << gateway->Story();
  const auto ann = Client("ann", {"127.0.0.1:7800"});
  const auto bob = Client("bob", {"127.0.0.1:7802", "--room", "main"});
  ASSERT_TRUE(WaitFor(kPatience, [&] { return BothCame(*a, 1); })) << a->Story() << bob->Story();
  const std::int64_t begin_us = SteadyClockUs();
  a->Signal(SIGTERM);
  EXPECT_TRUE(WaitFor(kPatience, [&] { return BothCame(*b, 1); })) << b->Story() << ann->Story();
  std::printf("both play at the other server %.2f s after SIGTERM\n",
              static_cast<double>(SteadyClockUs() - begin_us) * 1e-6);
  ASSERT_TRUE(a->Wait(kPatience));
  EXPECT_EQ(a->status(), 0) << a->Story();
  EXPECT_EQ(ann->status(), -1) << ann->Story();
  EXPECT_EQ(bob->status(), -1) << bob->Story();
}

TEST_F(Fleet, TheRoomsOfADrainedServerTickOnUntilTheNextServerHasEach) {
  SEAM_INSIDE_ONLY();
  constexpr int kRooms = 8;
  const auto a = Server("a", {"crossing", "--rooms", std::to_string(kRooms), "--wait", "0",
                              "--state", State(), "--drain-to", "fleet"});
  ASSERT_TRUE(a->WaitForErrors("Ctrl-C ends it", kPatience)) << a->Story();
  const auto b = Server("b", {"--resume", State(), "--standby"});
  const auto name = [](int r) { return "main-" + std::to_string(r + 1); };
  std::vector<std::unique_ptr<Program>> clients;
  for (int r = 0; r < kRooms; ++r) {
    clients.push_back(Client("ann", {"--directory", directory_, "--room", name(r)}));
  }
  ASSERT_TRUE(WaitFor(kPatience, [&] { return Came(*a, "ann") == kRooms; })) << a->Story();
  ASSERT_TRUE(WaitFor(kPatience, [&] { return StandbyOf(name(kRooms - 1)) == "b"; }));
  usleep(2000000);  // they are followed
  const std::int64_t begin_us = SteadyClockUs();
  a->Signal(SIGTERM);
  EXPECT_TRUE(WaitFor(kPatience, [&] { return Came(*b, "ann") == kRooms; })) << b->Story();
  ASSERT_TRUE(a->Wait(kPatience));
  EXPECT_EQ(a->status(), 0) << a->Story();
  for (const auto& client : clients) EXPECT_EQ(client->status(), -1) << client->Story();
  std::int64_t stood_us = 0, longest_us = 0, end_us = begin_us;
  for (int r = 0; r < kRooms; ++r) {
    const std::int64_t last_us = TimesOf(StateLogOf(State(), name(r), 1)).second;
    const std::int64_t first_us = TimesOf(StateLogOf(State(), name(r), 2)).first;
    stood_us += first_us - last_us;
    longest_us = std::max(longest_us, first_us - last_us);
    end_us = std::max(end_us, first_us);
  }
  std::printf("%d rooms drained in %.2f s; a room stood still for %.3f s, at most %.3f s\n", kRooms,
              static_cast<double>(end_us - begin_us) * 1e-6,
              static_cast<double>(stood_us) * 1e-6 / kRooms,
              static_cast<double>(longest_us) * 1e-6);
  EXPECT_LT(stood_us, end_us - begin_us) << "one at a time";
}

TEST_F(Fleet, ARoomGoesOnWithoutItsDirectoryAndIsStillHeldWhenItIsBack) {
  SEAM_INSIDE_ONLY();
  if (!EtcdHere::Installed()) GTEST_SKIP() << "etcd is not installed: make build/.deps-fleet";
  EtcdHere etcd;
  ASSERT_TRUE(etcd.WaitUntilUp()) << etcd.Story();
  directory_ = etcd.Text();
  const auto a = Server("a", {"crossing", "--wait", "0", "--state", State(), "--metrics", "9464"});
  ASSERT_TRUE(a->WaitForErrors("Ctrl-C ends it", kPatience)) << a->Story();
  const auto b = Server("b", {"--resume", State()});
  const auto ann = Client("ann", {"--directory", directory_});
  ASSERT_TRUE(WaitFor(kPatience, [&] { return Came(*a, "ann") == 1; })) << a->Story();
  const auto up = [](const std::string& value) {
    std::string page;
    return FetchPage("127.0.0.1:9464", 2000000, &page).ok() &&
           page.find("seam_directory_up " + value) != std::string::npos;
  };
  EXPECT_TRUE(WaitFor(10, [&] { return up("1"); }));
  etcd.Stop();
  EXPECT_TRUE(WaitFor(20, [&] { return up("0"); }));
  usleep(7000000);  // longer than a lease
  EXPECT_EQ(ann->status(), -1) << ann->Story();
  EXPECT_EQ(Came(*a, "ann"), 1) << "it never left";
  etcd.Start();
  EXPECT_TRUE(WaitFor(30, [&] { return up("1"); })) << a->Story();
  usleep(2000000);
  EXPECT_EQ(Held(), 1) << "the same epoch";
  EXPECT_EQ(b->errors().find("taken over"), std::string::npos) << b->Story();
  EXPECT_EQ(Came(*a, "ann"), 1);
}

TEST_F(Fleet, FlagsThatDoNotGoTogetherAreOneLine) {
  SEAM_INSIDE_ONLY();
  const std::pair<std::vector<std::string>, const char*> wrong[] = {
      {{"crossing", "--drain-to", "10.0.0.1"}, "--drain-to: the other server goes on with"},
      {{"--gateway", "crossing"}, "--gateway has no rooms"},
      {{"--gateway", "--fleet", "a b"}, "--fleet takes"},
      {{"crossing", "--advertise", "[::]"}, "--advertise"}};
  for (const auto& [flags, text] : wrong) {
    const auto server = Server("a", flags);
    ASSERT_TRUE(server->Wait(kPatience)) << server->Story();
    EXPECT_EQ(server->status(), 2) << server->Story();
    EXPECT_NE(server->errors().find(text), std::string::npos) << server->Story();
  }
}

}  // namespace fleet_test
}  // namespace seam
