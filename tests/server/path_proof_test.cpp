/// A session's address gets little before its client has acknowledged something that was sent
/// there.

#include "server/sessions/path_proof.h"

#include <gtest/gtest.h>

#include <functional>

#include "common/base/random.h"
#include "server/sessions/session_table.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace path_proof_test {

constexpr char kOnePlayer[] =
    "[[player]]\nname = \"ann\"\n[[part]]\nname = \"ground\"\nchain = [[-9, 0], [9, 0]]\n";
constexpr Address kVictim{0x0a000001, 99};

/// Counts the bytes that a server sends to each address, and gets from each.
class CountingNet : public Net {
 public:
  explicit CountingNet(std::unique_ptr<Net> net) : net_(std::move(net)) {}
  void Advance(std::int64_t now_us) override { net_->Advance(now_us); }
  void Flush() override { net_->Flush(); }
  void Send(const Address& to, ByteView datagram) override {
    out[to] += datagram.size;
    net_->Send(to, datagram);
  }
  bool Receive(Address* from, Bytes* datagram) override {
    const bool came = net_->Receive(from, datagram);
    if (came) in[*from] += datagram->size();
    return came;
  }
  std::map<Address, std::size_t> out, in;

 private:
  std::unique_ptr<Net> net_;
};

class PathProofOfSession : public ::testing::Test {
 protected:
  static Bytes Noise(std::size_t size) {
    Random random(1);
    Bytes bytes(size);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Next());
    return bytes;
  }
  void Step() {
    now_us_ += 16667;
    Address from;
    Bytes datagram;
    while (net_.Receive(&from, &datagram)) {
      table_.Receive(now_us_, from, datagram, [&](Session& session, ByteView message) {
        if (std::holds_alternative<Ready>(Decode(message))) table_.NoteReady(session);
      });
    }
    table_.DropSilent(now_us_);
    table_.Advance(now_us_);
    // States of a dozen bodies, as a room with something in it has them.
    table_.ForEachReady(-1, [&](Session& session) { session.link.SendUnreliable(Bytes(300, 1)); });
    table_.Flush(now_us_, &stats_);
    (void)table_.TakeEvents();
  }
  void Join() {
    ann_.SayHello();
    Step();
    ann_.Read(now_us_);
    ann_.SayJoin();
    Step();
  }
  void GetReady() {
    Join();
    ann_.Read(now_us_);
    ann_.link.SendReliable(Encode(Ready()));
    for (int n = 0; n < 2000 && table_.PeerOfPlayer()[0] < 0; ++n) StepBoth();
    ASSERT_EQ(table_.PeerOfPlayer()[0], 1);
  }
  void StepBoth() {
    ann_.Flush(now_us_);
    Step();
    ann_.Read(now_us_);
  }

  Scene scene_ = ParseScene(kOnePlayer, "test.toml");
  MemoryNetwork network_;
  CountingNet net_{network_.Attach(Guest::kServer)};
  SeededEntropy entropy_{1};
  SessionTable table_{scene_, Noise(60000), AllowedTraffic(60, 30), net_, entropy_};
  Guest ann_{&network_, 1, "ann"};
  const Address own_{0x7f000001, 1};
  std::int64_t now_us_ = 1000000;
  Stats stats_;
};

TEST_F(PathProofOfSession, AClientThatJoinsAndSaysNothingGetsAtMostFourTimesItsBytes) {
  Join();
  ASSERT_EQ(table_.count(), 1);
  for (int n = 0; n < 60 * 12; ++n) Step();
  EXPECT_EQ(table_.count(), 0);
  EXPECT_LE(net_.out[own_], 4 * net_.in[own_]);
  EXPECT_GT(net_.out[own_], net_.in[own_]) << "a welcome, and the first of the room";
  std::printf("[          ] %zu bytes for %zu\n", net_.out[own_], net_.in[own_]);
}

TEST_F(PathProofOfSession, AClientThatRepeatsItsJoinGetsAtMostFourTimesItsBytes) {
  Join();
  for (int n = 0; n < 60 * 12; ++n) {
    if (n % 6 == 0 && table_.count() == 1) ann_.SayJoin();
    Step();
    EXPECT_LE(net_.out[own_], 4 * net_.in[own_]);
  }
}

TEST_F(PathProofOfSession, AClientThatAnswersIsWelcomedAtOnceAndGetsAllOfTheRoom) {
  Join();
  ann_.Read(now_us_);
  EXPECT_TRUE(ann_.welcomed) << "in the first datagram";
  std::size_t room = 0;
  for (int n = 0; n < 120; ++n) {
    ann_.Flush(now_us_);
    Step();
    ann_.Read(now_us_, [&](const AnyMessage& any) {
      if (const auto* chunk = std::get_if<Chunk>(&any)) room += chunk->data.size();
    });
  }
  EXPECT_GE(room, 58000u) << "two seconds later";
}

TEST_F(PathProofOfSession, ASessionThatIsMovedToAVictimSendsItAtMostFourTimesTheBytesFromThere) {
  GetReady();
  ann_.net = network_.Attach(kVictim);
  const std::size_t before = net_.out[own_];
  for (int n = 0; n < 60 * 8; ++n) {
    ann_.link.SendUnreliable(Bytes(20, 1));
    ann_.Flush(now_us_);
    Step();  // the victim answers nothing
    EXPECT_LE(net_.out[kVictim], 4 * net_.in[kVictim]);
  }
  EXPECT_GT(net_.out[kVictim], 0u);
  EXPECT_LT(net_.out[own_] - before, 400u) << "all goes to the newest address";
}

TEST_F(PathProofOfSession, AClientThatMovesGetsAllAgainAfterItsFirstAnswer) {
  GetReady();
  ann_.net = network_.Attach(kVictim);
  std::size_t all = 0;
  for (int n = 0; n < 120; ++n) {
    ann_.link.SendUnreliable(Bytes(20, 1));
    StepBoth();
    if (n == 3) all = net_.out[kVictim];
  }
  EXPECT_GT(net_.out[kVictim] - all, 116 * 300u) << "every message, from the fourth step on";
}

TEST(PathProof, AnAcknowledgementOfWhatWasSentElsewhereIsNone) {
  PathProof path;
  path.Begin(10);
  EXPECT_EQ(path.left(), 0u);
  path.Receive(100, 10);
  EXPECT_EQ(path.left(), 400u);
  EXPECT_FALSE(path.Spend(401));
  EXPECT_TRUE(path.Spend(300));
  EXPECT_EQ(path.left(), 100u);
  path.Receive(1, 11);
  EXPECT_TRUE(path.Spend(1000000));
  path.Begin(50);
  EXPECT_FALSE(path.Spend(1)) << "another address, another proof";
}

}  // namespace path_proof_test
}  // namespace seam
