/// A seal opens only what the other end has sealed, under its own number and direction; and a key
/// exchange gives the same keys to two ends that have seen the same words, and to nobody else.

#include "common/net/seal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "common/base/random.h"
#include "common/net/key_exchange.h"

namespace seam {
namespace seal_test {

constexpr std::size_t kFrom = 14;  // bytes of a datagram that are not encrypted

Bytes FromDigits(const std::string& digits) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

Secret SecretOf(const Bytes& bytes) {
  Secret secret;
  std::copy(bytes.begin(), bytes.end(), secret.data());
  return secret;
}

SealKeys ClientKeys() {
  SealKeys keys;
  keys.session = 0x1122334455667788;
  for (std::uint8_t i = 0; i < 32; ++i) keys.out.data()[i] = i;
  for (std::uint8_t i = 0; i < 32; ++i) keys.in.data()[i] = static_cast<std::uint8_t>(100 + i);
  keys.protocol = 14;
  keys.room = Fnv1a("main", 4);
  return keys;
}

Bytes Sealed(const Seal& seal, std::int64_t number, const Bytes& plain) {
  Bytes datagram = plain;
  seal.Close(number, kFrom, &datagram);
  return datagram;
}

Bytes Sample(std::size_t size, std::uint64_t seed = 1) {
  Random random(seed);
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Next());
  return bytes;
}

/// Computed by a second implementation of RFC 8439, which also gives the example of its section
/// 2.8.2.
TEST(Seal, GivesTheBytesOfTheProtocolPage) {
  const Bytes plain = FromDigits("534541321122334455667788000a000980000001800101022100026869");
  const Bytes expected = FromDigits(
      "534541321122334455667788000a7c598abdc8f3f496a29bbc4038c778f83ce6d74898b7c51e2373fed5eb9328");
  EXPECT_EQ(Sealed(Seal(ClientKeys()), 65546, plain), expected);
}

TEST(Seal, OpensWhatTheOtherEndSealedBothWays) {
  const Seal client(ClientKeys()), server(ClientKeys().Mirrored());
  for (const std::size_t size : {14u, 15u, 20u, 64u, 600u, 1184u}) {
    const Bytes plain = Sample(size);
    const Bytes up = Sealed(client, 7, plain), down = Sealed(server, 7, plain);
    EXPECT_EQ(up.size(), plain.size() + Seal::kTagBytes);
    EXPECT_TRUE(std::equal(plain.begin(), plain.begin() + kFrom, up.begin()));
    EXPECT_NE(up, down) << "each direction has a key of its own";
    Bytes opened;
    EXPECT_TRUE(server.Open(7, kFrom, up, &opened));
    EXPECT_EQ(opened, plain);
    EXPECT_TRUE(client.Open(7, kFrom, down, &opened));
    EXPECT_EQ(opened, plain);
    EXPECT_FALSE(client.Open(7, kFrom, up, &opened)) << "sent back to its sender";
  }
}

TEST(Seal, NoChangedBitAndNoOtherLengthOpens) {
  const Seal client(ClientKeys()), server(ClientKeys().Mirrored());
  const Bytes sealed = Sealed(client, 3, Sample(40));
  Bytes opened;
  for (std::size_t bit = 0; bit < sealed.size() * 8; ++bit) {
    Bytes changed = sealed;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_FALSE(server.Open(3, kFrom, changed, &opened)) << bit;
  }
  for (std::size_t size = 0; size < sealed.size(); ++size) {
    EXPECT_FALSE(server.Open(3, kFrom, {sealed.data(), size}, &opened)) << size;
  }
  Bytes longer = sealed;
  longer.push_back(0);
  EXPECT_FALSE(server.Open(3, kFrom, longer, &opened));
  EXPECT_TRUE(server.Open(3, kFrom, sealed, &opened));
}

TEST(Seal, NothingThatIsChangedAtRandomOpens) {
  const Seal client(ClientKeys()), server(ClientKeys().Mirrored());
  std::vector<Bytes> samples;
  for (std::uint64_t n = 0; n < 20; ++n)
    samples.push_back(Sealed(client, 5, Sample(20 + 9 * n, n)));
  Random random(20261128);
  Bytes opened;
  int changed = 0;
  for (int round = 0; round < 200'000; ++round) {
    const Bytes& sample = samples[random.Next() % samples.size()];
    Bytes data = sample;
    if (round % 3 == 0) data.resize(random.Next() % 80);
    for (std::uint64_t k = 0; !data.empty() && k <= random.Next() % 4; ++k) {
      std::uint8_t& byte = data[random.Next() % data.size()];
      byte = static_cast<std::uint8_t>(byte ^ random.Next());
    }
    if (std::find(samples.begin(), samples.end(), data) != samples.end()) continue;
    ++changed;
    ASSERT_FALSE(server.Open(5, kFrom, data, &opened));
  }
  EXPECT_GT(changed, 150'000);
}

/// The datagram says 16 bits of its number; a recorded one fits again after each wrap.
TEST(Seal, ARecordedDatagramDoesNotOpenUnderTheNumberAWrapLater) {
  const Seal client(ClientKeys()), server(ClientKeys().Mirrored());
  const Bytes sealed = Sealed(client, 1000, Sample(100));
  Bytes opened;
  for (std::int64_t wraps = 1; wraps < 50; ++wraps) {
    EXPECT_FALSE(server.Open(1000 + 65'536 * wraps, kFrom, sealed, &opened));
  }
  for (const int bit : {16, 31, 32, 47, 48, 62}) {
    EXPECT_FALSE(server.Open(1000 + (std::int64_t{1} << bit), kFrom, sealed, &opened)) << bit;
  }
  EXPECT_FALSE(server.Open(-64'536, kFrom, sealed, &opened)) << "before the first of a session";
  EXPECT_TRUE(server.Open(1000, kFrom, sealed, &opened));
}

TEST(Seal, AnotherRoomProtocolOrSessionIsAnotherSeal) {
  const Bytes sealed = Sealed(Seal(ClientKeys()), 3, Sample(40));
  const std::function<void(SealKeys*)> changes[] = {
      [](SealKeys* keys) { keys->room = Fnv1a("red", 3); },
      [](SealKeys* keys) { keys->protocol = 15; },
      [](SealKeys* keys) { keys->server = !keys->server; },
      [](SealKeys* keys) { keys->in.data()[31] ^= 1; }};
  Bytes opened;
  for (const auto& change : changes) {
    SealKeys keys = ClientKeys().Mirrored();
    EXPECT_TRUE(Seal(keys).Open(3, kFrom, sealed, &opened));
    change(&keys);
    EXPECT_FALSE(Seal(keys).Open(3, kFrom, sealed, &opened));
  }
}

TEST(Secret, IsWipedAtItsEnd) {
  alignas(Secret) std::uint8_t memory[sizeof(Secret)] = {};
  SeededEntropy entropy(1);
  const auto zeros = [&] { return std::count(memory, memory + sizeof memory, 0); };
  Secret* const secret = new (memory) Secret(entropy);
  EXPECT_LT(zeros(), 8);
  secret->~Secret();
  EXPECT_EQ(zeros(), static_cast<std::ptrdiff_t>(sizeof memory));
}

TEST(Secret, ComesFromTheEntropySoThatRunsRepeat) {
  SeededEntropy a(1), b(1), c(2);
  const Secret first(a);
  EXPECT_EQ(first, Secret(b));
  EXPECT_NE(first, Secret(c));
  EXPECT_NE(first, Secret(a));
}

TEST(KeyPair, HasThePublicKeyOfRfc7748) {
  const KeyPair alice(
      SecretOf(FromDigits("77076d0a7318a57d3c16c17251b26645df4c2f87ebc0992ab177fba51db92c2a")));
  EXPECT_EQ(Bytes(alice.open.begin(), alice.open.end()),
            FromDigits("8520f0098930a754748b7ddcb43ef75a0dbf3a0d26381af4eba4a98eaa9b4e6a"));
}

/// The two ends of a handshake, and what they say in the open.
struct Both {
  explicit Both(std::uint64_t seed = 1) : entropy(seed) {
    terms.protocol = 13;
    terms.number = 77;
    terms.cookie = -5;
    terms.name = "ann";
    terms.room = "main";
    terms.client = client.open;
    terms.ephemeral = ephemeral.open;
    terms.identity = identity.open;
  }
  SeededEntropy entropy;
  KeyPair client{entropy}, ephemeral{entropy}, identity{entropy};
  JoinTerms terms;
};

TEST(KeyExchange, BothEndsHaveTheSameKeysAndEachItsOwnDirection) {
  const Both both;
  const auto at_client = JoinSecrets::OfClient(both.terms, both.client.secret, nullptr);
  const auto at_server =
      JoinSecrets::OfServer(both.terms, both.ephemeral.secret, both.identity.secret, nullptr);
  ASSERT_TRUE(at_client && at_server);
  EXPECT_EQ(at_client->keys().session, at_server->keys().session);
  EXPECT_NE(at_client->keys().out, at_client->keys().in);
  const Bytes sealed = Sealed(Seal(at_client->keys()), 1, Sample(50));
  Bytes opened;
  EXPECT_TRUE(Seal(at_server->keys()).Open(1, kFrom, sealed, &opened));
  for (const std::int64_t key : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1} << 62}) {
    EXPECT_EQ(at_server->OpenKey(at_client->CloseKey(key)), key);
  }
}

TEST(KeyExchange, EveryWordThatIsChangedOnTheWayGivesOtherKeys) {
  const Both both;
  const std::function<void(JoinTerms*)> changes[] = {
      [](JoinTerms* t) { t->protocol = 14; },
      [](JoinTerms* t) { t->number = 78; },
      [](JoinTerms* t) { t->cookie = 5; },
      [](JoinTerms* t) { t->name = "bob"; },
      [](JoinTerms* t) { t->room = "red"; },
      [](JoinTerms* t) { t->pass = {1}; },
      [](JoinTerms* t) { t->client[0] ^= 1; },
      [](JoinTerms* t) { t->ephemeral[9] ^= 1; },
      [](JoinTerms* t) { t->identity[31] ^= 1; },
      [](JoinTerms* t) { t->name = "annm", t->room = "ain"; }};
  const auto at_client = JoinSecrets::OfClient(both.terms, both.client.secret, nullptr);
  std::set<std::uint64_t> sessions = {at_client->keys().session};
  for (const auto& change : changes) {
    JoinTerms terms = both.terms;
    change(&terms);
    const auto at_server =
        JoinSecrets::OfServer(terms, both.ephemeral.secret, both.identity.secret, nullptr);
    ASSERT_TRUE(at_server.has_value());
    EXPECT_FALSE(at_server->OpenKey(at_client->CloseKey(9)).has_value());
    EXPECT_TRUE(sessions.insert(at_server->keys().session).second);
  }
}

TEST(KeyExchange, NobodyWithoutOneOfTheSecretsHasTheKeys) {
  const Both both, other(2);
  const TokenKeys token{Secret(other.client.secret), Secret(other.identity.secret)};
  const auto at_client = JoinSecrets::OfClient(both.terms, both.client.secret, nullptr);
  const SealedKey sealed = at_client->CloseKey(9);
  const auto opens = [&](const std::optional<JoinSecrets>& secrets) {
    return secrets && secrets->OpenKey(sealed).has_value();
  };
  const Secret& ephemeral = both.ephemeral.secret;
  const Secret& identity = both.identity.secret;
  EXPECT_TRUE(opens(JoinSecrets::OfServer(both.terms, ephemeral, identity, nullptr)));
  EXPECT_FALSE(opens(JoinSecrets::OfServer(both.terms, other.ephemeral.secret, identity, nullptr)))
      << "the lasting key alone, stolen later";
  EXPECT_FALSE(opens(JoinSecrets::OfServer(both.terms, ephemeral, other.identity.secret, nullptr)))
      << "a server that only says that it has the lasting key";
  EXPECT_FALSE(opens(JoinSecrets::OfClient(both.terms, other.client.secret, nullptr)));
  EXPECT_FALSE(opens(JoinSecrets::OfServer(both.terms, ephemeral, identity, &token)))
      << "a token's keys go into the session's";
}

TEST(KeyExchange, APublicKeyThatIsNoneIsRefused) {
  Both both;
  both.terms.client = {};
  EXPECT_FALSE(
      JoinSecrets::OfServer(both.terms, both.ephemeral.secret, both.identity.secret, nullptr));
  both.terms.ephemeral = {1};  // of order 1, as 0 is
  EXPECT_FALSE(JoinSecrets::OfClient(both.terms, both.client.secret, nullptr));
}

TEST(KeyExchange, TheSameSeedGivesTheSameSession) {
  const auto session = [](std::uint64_t seed) {
    const Both both(seed);
    return JoinSecrets::OfClient(both.terms, both.client.secret, nullptr)->keys().session;
  };
  EXPECT_EQ(session(5), session(5));
  EXPECT_NE(session(5), session(6));
}

}  // namespace seal_test
}  // namespace seam
