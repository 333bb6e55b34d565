/// A server as a member of a fleet, with a directory in a file.

#include "server/fleet/member.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/base/check.h"
#include "common/base/version.h"
#include "tests/support/program.h"

namespace seam {
namespace member_test {

FleetServer ServerOf(const std::string& id) {
  FleetServer server;
  server.id = id;
  server.address = "127.0.0.1:" + std::to_string(7000 + id.back());
  server.version = kVersion;
  server.protocol = kProtocolVersion;
  server.capacity = 8;
  return server;
}

/// The room "red" lost its server, which was "dead"; its state is in the folder.
class Member : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.Write("red-000000000060.snapshot", "");
    Directory dead(OpenKeyStore(text_), "main");
    ASSERT_TRUE(dead.Register(ServerOf("dead")).ok());
    std::int32_t epoch = 0;
    bool saved = false;
    ASSERT_TRUE(dead.Claim("red", kSpec, 1, &epoch).ok());
    ASSERT_TRUE(dead.SaveState("red", epoch, kSpec, &saved).ok());
    ASSERT_TRUE(dead.Leave().ok());
  }
  FleetMember::Config ConfigOf(const std::string& id) const {
    FleetMember::Config config;
    config.directory = text_;
    config.fleet = "main";
    config.me = ServerOf(id);
    config.folder = folder_.path();
    config.takes = true;
    return config;
  }
  FleetMember::Prepare Plans() {
    return [this](const std::string& room, std::int32_t epoch, std::unique_ptr<FollowedRoom>) {
      ++plans_;
      RoomPlan plan;
      plan.config.room = room;
      plan.config.epoch = epoch;
      return plan;
    };
  }
  FleetRoom Red() const {
    Directory directory(OpenKeyStore(text_), "main");
    FleetListing listing;
    EXPECT_TRUE(directory.List(&listing).ok());
    return *listing.FindRoom("red");
  }
  template <class Condition>
  static bool WaitFor(const Condition& condition) {
    for (int i = 0; i < 2000; ++i, usleep(10000)) {
      if (condition()) return true;
    }
    return false;
  }

  const std::string kSpec = R"({"folder": "/rooms"})";
  Workspace folder_;
  const std::string text_ = "file:" + folder_.path();
  std::atomic<int> plans_{0};
};

TEST_F(Member, ARoomThatCannotBeOpenedIsGivenBackOnceAndAnotherServerMayTry) {
  FleetMember member(ConfigOf("a"), Plans());
  member.Start();
  std::vector<RoomPlan> ready;
  ASSERT_TRUE(WaitFor([&] { return ready = member.TakeReady(), !ready.empty(); }));
  EXPECT_EQ(ready.front().config.epoch, 2);
  ASSERT_TRUE(Red().holder);
  member.GiveBack("red", 2, "this is no saved room");
  ASSERT_TRUE(WaitFor([&] { return !Red().holder; }));
  EXPECT_EQ(Red().state, kSpec) << "it stays";
  usleep(1500000);
  EXPECT_FALSE(Red().holder) << "not taken again at once";
  EXPECT_EQ(plans_, 1);
  EXPECT_EQ(member.TakeReports(),
            std::vector<std::string>{
                "room red cannot go on here, its state stays: this is no saved room"});
  FleetMember other(ConfigOf("b"), Plans());
  other.Start();
  ASSERT_TRUE(WaitFor([&] { return ready = other.TakeReady(), !ready.empty(); }));
  EXPECT_EQ(Red().holder->server, "b");
  EXPECT_EQ(Red().epoch, 3);
}

TEST_F(Member, ARoomWithoutAPlanIsGivenBackLikewise) {
  FleetMember member(
      ConfigOf("a"),
      [this](const std::string&, std::int32_t, std::unique_ptr<FollowedRoom>) -> RoomPlan {
        ++plans_;
        throw OperatorError("no such scene");
      });
  member.Start();
  ASSERT_TRUE(WaitFor([&] { return plans_ > 0 && !Red().holder; }));
  usleep(1000000);
  EXPECT_EQ(plans_, 1);
  EXPECT_EQ(Red().epoch, 2);
  EXPECT_EQ(member.TakeReports(),
            std::vector<std::string>{"room red cannot go on here, its state stays: no such scene"});
}

TEST_F(Member, ARoomThatAnotherServerHasTakenIsMovedToThatServer) {
  FleetMember::Config config = ConfigOf("a");
  config.takes = false;
  FleetMember member(config, Plans());
  ASSERT_EQ(member.Claim("blue", 1), 1);
  Directory other(OpenKeyStore(text_), "main");
  ASSERT_TRUE(other.Register(ServerOf("b")).ok());
  FleetListing listing;
  ASSERT_TRUE(other.List(&listing).ok());
  bool done = false;
  ASSERT_TRUE(other.StandBy(*listing.FindRoom("blue"), &done).ok());
  std::int32_t epoch = 0;
  ASSERT_TRUE(other.TakeFrom(*listing.FindRoom("blue"), &epoch).ok());
  ASSERT_EQ(epoch, 2);
  const Redirect to = member.Move("blue", "", 2);
  EXPECT_EQ(to.address, ServerOf("b").address);
  EXPECT_EQ(to.room, "blue");
  EXPECT_EQ(to.epoch, 2);
  EXPECT_EQ(member.Move("green", "", 2).address, "") << "nobody has it";
}

TEST_F(Member, ADrainLeavesTheRoomsToOthersAsLongAsThereAreAny) {
  FleetMember::Config config = ConfigOf("a");
  config.takes = false;
  FleetMember member(config, Plans());
  ASSERT_EQ(member.Claim("blue", 1), 1);
  Directory other(OpenKeyStore(text_), "main"), third(OpenKeyStore(text_), "main");
  ASSERT_TRUE(other.Register(ServerOf("b")).ok());
  ASSERT_TRUE(third.Register(ServerOf("c")).ok());
  FleetListing listing;
  bool done = false;
  ASSERT_TRUE(third.List(&listing).ok());
  ASSERT_TRUE(third.StandBy(*listing.FindRoom("blue"), &done).ok());
  member.Start();
  member.Drain(ServerOf("b").address);
  bool kept = false;
  const auto standby = [&] {
    EXPECT_TRUE(other.RenewIfDue(&kept).ok() && third.RenewIfDue(&kept).ok());
    EXPECT_TRUE(other.List(&listing).ok());
    const FleetRoom& blue = *listing.FindRoom("blue");
    return blue.standby ? blue.standby->server : "";
  };
  ASSERT_TRUE(WaitFor([&] { return standby() == "b"; })) << "it is drained to that one";
  EXPECT_TRUE(listing.FindServer("a")->draining);
  EXPECT_TRUE(member.drains());
  std::int32_t epoch = 0;
  ASSERT_TRUE(other.TakeFrom(*listing.FindRoom("blue"), &epoch).ok());
  ASSERT_EQ(epoch, 2);
  std::vector<Redirect> lost;
  ASSERT_TRUE(WaitFor([&] { return lost = member.TakeLost(), !lost.empty(); }));
  EXPECT_EQ(lost.front().address, ServerOf("b").address);
  EXPECT_EQ(lost.front().epoch, 2);
  EXPECT_TRUE(WaitFor([&] { return !member.drains(); })) << "none is left";
}

TEST_F(Member, ADrainWithoutAnotherServerWaitsForNone) {
  FleetMember::Config config = ConfigOf("a");
  config.takes = false;
  FleetMember member(config, Plans());
  ASSERT_EQ(member.Claim("blue", 1), 1);
  member.Start();
  member.Drain("");
  EXPECT_TRUE(WaitFor([&] { return !member.drains(); }));
}

TEST_F(Member, AClaimSaysWhoHasTheRoomOrThatItsOwnLeaseHasEnded) {
  FleetMember::Config config = ConfigOf("a");
  config.takes = false;
  FleetMember member(config, Plans()), other(ConfigOf("b"), Plans());
  ASSERT_EQ(other.Claim("blue", 1), 1);
  const auto why = [&member](const std::string& room) -> std::string {
    try {
      member.Claim(room, 1);
    } catch (const OperatorError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why("blue"), "room blue is held by b at " + ServerOf("b").address);
  usleep((kFleetLeaseS * 1000 + 200) * 1000);
  EXPECT_NE(why("green").find("the lease of this server, of 5 s, ended"), std::string::npos);
}

}  // namespace member_test
}  // namespace seam
