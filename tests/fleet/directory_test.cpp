/// One set of rules for each directory of a fleet: a file, and etcd.

#include "common/fleet/directory.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <thread>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/codec/messages.h"
#include "common/fleet/directory_values.h"
#include "tests/fleet/each_directory.h"

namespace seam {
namespace directory_test {

INSTANTIATE_TEST_SUITE_P(Fleet, EachDirectory, ::testing::Values("file", "etcd"),
                         [](const auto& each) { return std::string(each.param); });

TEST_P(EachDirectory, ARoomHasOneHolderAndItsEpochGrowsWithEach) {
  const auto a = Open("a"), b = Open("b");
  EXPECT_EQ(Claimed(*a, "red"), 1);
  EXPECT_EQ(Claimed(*b, "red"), 0) << "held";
  EXPECT_EQ(TakenOver(*b, "red"), 0) << "its lease has not ended";
  const FleetListing listing = Listed(*b);
  ASSERT_NE(listing.FindRoom("red"), nullptr);
  ASSERT_TRUE(listing.FindRoom("red")->holder);
  EXPECT_EQ(listing.FindRoom("red")->holder->server, "a");
  EXPECT_EQ(listing.FindRoom("red")->holder->address, ServerOf("a").address);
  EXPECT_EQ(listing.FindRoom("red")->spec, kSpec);
  EXPECT_EQ(listing.servers.size(), 2u);
  EXPECT_EQ(listing.refused, "");
  ASSERT_TRUE(a->Leave().ok());
  EXPECT_FALSE(Listed(*b).FindRoom("red")->holder);
  EXPECT_EQ(TakenOver(*b, "red"), 2);
  EXPECT_EQ(TakenOver(*b, "blue"), 0) << "nobody has begun it";
  EXPECT_EQ(Claimed(*b, "blue", 5), 5) << "its saved state has epoch 4";
}

TEST_P(EachDirectory, ALeaseThatIsNotRenewedEndsWithWhatItHolds) {
  // The lease of "a" begins between these two times.
  const std::int64_t before_us = SteadyClockUs();
  const auto a = Open("a");
  const std::int64_t after_us = SteadyClockUs();
  const auto b = Open("b");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  std::int32_t epoch = 0;
  std::int64_t refused_us = after_us;  // when the last take-over that was in vain began
  while (epoch == 0 && SteadyClockUs() - after_us < 30000000) {
    bool kept = false;
    ASSERT_TRUE(b->Renew(&kept).ok());
    EXPECT_TRUE(kept) << "this one is renewed";
    const std::int64_t now_us = SteadyClockUs();
    epoch = TakenOver(*b, "red");
    if (epoch == 0) refused_us = now_us;
    usleep(50000);
  }
  const double least_s = static_cast<double>(refused_us - after_us) * 1e-6;
  const double most_s = static_cast<double>(SteadyClockUs() - before_us) * 1e-6;
  std::printf("%s: taken over %.2f to %.2f s after the last renewal\n", GetParam(), least_s,
              most_s);
  EXPECT_EQ(epoch, 2);
  EXPECT_GT(most_s, kFleetLeaseS - 1);
  EXPECT_LT(least_s, kFleetLeaseS + 4);
  bool kept = true;
  ASSERT_TRUE(a->Renew(&kept).ok());
  EXPECT_FALSE(kept);
  ASSERT_TRUE(a->Register(ServerOf("a")).ok());
  bool done = true;
  ASSERT_TRUE(a->TakeBack("red", 1, &done).ok());
  EXPECT_FALSE(done) << "another server has the room";
}

TEST_P(EachDirectory, AHolderThatWasAwayTakesBackARoomThatNobodyTook) {
  const auto a = Open("a");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  ASSERT_TRUE(a->Leave().ok());  // as if its lease had ended
  ASSERT_TRUE(a->Register(ServerOf("a")).ok());
  bool done = false;
  ASSERT_TRUE(a->TakeBack("red", 1, &done).ok());
  EXPECT_TRUE(done);
  EXPECT_EQ(Listed(*a).FindRoom("red")->holder->epoch, 1);
  ASSERT_TRUE(a->TakeBack("red", 1, &done).ok());
  EXPECT_TRUE(done) << "its own, now with the present lease";
  const auto b = Open("b");
  ASSERT_TRUE(b->TakeBack("red", 1, &done).ok());
  EXPECT_FALSE(done) << "another's";
}

TEST_P(EachDirectory, AServerThatComesBackHoldsItsRoomByItsNewLease) {
  const auto dead = Open("a");
  ASSERT_EQ(Claimed(*dead, "red"), 1);
  const auto back = Open("a");  // at the same address, after a kill -9
  bool done = false;
  ASSERT_TRUE(back->TakeBack("red", 1, &done).ok());
  EXPECT_TRUE(done);
  ASSERT_TRUE(dead->Leave().ok());  // the old lease ends
  ASSERT_NE(Listed(*back).FindRoom("red"), nullptr);
  EXPECT_TRUE(Listed(*back).FindRoom("red")->holder);
}

TEST_P(EachDirectory, OneIdIsNotTwoServers) {
  const auto a = Open("a");
  Directory other(OpenKeyStore(text_), "test");
  FleetServer elsewhere = ServerOf("a");
  elsewhere.address = "127.0.0.9:7999";
  EXPECT_FALSE(other.Register(elsewhere).ok());
  EXPECT_EQ(Listed(*a).FindServer("a")->address, ServerOf("a").address);
}

TEST_P(EachDirectory, ARoomThatTheDirectoryHasLostIsPutBackInItsEpoch) {
  const auto a = Open("a"), b = Open("b");
  bool done = false;
  ASSERT_TRUE(a->Restore("red", 3, kSpec, &done).ok());
  EXPECT_TRUE(done);
  EXPECT_EQ(Listed(*b).FindRoom("red")->epoch, 3);
  EXPECT_EQ(Listed(*b).FindRoom("red")->holder->server, "a");
  EXPECT_EQ(Claimed(*b, "red"), 0) << "held";
  ASSERT_TRUE(b->Restore("red", 3, kSpec, &done).ok());
  EXPECT_FALSE(done) << "it is there";
}

TEST_P(EachDirectory, AMoveGivesTheRoomWithTheNextEpochToAServerThatIsThere) {
  const auto a = Open("a"), b = Open("b"), c = Open("c");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  const FleetServer to_b = *Listed(*a).FindServer("b"), to_c = *Listed(*a).FindServer("c");
  std::int32_t next = -1;
  ASSERT_TRUE(b->Move("red", 1, to_c, &next).ok());
  EXPECT_EQ(next, 0) << "not b's to give";
  ASSERT_TRUE(a->Move("red", 1, to_b, &next).ok());
  EXPECT_EQ(next, 2);
  EXPECT_EQ(Listed(*c).FindRoom("red")->holder->server, "b");
  EXPECT_EQ(Listed(*c).FindRoom("red")->epoch, 2);
  ASSERT_TRUE(a->Move("red", 1, to_c, &next).ok());
  EXPECT_EQ(next, 0) << "a has it no more";
  ASSERT_TRUE(a->Leave().ok());
  EXPECT_TRUE(Listed(*c).FindRoom("red")->holder) << "it goes with b's lease, not with a's";
  ASSERT_TRUE(b->Leave().ok());
  EXPECT_FALSE(Listed(*c).FindRoom("red")->holder);
}

TEST_P(EachDirectory, StateAndReleaseAreOfTheHoldersEpoch) {
  const auto a = Open("a"), b = Open("b");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  bool done = false;
  ASSERT_TRUE(a->SaveState("red", 1, R"({"tick": 5})", &done).ok());
  EXPECT_TRUE(done);
  ASSERT_TRUE(a->Leave().ok());
  ASSERT_EQ(TakenOver(*b, "red"), 2);
  ASSERT_TRUE(a->SaveState("red", 1, R"({"tick": 9})", &done).ok());
  EXPECT_FALSE(done) << "a stale server writes nothing";
  EXPECT_EQ(Listed(*b).FindRoom("red")->state, R"({"tick": 5})");
  ASSERT_TRUE(b->Release("red", 1).ok());
  EXPECT_TRUE(Listed(*b).FindRoom("red")->holder) << "another epoch";
  ASSERT_TRUE(b->Release("red", 2).ok());
  EXPECT_EQ(Listed(*b).FindRoom("red")->spec, "");
  EXPECT_EQ(TakenOver(*b, "red"), 0) << "it has ended";
  EXPECT_EQ(Claimed(*b, "red"), 3) << "no epoch comes back";
}

TEST_P(EachDirectory, AWatcherSeesAChange) {
  const auto a = Open("a"), b = Open("b");
  Listed(*b);
  FleetListing listing;
  const std::int64_t begin_us = SteadyClockUs();
  ASSERT_TRUE(b->Watch(700, &listing).ok());
  EXPECT_GT(SteadyClockUs() - begin_us, 600000) << "nothing has changed";
  ASSERT_EQ(Claimed(*a, "red"), 1);
  ASSERT_TRUE(b->Watch(10000, &listing).ok());
  EXPECT_NE(listing.FindRoom("red"), nullptr);
}

TEST_P(EachDirectory, AnEpochIsNeverGivenTwiceToServersThatRace) {
  constexpr int kProcesses = 4, kThreads = 2, kRounds = 6;
  // Processes and threads claim the same rooms and give them up at once.
  const auto race = [&](int process, std::vector<std::int32_t>* got) {
    std::vector<std::thread> threads;
    std::vector<std::vector<std::int32_t>> each(kThreads);
    for (int t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        Directory directory(OpenKeyStore(text_), "test");
        const FleetServer me = ServerOf("s" + std::to_string(process) + std::to_string(t));
        // A disk that is slow lets a call wait too long, which is an error and no epoch, and a
        // lease end, as a server's may.
        const std::int64_t until_us = SteadyClockUs() + 120'000'000;
        for (int round = 0; round < kRounds && SteadyClockUs() < until_us;) {
          bool kept = false;
          if (!directory.RenewIfDue(&kept).ok()) continue;
          if (!kept && !directory.Register(me).ok()) continue;
          std::int32_t epoch = 0;
          (void)directory.Claim("red", kSpec, 1, &epoch);
          usleep(static_cast<useconds_t>(500 * (1 + process + kProcesses * t)));
          if (epoch == 0) continue;
          each[static_cast<std::size_t>(t)].push_back(epoch);
          while (!directory.GiveUp("red", epoch).ok() && SteadyClockUs() < until_us) continue;
          ++round;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& epochs : each) got->insert(got->end(), epochs.begin(), epochs.end());
  };
  std::vector<pid_t> children;
  std::vector<int> ends;
  for (int p = 0; p < kProcesses; ++p) {
    int ends_of[2];
    ASSERT_EQ(pipe(ends_of), 0);
    const pid_t child = fork();
    if (child == 0) {
      std::vector<std::int32_t> got;
      race(p, &got);
      for (const std::int32_t epoch : got) {
        if (write(ends_of[1], &epoch, sizeof epoch) != sizeof epoch) _exit(1);
      }
      _exit(::testing::Test::HasFailure() ? 1 : 0);
    }
    close(ends_of[1]);
    ends.push_back(ends_of[0]);
    children.push_back(child);
  }
  std::multiset<std::int32_t> all;
  for (const int end : ends) {
    std::int32_t epoch = 0;
    while (read(end, &epoch, sizeof epoch) == sizeof epoch) all.insert(epoch);
    close(end);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  ASSERT_EQ(all.size(), std::size_t{kProcesses * kThreads * kRounds});
  EXPECT_EQ(std::set<std::int32_t>(all.begin(), all.end()).size(), all.size());
  EXPECT_EQ(*all.begin(), 1);
  EXPECT_EQ(*all.rbegin(), kProcesses * kThreads * kRounds) << "and none is left out";
}

TEST_P(EachDirectory, ValuesThatAreWrongAreIgnoredAndNamedOnce) {
  const auto a = Open("a");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  const std::unique_ptr<KeyStore> store = OpenKeyStore(text_);
  const std::string huge(kFleetValueBytesMax + 1, 'x');
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"servers/b", "no JSON"},
      {"servers/b", R"({"address": 5})"},
      {"servers/b", R"({"address": "example.org:7777", "version": "1", "protocol": 15,
                       "capacity": 1, "used": 0, "draining": false})"},
      {"servers/b", R"({"address": "1.2.3.4:7777", "version": "1", "protocol": 1e99,
                       "capacity": 1, "used": 0, "draining": false})"},
      {"servers/b", R"({"address": "1.2.3.4:7777", "version": "1", "protocol": 15,
                       "capacity": 99999999999999999999, "used": 0, "draining": false})"},
      {"servers/b c", ServerText(ServerOf("b"))},
      {"servers/b", huge},
      {"rooms/blue/holder", R"({"server": "b", "address": "1.2.3.4:0", "epoch": 1})"},
      {"rooms/blue/holder", R"({"server": "b", "address": "1.2.3.4:7777", "epoch": 0})"},
      {"rooms/blue/holder", R"([1, 2, 3])"},
      {"rooms/blue/epoch", "-1"},
      {"rooms/blue/epoch", "4294967296"},
      {"rooms/blue/spec", std::string(5000, '[')},
      {"rooms/blue/other", "1"},
      {"rooms/../epoch", "1"},
      {"strange", "1"}};
  for (const auto& [key, value] : wrong) {
    bool done = false;
    ASSERT_TRUE(store->Commit({}, {{"/seam/test/" + key, value, 0}}, &done).ok()) << key;
    const FleetListing listing = Listed(*a);
    EXPECT_NE(listing.refused, "") << key << " " << value.substr(0, 80);
    EXPECT_LT(listing.refused.size(), 200u);
    EXPECT_EQ(listing.servers.size(), 1u) << value.substr(0, 80);
    EXPECT_EQ(listing.rooms.size(), 1u) << value.substr(0, 80);
    ASSERT_TRUE(store->Commit({}, {{"/seam/test/" + key, std::nullopt, 0}}, &done).ok());
  }
  EXPECT_EQ(Listed(*a).refused, "");
}

TEST(DirectoryEtcd, OneThatIsNotThereIsOneErrorInTime) {
  Directory directory(OpenKeyStore("etcd:127.0.0.1:1,127.0.0.1:2"), "test");
  const std::int64_t begin_us = SteadyClockUs();
  FleetListing listing;
  EXPECT_FALSE(directory.List(&listing).ok());
  EXPECT_LT(SteadyClockUs() - begin_us, 5000000);
  for (const char* text : {"", "etcd", "etcd:", "file:", "zoo:keeper", "etcd:a,,b"}) {
    EXPECT_THROW(OpenKeyStore(text), OperatorError) << text;
  }
}

TEST_P(EachDirectory, ManyRoomsAreClaimedWithinSecondsAndNoneOfThoseThatOthersHave) {
  const auto a = Open("a"), b = Open("b");
  std::vector<std::string> names;
  const int count = GetParam() == std::string("file") ? 10000 : 2000;
  for (int i = 0; i < count; ++i) names.push_back("room-" + std::to_string(i));
  std::vector<std::int32_t> epochs;
  const std::int64_t begin_us = SteadyClockUs();
  Status status = a->ClaimAll(names, kSpec, kSpec, 1, &epochs);
  ASSERT_TRUE(status.ok()) << status.why();
  const double took_s = static_cast<double>(SteadyClockUs() - begin_us) * 1e-6;
  EXPECT_EQ(std::count(epochs.begin(), epochs.end(), 1), count);
  EXPECT_LT(took_s, 20);
  std::printf("%d rooms claimed in %.2f s\n", count, took_s);
  bool kept = false;
  EXPECT_TRUE(a->Renew(&kept).ok() && kept) << "else they are nobody's before they are listed";
  const FleetListing listing = Listed(*b);
  ASSERT_EQ(listing.rooms.size(), names.size());
  for (const FleetRoom& room : listing.rooms) {
    ASSERT_TRUE(room.holder && room.holder->server == "a") << room.name;
    ASSERT_EQ(room.state, kSpec);
  }
  status = b->ClaimAll({"new", names.back()}, kSpec, "", 1, &epochs);
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(epochs, (std::vector<std::int32_t>{0, 0}));
  EXPECT_EQ(Listed(*b).FindRoom("new"), nullptr);
}

}  // namespace directory_test
}  // namespace seam
