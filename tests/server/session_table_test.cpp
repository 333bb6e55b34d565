/// Who is in the room, with raw links instead of clients: names, peer numbers, silence, places.

#include "server/sessions/session_table.h"

#include <gtest/gtest.h>

#include "common/net/memory.h"
#include "common/sync/lease.h"

namespace seam {
namespace {

const char* const kTwoPlayers = R"(
[[part]]
name = "ball"
circle = 0.5
[[player]]
name = "ann"
[[player]]
name = "bob"
)";

/// The far end: a link that says Hello and acknowledges.
struct Guest {
  Guest(MemoryNetwork* network, std::uint16_t port, const std::string& guest)
      : address{0x7f000001, port}, net(network->Attach(address)), link(port), name(guest) {}

  Address address;
  std::unique_ptr<Net> net;
  Link link;
  std::string name;
  std::string refusal;
};

class SessionTableTest : public ::testing::Test {
 protected:
  using Kind = SessionEvent::Kind;

  /// What the guests send arrives, the table answers, and the guests read it.
  void Exchange() {
    Address from;
    Bytes datagram;
    while (net_->Receive(&from, &datagram)) {
      table_.Receive(now_us_, from, datagram, [&](Session& session, ByteView message) {
        const AnyMessage any = Decode(message);
        if (std::holds_alternative<Hello>(any)) table_.NoteHello(session);
      });
    }
    table_.DropSilent(now_us_);
    table_.Advance(now_us_);
    Stats stats;
    table_.Flush(now_us_, &stats);
    for (const SessionEvent& event : table_.TakeEvents()) events_.push_back(event);
  }
  void Say(Guest* guest, std::int32_t protocol = kProtocolVersion) {
    Hello hello;
    hello.name = guest->name;
    hello.protocol = protocol;
    guest->link.SendUnreliable(Encode(hello));
    Listen(guest);
  }
  /// Reads what came and acknowledges it.
  void Listen(Guest* guest) {
    guest->link.Flush(now_us_, [&](ByteView datagram) { guest->net->Send({1, 7777}, datagram); });
    Exchange();
    Address from;
    Bytes datagram;
    while (guest->net->Receive(&from, &datagram)) {
      guest->link.Receive(now_us_, datagram, [&](ByteView message) {
        const AnyMessage any = Decode(message);
        if (const auto* bye = std::get_if<Bye>(&any)) guest->refusal = bye->reason;
      });
    }
  }
  /// Joins, proves its address, and gets ready.
  void GetReady(Guest* guest) {
    Say(guest);
    for (int n = 0; n < 3; ++n) Later(guest);
    Say(guest);
  }
  void Later(Guest* guest) {
    now_us_ += 150000;
    Listen(guest);
  }
  int PeerOf(const Guest& guest) {
    const Session* session = table_.Find(guest.address);
    return session == nullptr ? -1 : session->peer;
  }
  std::vector<Kind> Kinds() const {
    std::vector<Kind> kinds;
    for (const SessionEvent& event : events_) kinds.push_back(event.kind);
    return kinds;
  }

  Scene scene_ = ParseScene(kTwoPlayers, "test.toml");
  MemoryNetwork network_;
  std::unique_ptr<Net> net_ = network_.Attach({1, 7777});
  SessionTable table_{scene_, Bytes(2500, 1), *net_};
  std::int64_t now_us_ = 1000000;
  std::vector<SessionEvent> events_;
};

TEST_F(SessionTableTest, PlayerPIsPeerPPlusOneAndSpectatorsComeAfterThePlayers) {
  Guest guest(&network_, 1, "guest"), bob(&network_, 2, "bob"), ann(&network_, 3, "ann");
  Say(&guest), Say(&bob), Say(&ann);
  EXPECT_EQ(PeerOf(guest), 3);
  EXPECT_EQ(PeerOf(bob), 2);
  EXPECT_EQ(PeerOf(ann), 1);
  EXPECT_EQ(table_.Find(guest.address)->player, -1);
  EXPECT_EQ(table_.Find(bob.address)->player, 1);
}

TEST_F(SessionTableTest, JoiningProvingAndGettingReadyAreSaidInThisOrder) {
  Guest bob(&network_, 2, "bob");
  Say(&bob);
  EXPECT_EQ(Kinds(), std::vector<Kind>{Kind::kJoined});
  EXPECT_EQ(table_.PeerOfPlayer(), (std::vector<int>{-1, -1})) << "joined is not ready";
  Say(&bob);
  EXPECT_EQ(Kinds(), (std::vector<Kind>{Kind::kJoined, Kind::kProven}))
      << "a Hello before the room was sent is no readiness";
  Say(&bob);
  EXPECT_EQ(Kinds(), (std::vector<Kind>{Kind::kJoined, Kind::kProven, Kind::kReady}));
  EXPECT_EQ(table_.PeerOfPlayer(), (std::vector<int>{-1, 2}));
}

TEST_F(SessionTableTest, ANameInUseIsRefusedAndFreeWhenItsOwnerWasSilentForAWhile) {
  Guest bob(&network_, 2, "bob"), other(&network_, 3, "bob");
  Say(&bob), Say(&other);
  EXPECT_EQ(PeerOf(other), -1);
  EXPECT_EQ(other.refusal, "the name bob is in use");
  now_us_ += 1500000;
  Guest again(&network_, 4, "bob");
  Say(&again);
  EXPECT_EQ(PeerOf(again), 2) << "his number too";
  EXPECT_EQ(PeerOf(bob), -1);
  EXPECT_EQ(events_.back().kind, Kind::kJoined);
  EXPECT_EQ(events_[events_.size() - 2].kind, Kind::kLeft);
}

TEST_F(SessionTableTest, AnotherProtocolIsRefused) {
  Guest bob(&network_, 2, "bob");
  Say(&bob, kProtocolVersion + 1);
  EXPECT_EQ(table_.count(), 0);
  EXPECT_FALSE(bob.refusal.empty());
  EXPECT_TRUE(events_.empty());
}

TEST_F(SessionTableTest, WhoIsSilentLongerThanTheServersPatienceIsGone) {
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

TEST_F(SessionTableTest, WhoHasNotProvedItsAddressIsDroppedWhenOthersWantItsPlace) {
  std::vector<std::unique_ptr<Guest>> forged;
  const auto fill = [&](int n) {
    const auto port = static_cast<std::uint16_t>(100 + n);
    forged.push_back(std::make_unique<Guest>(&network_, port, "forged" + std::to_string(n)));
    Guest& guest = *forged.back();
    Hello hello;
    hello.name = guest.name;
    guest.link.SendUnreliable(Encode(hello));
    guest.link.Flush(now_us_, [&](ByteView datagram) { guest.net->Send({1, 7777}, datagram); });
    Exchange();
  };
  for (int n = 0; n < 40; ++n) fill(n);
  EXPECT_LT(table_.count(), kPeersMax);
  EXPECT_EQ(PeerOf(*forged.back()), -1) << "the room is full";
  Guest ann(&network_, 1, "ann"), bob(&network_, 2, "bob"), guest(&network_, 3, "guest");
  GetReady(&ann), GetReady(&bob);
  EXPECT_EQ(PeerOf(bob), 2) << "players have places of their own";
  Say(&guest);
  EXPECT_EQ(PeerOf(guest), -1) << "the forged ones still have time to prove themselves";
  now_us_ += 1000000;
  Guest again(&network_, 4, "guest");
  Say(&again);
  EXPECT_EQ(PeerOf(again), 3) << again.refusal;
  EXPECT_EQ(PeerOf(*forged.front()), -1) << "the oldest gave way";
}

}  // namespace
}  // namespace seam
