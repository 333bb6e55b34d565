#pragma once
/// A client that joins a server written by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "client/client.h"
#include "common/net/loose_datagram.h"
#include "common/net/memory.h"

namespace seam {

class ClientJoin : public ::testing::Test {
 protected:
  struct NoRecorder : Recorder {
    void Publish(const std::string&, std::int64_t, ByteView) override {}
  };

  static ClientConfig Config() {
    ClientConfig config;
    config.server = {1, 7777};
    config.name = "ann";
    config.key = 99;
    return config;
  }
  /// Lets so much time pass, and returns the last message that the client sent outside a session.
  AnyMessage Next(std::int64_t us) { return NextOf(&client_, us); }
  AnyMessage NextOf(Client* client, std::int64_t us) {
    now_us_ += us;
    client->Tick(now_us_, 0);
    AnyMessage last;
    Address from;
    Bytes datagram;
    while (server_->Receive(&from, &datagram)) {
      if (LooseNumber(datagram) == 0) continue;  // sealed
      EXPECT_EQ(datagram.size(), kHandshakeBytes);
      session_ = LooseNumber(datagram);
      EXPECT_NE(session_, 0u);
      last = Decode(LooseMessage(datagram));
    }
    return last;
  }
  void Answer(const Bytes& message) { server_->Send({2, 1}, LooseDatagram(session_, message)); }
  static Bytes Refusal(const std::string& reason) {
    Bye bye;
    bye.reason = reason;
    return Encode(bye);
  }

  /// A challenge of our server, in the time slot of `ephemeral_`.
  Challenge ChallengeOf(std::int64_t token) const {
    Challenge challenge;
    challenge.token = token;
    challenge.keys.assign(ephemeral_.open.begin(), ephemeral_.open.end());
    challenge.keys.insert(challenge.keys.end(), identity_.open.begin(), identity_.open.end());
    return challenge;
  }
  /// The server's half of the exchange.
  JoinSecrets SecretsOf(const Join& join) const {
    JoinTerms terms;
    terms.protocol = static_cast<std::uint32_t>(join.protocol);
    terms.number = session_;
    terms.cookie = join.token;
    terms.name = join.name;
    terms.room = join.room;
    terms.epoch = join.epoch;
    terms.proof = join.proof;
    std::copy_n(join.exchange.begin(), 32, terms.client.begin());
    terms.ephemeral = ephemeral_.open;
    terms.identity = identity_.open;
    return *JoinSecrets::OfServer(terms, ephemeral_.secret, identity_.secret, nullptr);
  }
  /// Lets the client join as peer 1; returns the number of its sealed session.
  std::uint64_t LetIn(std::int32_t epoch = 1) {
    Next(0);
    Answer(Encode(ChallengeOf(1)));
    AnyMessage any;
    for (int n = 0; n < 20 && !std::holds_alternative<Join>(any); ++n) any = Next(10000);
    if (!std::holds_alternative<Join>(any)) return 0;
    Link server(SecretsOf(std::get<Join>(any)).keys());
    Welcome welcome;
    welcome.peer = 1;
    welcome.room_bytes = 1000;
    welcome.key = 7;
    welcome.epoch = epoch;
    welcome.proof = 70 + epoch;
    server.SendReliable(Encode(welcome));
    server.Flush(now_us_, [&](ByteView datagram) { server_->Send({2, 1}, datagram); });
    now_us_ += 10000;
    client_.Tick(now_us_, 0);
    return server.session();
  }
  static std::optional<std::int64_t> KeyIn(const Join& join, const JoinSecrets& secrets) {
    SealedKey sealed{};
    std::copy_n(join.exchange.begin() + 32, sealed.size(), sealed.begin());
    return secrets.OpenKey(sealed);
  }

  SeededEntropy server_entropy_{9};
  const KeyPair ephemeral_{server_entropy_}, identity_{server_entropy_};
  MemoryNetwork network_;
  std::unique_ptr<Net> server_ = network_.Attach({1, 7777});
  std::unique_ptr<Net> net_ = network_.Attach({2, 1});
  SeededEntropy entropy_{1};
  NoRecorder recorder_;
  Client client_{Config(), *net_, recorder_, entropy_};
  std::int64_t now_us_ = 1000000;
  std::uint64_t session_ = 0;
};

}  // namespace seam
