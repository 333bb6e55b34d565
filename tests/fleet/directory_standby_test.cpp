/// The standby of a room in each directory of a fleet.

#include <limits>
#include <thread>

#include "common/fleet/directory_values.h"
#include "tests/fleet/each_directory.h"

namespace seam {
namespace directory_test {

class EachStandby : public EachDirectory {
 protected:
  static FleetRoom Red(Directory& directory) {
    const FleetListing listing = Listed(directory);
    EXPECT_EQ(listing.refused, "");
    const FleetRoom* const room = listing.FindRoom("red");
    EXPECT_NE(room, nullptr);
    return room != nullptr ? *room : FleetRoom();
  }
  static bool StandsBy(Directory& directory, const FleetRoom& room) {
    bool done = false;
    const Status status = directory.StandBy(room, &done);
    EXPECT_TRUE(status.ok()) << status.why();
    return done;
  }
  static std::int32_t TakenFrom(Directory& directory, const FleetRoom& room) {
    std::int32_t epoch = -1;
    const Status status = directory.TakeFrom(room, &epoch);
    EXPECT_TRUE(status.ok()) << status.why();
    return epoch;
  }
};

INSTANTIATE_TEST_SUITE_P(Fleet, EachStandby, ::testing::Values("file", "etcd"),
                         [](const auto& each) { return std::string(each.param); });

TEST_P(EachStandby, ARoomHasOneStandbyWhichIsNotItsHolder) {
  const auto a = Open("a"), b = Open("b"), c = Open("c");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  const FleetRoom red = Red(*b);
  EXPECT_FALSE(red.standby);
  EXPECT_FALSE(StandsBy(*a, red)) << "it holds the room";
  EXPECT_TRUE(StandsBy(*b, red));
  EXPECT_FALSE(StandsBy(*c, red)) << "b does";
  EXPECT_FALSE(StandsBy(*c, Red(*c))) << "b does";
  ASSERT_TRUE(Red(*c).standby);
  EXPECT_EQ(Red(*c).standby->server, "b");
  EXPECT_EQ(Red(*c).standby->address, ServerOf("b").address);
  ASSERT_TRUE(c->StandDown("red").ok());
  EXPECT_TRUE(Red(*c).standby) << "not c's to end";
  ASSERT_TRUE(b->StandDown("red").ok());
  EXPECT_FALSE(Red(*c).standby);
  EXPECT_TRUE(StandsBy(*c, Red(*c)));
  ASSERT_TRUE(c->Leave().ok());
  EXPECT_FALSE(Red(*b).standby) << "it goes with its server's lease";
}

TEST_P(EachStandby, TheHolderAloneAppointsAnother) {
  const auto a = Open("a"), b = Open("b"), c = Open("c");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  ASSERT_TRUE(StandsBy(*b, Red(*b)));
  const auto appoint = [](Directory& by, const char* id) {
    const FleetListing listing = Listed(by);
    EXPECT_TRUE(by.Appoint("red", 1, *listing.FindServer(id)).ok());
  };
  appoint(*c, "c");
  EXPECT_EQ(Red(*a).standby->server, "b") << "not c's to say";
  appoint(*a, "c");
  EXPECT_EQ(Red(*a).standby->server, "c");
  EXPECT_EQ(TakenFrom(*b, Red(*b)), 0) << "it is the standby no more";
  EXPECT_EQ(TakenFrom(*c, Red(*c)), 2);
  appoint(*a, "b");
  EXPECT_FALSE(Red(*c).standby) << "the room is c's";
}

TEST_P(EachStandby, TheStandbyAloneTakesTheRoomFromItsHolder) {
  const auto a = Open("a"), b = Open("b"), c = Open("c");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  ASSERT_TRUE(StandsBy(*b, Red(*b)));
  EXPECT_EQ(TakenFrom(*c, Red(*c)), 0) << "not the standby";
  EXPECT_EQ(TakenFrom(*a, Red(*a)), 0) << "the holder itself";
  EXPECT_EQ(Red(*c).epoch, 1);
  EXPECT_EQ(TakenFrom(*b, Red(*b)), 2);
  const FleetRoom red = Red(*c);
  EXPECT_EQ(red.epoch, 2);
  EXPECT_EQ(red.holder->server, "b");
  EXPECT_EQ(red.holder->epoch, 2);
  EXPECT_FALSE(red.standby) << "the new holder is none";
  EXPECT_EQ(red.spec, kSpec);
  bool done = true;
  ASSERT_TRUE(a->TakeBack("red", 1, &done).ok());
  EXPECT_FALSE(done) << "the old holder is shown the epoch";
  EXPECT_EQ(TakenFrom(*b, red), 0);
}

TEST_P(EachStandby, AHolderThatHasActedSinceItWasReadKeepsTheRoom) {
  const auto a = Open("a"), b = Open("b");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  ASSERT_TRUE(StandsBy(*b, Red(*b)));
  const FleetRoom read = Red(*b);
  bool done = false;
  ASSERT_TRUE(a->TakeBack("red", 1, &done).ok());  // as after its lease had ended
  ASSERT_TRUE(done);
  EXPECT_EQ(TakenFrom(*b, read), 0) << "the holder is another entry";
  EXPECT_EQ(Red(*b).epoch, 1);
  EXPECT_EQ(Red(*b).holder->server, "a");
  EXPECT_EQ(TakenFrom(*b, Red(*b)), 2) << "as it is read now";
}

TEST_P(EachStandby, ClaimMoveAndReleaseEndIt) {
  const auto a = Open("a"), b = Open("b"), c = Open("c");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  ASSERT_TRUE(StandsBy(*b, Red(*b)));
  std::int32_t next = 0;
  ASSERT_TRUE(a->Move("red", 1, *Listed(*a).FindServer("b"), &next).ok());
  ASSERT_EQ(next, 2);
  EXPECT_FALSE(Red(*a).standby) << "b holds it now";
  ASSERT_TRUE(StandsBy(*c, Red(*c)));
  ASSERT_TRUE(b->GiveUp("red", 2).ok());
  EXPECT_TRUE(Red(*a).standby);
  EXPECT_EQ(TakenOver(*c, "red"), 3);
  EXPECT_FALSE(Red(*a).standby) << "c holds it now";
  ASSERT_TRUE(StandsBy(*a, Red(*a)));
  ASSERT_TRUE(c->Release("red", 3).ok());
  EXPECT_FALSE(Red(*a).standby) << "there is no room";
}

TEST_P(EachStandby, AnEpochIsGivenOnceWhenTheStandbyAndOthersRaceAtTheEndOfALease) {
  const auto a = Open("a"), b = Open("b");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  ASSERT_TRUE(StandsBy(*b, Red(*b)));
  const FleetRoom read = Red(*b);
  std::int32_t from = -1, over = -1;
  std::thread standby([&] { from = TakenFrom(*b, read); });
  ASSERT_TRUE(a->Leave().ok());
  const auto c = Open("c");
  over = TakenOver(*c, "red");
  standby.join();
  EXPECT_EQ((from > 0) + (over > 0), 1) << from << " " << over;
  EXPECT_EQ(Red(*b).epoch, 2);
}

TEST_P(EachStandby, AStandbyThatIsNoServerIsIgnoredAndNamed) {
  const auto a = Open("a");
  ASSERT_EQ(Claimed(*a, "red"), 1);
  const std::unique_ptr<KeyStore> store = OpenKeyStore(text_);
  for (const char* wrong :
       {"", "5", "[]", R"({"server": "b"})", R"({"server": "b", "address": "example.org:7777"})",
        R"({"server": "b", "address": "1.2.3.4:0"})",
        R"({"server": "b c", "address": "1.2.3.4:7"})",
        R"({"server": 5, "address": "1.2.3.4:7777"})"}) {
    bool done = false;
    ASSERT_TRUE(store->Commit({}, {{"/seam/test/rooms/red/standby", wrong, 0}}, &done).ok());
    const FleetListing listing = Listed(*a);
    EXPECT_NE(listing.refused, "") << wrong;
    EXPECT_FALSE(listing.FindRoom("red")->standby) << wrong;
    EXPECT_TRUE(listing.FindRoom("red")->holder) << wrong;
  }
}

}  // namespace directory_test
}  // namespace seam
