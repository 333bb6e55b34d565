/// A room that demands connect tokens: who comes in, and how the others are refused.

#include <gtest/gtest.h>

#include "server/sessions/handshake.h"
#include "server/sessions/session_table.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace token_join_test {

const char* const kPlayers =
    "[[part]]\nname = \"ball\"\ncircle = 0.5\n[[player]]\nname = \"ann\"\n[[player]]\nname = "
    "\"bob\"\n";

class TokenJoin : public ::testing::Test {
 protected:
  static constexpr std::int64_t kUnixS = 1'790'000'000;

  void Exchange() {
    Address from;
    Bytes datagram;
    while (net_->Receive(&from, &datagram)) {
      (void)table_.Receive(now_us_, from, datagram, [](Session&, ByteView) {});
    }
    table_.Advance(now_us_);
    table_.Flush(now_us_, &stats_);
    (void)table_.TakeEvents();
  }
  /// Returns how the join ends: "welcome", or the refusal.
  std::string Join(Guest* guest, const ConnectToken* token) {
    guest->refusal.clear();
    guest->welcomed = false;
    guest->token = token;
    guest->SayHello();
    Exchange();
    guest->Read(now_us_);
    guest->SayJoin();
    Exchange();
    guest->Read(now_us_);
    return guest->welcomed ? "welcome" : guest->refusal;
  }
  ConnectToken Token(const std::string& name, const std::string& room = "main",
                     bool may_play = true) {
    TokenGrant grant;
    grant.protocol = static_cast<std::uint32_t>(kProtocolVersion);
    grant.name = name;
    grant.room = room;
    grant.may_play = may_play;
    grant.created_s = kUnixS;
    grant.expires_s = kUnixS + kTokenLifeS;
    ConnectToken token;
    EXPECT_TRUE(ReadToken(MakeToken(grant, *key_, operator_entropy_), &token).ok());
    return token;
  }

  SeededEntropy operator_entropy_{77};
  std::shared_ptr<const Secret> key_ = std::make_shared<const Secret>(operator_entropy_);
  Scene scene_ = ParseScene(kPlayers, "test.toml");
  MemoryNetwork network_;
  std::unique_ptr<Net> net_ = network_.Attach(Guest::kServer);
  SeededEntropy entropy_{1};
  SessionTable table_{scene_, Bytes(2500, 1), AllowedTraffic(60, 30), *net_, entropy_,
                      0,      nullptr,        TokenDoor{key_, "main"}};
  std::int64_t now_us_ = kUnixS * 1000000;
  Stats stats_;
};

TEST_F(TokenJoin, AGoodOneCountsOnce) {
  Guest ann(&network_, 1, "ann"), thief(&network_, 2, "ann");
  const ConnectToken token = Token("ann");
  EXPECT_EQ(Join(&ann, &token), "welcome");
  EXPECT_EQ(table_.count(), 1);
  EXPECT_EQ(Join(&thief, &token), "the token was used before");
  EXPECT_EQ(table_.Find(1)->id.number, ann.number) << "and harms nobody";
}

TEST_F(TokenJoin, EachThatIsNotRightIsRefusedByName) {
  Guest ann(&network_, 1, "ann");
  EXPECT_EQ(Join(&ann, nullptr), "a token is needed here: seam-client --token FILE");
  const ConnectToken red = Token("ann", "red");
  EXPECT_EQ(Join(&ann, &red), "the token is for room red, this is main");
  const ConnectToken bobs = Token("bob");
  EXPECT_EQ(Join(&ann, &bobs), "the token is for bob, not for ann");
  const ConnectToken looks = Token("ann", "main", false);
  EXPECT_EQ(Join(&ann, &looks), "the token lets ann only look on");
  ConnectToken cut = Token("ann");
  cut.pass.resize(100);
  EXPECT_EQ(Join(&ann, &cut), "the token is cut off");
  ConnectToken future = Token("ann");
  future.pass[11] = '2';
  EXPECT_EQ(Join(&ann, &future), "the token is of another version than this program reads (1)");
  ConnectToken changed = Token("ann");
  changed.pass[100] ^= 1;
  EXPECT_EQ(Join(&ann, &changed), "the token was made with another key, or was changed");
  const ConnectToken late = Token("ann");
  now_us_ += kTokenLifeS * 1000000;
  EXPECT_EQ(Join(&ann, &late), "the token has expired");
  EXPECT_EQ(table_.count(), 0);
}

TEST_F(TokenJoin, APassThatWasSniffedIsNothingWithoutItsKeys) {
  Guest thief(&network_, 2, "ann"), ann(&network_, 1, "ann");
  const ConnectToken token = Token("ann");
  ConnectToken sniffed = token;
  sniffed.keys = TokenKeys();
  EXPECT_EQ(Join(&thief, &sniffed), "") << "only another challenge";
  EXPECT_EQ(table_.count(), 0);
  EXPECT_EQ(Join(&ann, &token), "welcome") << "and it was not used up";
}

TEST_F(TokenJoin, AClientThatWasInComesBackWithTheKeyOfItsPlace) {
  Guest ann(&network_, 1, "ann"), again(&network_, 2, "ann"), thief(&network_, 3, "ann");
  const ConnectToken token = Token("ann");
  ASSERT_EQ(Join(&ann, &token), "welcome");
  thief.key = ann.key + 1;
  EXPECT_EQ(Join(&thief, nullptr), "a token is needed here: seam-client --token FILE");
  again.key = ann.key;
  EXPECT_EQ(Join(&again, nullptr), "welcome");
  EXPECT_EQ(table_.count(), 1);
}

TEST_F(TokenJoin, AServerWithoutTheRoomSendsAGoodTokenOnAndDoesNotUseItUp) {
  TrafficCount traffic;
  const KeyPair identity(entropy_);
  Handshake handshake(*net_, entropy_, identity, traffic, TokenDoor{key_, ""});
  std::string room;
  const auto ask = [&](Guest* guest, const ConnectToken& token) {
    guest->refusal.clear();
    guest->token = &token;
    std::string to;
    for (int n = 0; n < 2; ++n) {
      n == 0 ? guest->SayHello() : guest->SayJoin();
      Address from;
      Bytes datagram;
      while (net_->Receive(&from, &datagram)) {
        JoinRequest join;
        const auto verdict =
            handshake.Receive(now_us_, from, LooseNumber(datagram), datagram, &join);
        if (verdict != Handshake::Verdict::kJoins) continue;
        room = join.room;
        Redirect redirect;
        redirect.room = join.room;
        redirect.address = "192.0.2.1:7777";
        redirect.epoch = 1;
        handshake.AnswerByRedirect(now_us_, from, join, redirect);
      }
      guest->Read(now_us_, [&to](const AnyMessage& any) {
        if (const auto* redirect = std::get_if<Redirect>(&any)) to = redirect->address;
      });
    }
    return to.empty() ? guest->refusal : to;
  };
  const ConnectToken token = Token("ann", "red"), bobs = Token("bob", "red");
  Guest ann(&network_, 1, "ann"), again(&network_, 2, "ann"), thief(&network_, 3, "eve");
  EXPECT_EQ(ask(&ann, token), "192.0.2.1:7777");
  EXPECT_EQ(room, "red") << "the join named none";
  EXPECT_EQ(ask(&again, token), "192.0.2.1:7777") << "it counts once at the room, not here";
  EXPECT_EQ(ask(&thief, bobs), "the token is for bob, not for eve");
}

TEST(TokenJoinOpen, ARoomWithoutAnOperatorTakesNoTokens) {
  const Scene scene = ParseScene(kPlayers, "test.toml");
  MemoryNetwork network;
  const std::unique_ptr<Net> net = network.Attach(Guest::kServer);
  SeededEntropy entropy(1);
  SessionTable table(scene, Bytes(10, 1), AllowedTraffic(60, 30), *net, entropy);
  Guest ann(&network, 1, "ann");
  ConnectToken token;
  token.pass = Bytes(kTokenPassBytes, 1);
  ann.token = &token;
  for (int n = 0; n < 2; ++n) {
    n == 0 ? ann.SayHello() : ann.SayJoin();
    Address from;
    Bytes datagram;
    while (net->Receive(&from, &datagram)) {
      (void)table.Receive(1000, from, datagram, [](Session&, ByteView) {});
    }
    ann.Read(1000);
  }
  EXPECT_EQ(ann.refusal, "no tokens are taken here: join without --token");
}

}  // namespace token_join_test
}  // namespace seam
