/// Connect tokens, as netcode's standard has a server check them: each that is not right is refused
/// by name.

#include "common/net/connect_token.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "common/base/random.h"

namespace seam {
namespace connect_token_test {

constexpr std::int64_t kNowS = 1'790'000'000;

/// An operator and what it grants.
struct Operator {
  explicit Operator(std::uint64_t seed = 1) : entropy(seed), key(entropy) {
    grant.protocol = 13;
    grant.room = "main";
    grant.name = "ann";
    grant.created_s = kNowS;
    grant.expires_s = kNowS + kTokenLifeS;
    need.protocol = 13;
    need.room = "main";
    need.name = "ann";
    need.now_s = kNowS + 5;
  }
  std::string Text() { return MakeToken(grant, key, entropy); }
  ConnectToken Token() {
    ConnectToken token;
    const Status status = ReadToken(Text(), &token);
    EXPECT_TRUE(status.ok()) << status.why();
    return token;
  }
  /// Why the pass is refused; "": it is not.
  std::string Refusal(ByteView pass) const {
    TokenGrant opened;
    return OpenPass(pass, key, need, &opened).why();
  }
  SeededEntropy entropy;
  Secret key;
  TokenGrant grant;
  TokenNeed need;
};

Bytes TextBytes(const std::string& text) { return Bytes(text.begin(), text.end()); }

TEST(ConnectToken, GivesClientAndServerTheSameKeysAndTheServerTheGrant) {
  Operator op;
  for (const bool may_play : {true, false}) {
    op.grant.may_play = may_play;
    const ConnectToken token = op.Token();
    EXPECT_EQ(token.name, "ann");
    EXPECT_EQ(token.room, "main");
    EXPECT_EQ(token.pass.size(), kTokenPassBytes);
    TokenGrant opened;
    const Status status = OpenPass(token.pass, op.key, op.need, &opened);
    ASSERT_TRUE(status.ok()) << status.why();
    EXPECT_EQ(opened.keys.to_server, token.keys.to_server);
    EXPECT_EQ(opened.keys.to_client, token.keys.to_client);
    EXPECT_NE(token.keys.to_server, token.keys.to_client);
    EXPECT_EQ(opened.may_play, may_play);
    EXPECT_EQ(opened.expires_s, kNowS + kTokenLifeS);
  }
}

TEST(ConnectToken, ThePassThatIsSentSaysNothingButItsTimes) {
  Operator op;
  op.grant.room = op.need.room = "a_long_name_of_a_room";
  op.grant.name = op.need.name = "a_long_name_of_a_player";
  const ConnectToken token = op.Token();
  const auto has = [&](const Bytes& part) {
    return std::search(token.pass.begin(), token.pass.end(), part.begin(), part.end()) !=
           token.pass.end();
  };
  EXPECT_FALSE(has(TextBytes("a_long_name_of_a_room")));
  EXPECT_FALSE(has(TextBytes("a_long_name_of_a_player")));
  for (const Secret* key : std::initializer_list<const Secret*>{&token.keys.to_server,
                                                                &token.keys.to_client, &op.key}) {
    EXPECT_FALSE(has(Bytes(key->data(), key->data() + 8)));
  }
  EXPECT_EQ(op.Refusal(token.pass), "");
}

TEST(ConnectToken, NoTwoAreAlikeUnlessTheSeedIs) {
  Operator op, same;
  std::set<std::string> texts;
  for (int n = 0; n < 100; ++n) {
    const std::string text = op.Text();
    EXPECT_EQ(text, same.Text());
    EXPECT_TRUE(texts.insert(text).second);
    EXPECT_EQ(text.size(), 2 * kTokenBytes);
  }
}

TEST(ConnectToken, EachThatIsNotRightIsRefusedByName) {
  const struct {
    std::function<void(Operator*)> change;
    const char* refusal;
  } cases[] = {
      {[](Operator*) {}, ""},
      {[](Operator* op) { op->need.now_s = kNowS + kTokenLifeS - 1; }, ""},
      {[](Operator* op) { op->need.now_s = kNowS + kTokenLifeS; }, "the token has expired"},
      {[](Operator* op) { op->need.now_s = kNowS + 1'000'000; }, "the token has expired"},
      {[](Operator* op) { op->need.room = "red"; }, "the token is for room main, this is red"},
      {[](Operator* op) { op->need.name = "bob"; }, "the token is for ann, not for bob"},
      {[](Operator* op) { op->need.protocol = 14; },
       "the token is for protocol 13, 14 is spoken here"},
      {[](Operator* op) { op->key = Operator(2).key; },
       "the token was made with another key, or was changed"}};
  for (const auto& each : cases) {
    Operator op;
    const Bytes pass = op.Token().pass;
    each.change(&op);
    EXPECT_EQ(op.Refusal(pass), each.refusal);
  }
}

TEST(ConnectToken, OneThatIsCutOffIsRefusedAtEveryLength) {
  Operator op;
  const Bytes pass = op.Token().pass;
  for (std::size_t size = 1; size < pass.size(); ++size) {
    const std::string refusal = op.Refusal({pass.data(), size});
    EXPECT_EQ(refusal, "the token is cut off") << size;
  }
  EXPECT_EQ(op.Refusal({}), "the token is no connect token");
  Bytes longer = pass;
  longer.push_back(0);
  EXPECT_EQ(op.Refusal(longer), "the token has more behind its end");
  const std::string text = op.Text();
  ConnectToken token;
  for (std::size_t digits = 2; digits < text.size(); ++digits) {
    EXPECT_EQ(ReadToken(text.substr(0, digits), &token).why(), "is cut off") << digits;
  }
  EXPECT_EQ(ReadToken("", &token).why(), "is no connect token");
  EXPECT_EQ(ReadToken(text + text, &token).why(), "has more behind its end");
  EXPECT_TRUE(ReadToken(text + "\n", &token).ok());
  EXPECT_TRUE(ReadToken(text + "\r\n", &token).ok());
}

TEST(ConnectToken, OneOfAFutureVersionIsRefusedWhateverFollows) {
  Operator op;
  const std::string text = op.Text();
  for (const std::size_t size : {13u, 40u, 300u, 2048u}) {
    Bytes pass = op.Token().pass;
    pass[11] = '2';
    pass.resize(size, 7);
    EXPECT_EQ(op.Refusal(pass), "the token is of another version than this program reads (1)");
  }
  std::string future = text;
  future[23] = '2';  // "SEAM TOKEN 2"
  ConnectToken token;
  EXPECT_EQ(ReadToken(future, &token).why(), "is of another version than this program reads (1)");
}

TEST(ConnectToken, NoChangedBitPasses) {
  Operator op;
  const Bytes pass = op.Token().pass;
  for (std::size_t bit = 0; bit < pass.size() * 8; ++bit) {
    Bytes changed = pass;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_NE(op.Refusal(changed), "") << bit;
  }
}

TEST(ConnectToken, NoNonsenseIsRead) {
  Operator op;
  const std::string text = op.Text();
  Random random(7);
  ConnectToken token;
  int read = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string changed = text;
    if (round % 3 == 0) changed.resize(random.Next() % changed.size());
    for (std::uint64_t k = 0; !changed.empty() && k <= random.Next() % 3; ++k) {
      changed[random.Next() % changed.size()] = static_cast<char>(random.Next() % 256);
    }
    if (!ReadToken(changed, &token).ok()) continue;
    ++read;
    EXPECT_EQ(token.pass.size(), kTokenPassBytes);
    EXPECT_LE(token.name.size(), 32u);
    EXPECT_LE(token.room.size(), 32u);
  }
  EXPECT_LT(read, 2'000) << "most changes are no digits";
}

}  // namespace connect_token_test
}  // namespace seam
