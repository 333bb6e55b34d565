/// Sessions of a room, with raw links instead of clients: names, peer numbers, silence, places.

#include "server/sessions/session_table.h"

#include <gtest/gtest.h>

#include "common/sync/lease.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace session_table_test {

const char* const kTwoPlayers = R"(
[[part]]
name = "ball"
circle = 0.5
[[player]]
name = "ann"
[[player]]
name = "bob"
)";

class SessionTableTest : public ::testing::Test {
 protected:
  using Kind = SessionEvent::Kind;

  /// Delivers the guests' datagrams and lets the table answer.
  void Exchange() {
    Address from;
    Bytes datagram;
    while (net_->Receive(&from, &datagram)) {
      verdict_ = table_.Receive(now_us_, from, datagram, [&](Session& session, ByteView message) {
        ++delivered_;
        const AnyMessage any = Decode(message);
        if (std::holds_alternative<Ready>(any)) table_.NoteReady(session);
      });
    }
    table_.DropSilent(now_us_);
    table_.Advance(now_us_);
    table_.Flush(now_us_, &stats_);
    for (const SessionEvent& event : table_.TakeEvents()) events_.push_back(event);
  }
  /// Says Hello, and Join as the challenge allows.
  void Enter(Guest* guest) {
    guest->SayHello();
    Exchange();
    guest->Read(now_us_);
    guest->SayJoin();
    Exchange();
    guest->Read(now_us_);
  }
  /// Enters, loads, and is ready.
  void GetReady(Guest* guest) {
    Enter(guest);
    guest->link.SendReliable(Encode(Ready()));
    for (int n = 0; n < 3; ++n) Later(guest);
  }
  void Later(Guest* guest) {
    now_us_ += 150000;
    guest->Flush(now_us_);
    Exchange();
    guest->Read(now_us_);
  }
  /// The peer of the session of this name; -1: there is none.
  int PeerOf(const std::string& name) {
    for (int peer = 1; peer < kPeersMax; ++peer) {
      const Session* session = table_.Find(peer);
      if (session != nullptr && session->name == name) return peer;
    }
    return -1;
  }
  std::vector<Kind> Kinds() const {
    std::vector<Kind> kinds;
    for (const SessionEvent& event : events_) kinds.push_back(event.kind);
    return kinds;
  }

  Scene scene_ = ParseScene(kTwoPlayers, "test.toml");
  MemoryNetwork network_;
  std::unique_ptr<Net> net_ = network_.Attach(Guest::kServer);
  SeededEntropy entropy_{1};
  SessionTable table_{scene_, Bytes(2500, 1), AllowedTraffic(60, 30), *net_, entropy_};
  std::int64_t now_us_ = 1000000;
  std::vector<SessionEvent> events_;
  SessionTable::Verdict verdict_ = SessionTable::Verdict::kTaken;
  int delivered_ = 0;
  Stats stats_;
};

TEST_F(SessionTableTest, PlayerPIsPeerPPlusOneAndSpectatorsComeAfterThePlayers) {
  Guest guest(&network_, 1, "guest"), bob(&network_, 2, "bob"), ann(&network_, 3, "ann");
  Enter(&guest), Enter(&bob), Enter(&ann);
  EXPECT_EQ(PeerOf("guest"), 3);
  EXPECT_EQ(PeerOf("bob"), 2);
  EXPECT_EQ(PeerOf("ann"), 1);
  EXPECT_EQ(table_.Find(3)->player, -1);
  EXPECT_EQ(table_.Find(2)->player, 1);
}

TEST_F(SessionTableTest, JoiningLoadingAndGettingReadyAreReportedInThisOrder) {
  Guest bob(&network_, 2, "bob");
  Enter(&bob);
  EXPECT_EQ(Kinds(), (std::vector<Kind>{Kind::kJoined, Kind::kLoading}));
  EXPECT_EQ(table_.PeerOfPlayer(), (std::vector<int>{-1, -1})) << "joined is not ready";
  bob.link.SendReliable(Encode(Ready()));
  Later(&bob);
  EXPECT_EQ(Kinds(), (std::vector<Kind>{Kind::kJoined, Kind::kLoading, Kind::kReady}));
  EXPECT_EQ(table_.PeerOfPlayer(), (std::vector<int>{-1, 2}));
}

TEST_F(SessionTableTest, AHelloAllocatesNothingAndDrawsLessThanItself) {
  Guest bob(&network_, 2, "b");
  bob.SayHello();
  Exchange();
  bob.Read(now_us_);
  EXPECT_TRUE(bob.challenge.has_value());
  EXPECT_EQ(table_.count(), 0);
  EXPECT_TRUE(events_.empty());
  Hello shortest;
  shortest.name = "b";
  const std::size_t sent = LooseDatagram(1, Encode(shortest), kHandshakeBytes).size();
  EXPECT_LE(static_cast<double>(bob.bytes_in), 0.33 * static_cast<double>(sent));
  EXPECT_EQ(stats_.bytes_out, static_cast<std::int64_t>(bob.bytes_in));
}

TEST_F(SessionTableTest, OnlyTheAddressAndSessionThatWereChallengedMayJoinAndNotForEver) {
  Guest bob(&network_, 2, "bob"), thief(&network_, 3, "bob");
  bob.SayHello();
  Exchange();
  bob.Read(now_us_);
  thief.challenge = bob.challenge;
  thief.SayJoin();
  Exchange();
  EXPECT_EQ(table_.count(), 0) << "another address";
  bob.number = 77;
  bob.SayJoin();
  Exchange();
  EXPECT_EQ(table_.count(), 0) << "another session";
  bob.number = 2;
  now_us_ += 2 * AddressToken::kSlotUs;
  bob.SayJoin();
  Exchange();
  EXPECT_EQ(table_.count(), 0) << "too old";
  const std::int64_t old = bob.challenge->token;
  bob.Read(now_us_);
  EXPECT_NE(bob.challenge->token, old) << "a new one came";
  now_us_ += AddressToken::kSlotUs;
  bob.SayJoin();
  Exchange();
  EXPECT_EQ(table_.count(), 1) << "of the slot before";
}

TEST_F(SessionTableTest, AJoinThatIsRepeatedIsOneSession) {
  Guest bob(&network_, 2, "bob");
  Enter(&bob);
  bob.SayJoin();
  bob.SayHello();
  Exchange();
  EXPECT_EQ(verdict_, SessionTable::Verdict::kTaken);
  EXPECT_EQ(table_.count(), 1);
  EXPECT_EQ(delivered_, 0);
}

TEST_F(SessionTableTest, ANameInUseIsRefusedUntil30SecondsAfterItsOwnerWasLastHeard) {
  Guest bob(&network_, 2, "bob"), other(&network_, 3, "bob");
  GetReady(&bob);
  const std::int64_t heard_us = now_us_;
  Enter(&other);
  EXPECT_EQ(other.refusal, "the name bob is in use; free are ann");
  now_us_ = heard_us + PlaceTable::kNameHeldUs - 1;
  Exchange();
  EXPECT_EQ(table_.count(), 0) << "gone, but his place is held";
  other.refusal.clear();
  Enter(&other);
  Enter(&other);
  EXPECT_FALSE(other.welcomed);
  EXPECT_EQ(other.refusal, "the name bob is in use; free are ann");
  now_us_ = heard_us + PlaceTable::kNameHeldUs;
  Enter(&other);
  EXPECT_TRUE(other.welcomed);
  EXPECT_EQ(PeerOf("bob"), 2) << "his number too";
  EXPECT_NE(other.key, bob.key);
}

TEST_F(SessionTableTest, TheKeyGivesThePlaceBackAtOnceAndEndsTheOldSession) {
  Guest bob(&network_, 2, "bob");
  GetReady(&bob);
  Guest again(&network_, 4, "bob");
  again.key = bob.key;
  events_.clear();
  Enter(&again);
  EXPECT_TRUE(again.welcomed);
  EXPECT_EQ(again.key, bob.key) << "drawn once";
  EXPECT_EQ(table_.count(), 1);
  EXPECT_EQ(PeerOf("bob"), 2);
  EXPECT_EQ(table_.Find(2)->player, 1);
  EXPECT_EQ(Kinds(), (std::vector<Kind>{Kind::kLeft, Kind::kJoined, Kind::kLoading}));
  // Also when the old session is long gone.
  now_us_ += 2 * kPatienceUs;
  Exchange();
  EXPECT_EQ(table_.count(), 0);
  Guest third(&network_, 5, "bob");
  third.key = bob.key;
  Enter(&third);
  EXPECT_EQ(PeerOf("bob"), 2);
}

TEST_F(SessionTableTest, AJoinOfASessionThatIsOverDoesNotEndTheOneThatCameAfterIt) {
  Guest bob(&network_, 2, "bob");
  GetReady(&bob);
  Guest again(&network_, 4, "bob");
  again.key = bob.key;
  Enter(&again);
  bob.SayJoin();
  Exchange();
  EXPECT_EQ(table_.count(), 1);
  EXPECT_EQ(table_.Find(2)->id.number, again.number);
}

TEST_F(SessionTableTest, AnotherKeyIsRefused) {
  Guest bob(&network_, 2, "bob"), other(&network_, 3, "bob");
  GetReady(&bob);
  other.key = bob.key + 1;
  Enter(&other);
  EXPECT_FALSE(other.welcomed);
  EXPECT_EQ(table_.Find(2)->id.number, bob.number);
}

TEST_F(SessionTableTest, APlayerThatLeftOrWasNeverReadyHoldsNoName) {
  Guest bob(&network_, 2, "bob"), other(&network_, 3, "bob");
  GetReady(&bob);
  table_.Find(2)->goodbye = true;
  table_.Leave(*table_.Find(2), "left");
  Enter(&other);
  EXPECT_TRUE(other.welcomed);
  now_us_ += kPatienceUs + 1;
  Exchange();
  Guest third(&network_, 4, "bob");
  Enter(&third);
  EXPECT_TRUE(third.welcomed);
}

TEST_F(SessionTableTest, APlayerSilentBeforeItsKeyIsKnownLosesTheName) {
  Guest bob(&network_, 2, "bob"), other(&network_, 3, "bob");
  Enter(&bob);
  now_us_ += PlaceTable::kKeylessUs - 1;
  Enter(&other);
  EXPECT_FALSE(other.welcomed) << "may still be loading";
  now_us_ += 1;
  Enter(&other);
  EXPECT_TRUE(other.welcomed && table_.count() == 1 && PeerOf("bob") == 2);
}

TEST_F(SessionTableTest, OneAddressMayHoldSeveralSessionsAndNoneDisturbsTheOther) {
  Guest bob(&network_, 2, "bob");
  GetReady(&bob);
  now_us_ += 600000;
  DatagramWriter header_alone;
  bob.net->Send(Guest::kServer, header_alone.Finish({1, 0, 0}, Seal(LinkKeys(999))));
  Exchange();
  EXPECT_EQ(verdict_, SessionTable::Verdict::kNoRight);
  EXPECT_EQ(table_.count(), 1);
  bob.number = 1000;
  bob.name = "guest";
  Enter(&bob);
  EXPECT_EQ(table_.count(), 2);
  EXPECT_EQ(PeerOf("bob"), 2);
  EXPECT_EQ(PeerOf("guest"), 3);
}

TEST_F(SessionTableTest, AnotherProtocolIsRefusedWithBothVersionsWithinTheByteCredit) {
  Guest bob(&network_, 2, "bob");
  std::size_t sent = 0;
  for (int n = 0; n < 10 && bob.refusal.empty(); ++n) {
    Hello hello;
    hello.name = "bob";
    hello.protocol = 2;
    const Bytes old = LooseDatagram(bob.number, Encode(hello));  // not padded
    bob.net->Send(Guest::kServer, old);
    sent += old.size();
    Exchange();
    bob.Read(now_us_);
    EXPECT_LE(3 * bob.bytes_in, sent);
  }
  EXPECT_EQ(bob.refusal, "protocol 19 is spoken here, you speak 2");
  EXPECT_EQ(table_.count(), 0);
  EXPECT_TRUE(events_.empty());
}

TEST_F(SessionTableTest, APlayerSilentLongerThanThePatienceIsRemoved) {
  Guest bob(&network_, 2, "bob");
  GetReady(&bob);
  now_us_ += kPatienceUs;
  Exchange();
  EXPECT_EQ(table_.count(), 1) << "not yet";
  now_us_ += 1;
  Exchange();
  EXPECT_EQ(table_.count(), 0);
  EXPECT_EQ(events_.back().kind, Kind::kLeft);
  EXPECT_EQ(events_.back().peer, 2);
  EXPECT_EQ(events_.back().player, 1);
  EXPECT_TRUE(events_.back().was_ready);
}

TEST_F(SessionTableTest, AHeldPlaceOfASpectatorGivesWayWhenTheRoomIsFull) {
  std::vector<std::unique_ptr<Guest>> guests;
  const auto add = [&](int n) {
    guests.push_back(std::make_unique<Guest>(&network_, static_cast<std::uint16_t>(100 + n),
                                             "guest" + std::to_string(n)));
    GetReady(guests.back().get());
    return guests.back()->welcomed;
  };
  // Each stays silent after it got ready: the first are gone before the last come.
  for (int n = 0; n < kPeersMax - 3; ++n) EXPECT_TRUE(add(n)) << n;
  EXPECT_TRUE(add(5000)) << "the one that was left first gave way";
  Guest ann(&network_, 1, "ann");
  GetReady(&ann);
  EXPECT_EQ(PeerOf("ann"), 1) << "players have places of their own";
}

TEST_F(SessionTableTest, TrafficBeyondTheBudgetIsDroppedAndAFlooderIsRemoved) {
  Guest bob(&network_, 2, "bob");
  GetReady(&bob);
  const int before = delivered_;
  const Bytes one(1, 0);
  int over = 0;
  // 60 ticks a second, in each five full datagrams of the smallest messages there are.
  for (int tick = 0; tick < 12 * 60 && table_.count() == 1; ++tick) {
    now_us_ += 16667;
    for (int n = 0; n < 5; ++n) {
      for (int m = 0; m < 388; ++m) bob.link.SendUnreliable(one);
      bob.Flush(now_us_);
      Exchange();
      over += verdict_ == SessionTable::Verdict::kOverBudget ? 1 : 0;
      bob.Read(now_us_);
    }
  }
  EXPECT_GT(over, 1000);
  const double seconds = static_cast<double>(now_us_) / 1e6;
  EXPECT_LE(delivered_ - before, AllowedTraffic(60, 30).messages * (seconds + kBudgetBurst));
  EXPECT_EQ(table_.count(), 0);
  EXPECT_EQ(events_.back().why, "sent more than it may for 10 s");
  std::printf("[          ] %d of %d messages delivered\n", delivered_ - before,
              static_cast<int>(seconds * 60) * 5 * 388);
}

}  // namespace session_table_test
}  // namespace seam
