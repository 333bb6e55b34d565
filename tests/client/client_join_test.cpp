/// Tests how a client joins, and its messages when it cannot, against a hand-written server.

#include "tests/client/client_join.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client/client.h"
#include "common/base/compress.h"
#include "common/net/crc32c.h"
#include "common/net/loose_datagram.h"
#include "common/net/memory.h"
#include "common/sync/method.h"
#include "server/server.h"
#include "tests/support/allocations/count_allocations.h"

namespace seam {
namespace client_join_test {

TEST_F(ClientJoin, SaysHelloUntilChallengedThenJoinsWithTokenAndKey) {
  EXPECT_TRUE(std::holds_alternative<Hello>(Next(0)));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(Next(50000))) << "ten times a second";
  EXPECT_TRUE(std::holds_alternative<Hello>(Next(50000)));
  Answer(Encode(ChallengeOf(1234)));
  const AnyMessage any = Next(10000);
  const Join* join = std::get_if<Join>(&any);
  ASSERT_NE(join, nullptr) << "at once";
  EXPECT_EQ(join->token, 1234);
  EXPECT_EQ(KeyIn(*join, SecretsOf(*join)), 99);
  EXPECT_EQ(join->name, "ann");
  Answer(Encode(ChallengeOf(5678)));
  const AnyMessage again = Next(10000);
  ASSERT_TRUE(std::holds_alternative<Join>(again));
  EXPECT_EQ(std::get<Join>(again).token, 5678) << "the newest";
}

TEST_F(ClientJoin, KeepsItsSessionNumberWhileNobodyAnswers) {
  Next(0);
  const std::uint64_t first = session_;
  for (int n = 0; n < 100; ++n) Next(100000);
  EXPECT_EQ(session_, first);
  EXPECT_EQ(client_.rejoins(), 0);
}

TEST_F(ClientJoin, TakesAnotherSessionNumberWhenItsWelcomeDoesNotCome) {
  Next(0);
  const std::uint64_t first = session_;
  Answer(Encode(ChallengeOf(1234)));
  for (int n = 0; n < 45; ++n) Next(100000);
  EXPECT_EQ(session_, first) << "a slow path";
  for (int n = 0; n < 10; ++n) Next(100000);
  EXPECT_NE(session_, first) << "the server may have dropped it: its number does not count again";
  EXPECT_TRUE(std::holds_alternative<Hello>(Next(100000))) << "a token is of one session";
}

TEST_F(ClientJoin, NamesBothProtocolsWhenTheServerSpeaksAnOlderOne) {
  Next(0);
  // A refusal of protocol 2: in a numbered datagram, without our version.
  Bytes old = LooseDatagram(session_, Refusal("protocol 2 is spoken here"));
  old[17] = 1;  // its number
  std::uint32_t crc = Crc32c({old.data(), 4});
  crc = Crc32c({old.data() + 8, old.size() - 8}, crc);
  for (std::size_t i = 0; i < 4; ++i) old[4 + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
  server_->Send({2, 1}, old);
  Next(10000);
  EXPECT_EQ(client_.fatal(),
            "the server speaks protocol 2, this client speaks 19: they need the same version");
}

TEST_F(ClientJoin, NamesBothProtocolsWhenTheServerSpeaksANewerOne) {
  Next(0);
  Answer(Refusal("protocol 20 is spoken here, you speak 19"));
  Next(10000);
  EXPECT_EQ(client_.fatal(),
            "the server speaks protocol 20, this client speaks 19: they need the same version");
}

TEST_F(ClientJoin, RetriesForThreeSecondsAfterAnyOtherRefusal) {
  Next(0);
  for (int n = 0; n < 31; ++n) {
    EXPECT_EQ(client_.fatal(), "") << n;
    Answer(Refusal("the name ann is in use"));
    Next(100000);
  }
  Answer(Refusal("the name ann is in use"));
  Next(100000);
  EXPECT_EQ(client_.fatal(), "the server refuses: the name ann is in use");
}

TEST_F(ClientJoin, ARefusalThatComesAfterTheWelcomeIsTooLate) {
  LetIn();
  EXPECT_EQ(client_.peer(), 1);
  EXPECT_EQ(client_.key(), 7);
  Answer(Refusal("the name ann is in use"));
  now_us_ += 10000;
  client_.Tick(now_us_, 0);
  EXPECT_FALSE(client_.closed());
  EXPECT_EQ(client_.peer(), 1);
  EXPECT_EQ(client_.stats().dropped_malformed, 0);
}

TEST_F(ClientJoin, AServerThatLostTheSessionIsJoinedAnewAtOnceButOnlyIfItIsSilent) {
  const std::uint64_t sealed = LetIn();
  const std::uint64_t first = session_;
  const auto tick = [&] {
    now_us_ += 10000;
    client_.Tick(now_us_, 0);
  };
  const auto say_unknown = [&](std::uint64_t session) {
    server_->Send({2, 1}, LooseDatagram(session, Refusal("no such session")));
    tick();
  };
  for (int n = 0; n < 10; ++n) say_unknown(sealed);
  EXPECT_EQ(client_.peer(), 1) << "somebody on the path says so of a server that is there";
  for (int n = 0; n < 100; ++n) tick();
  say_unknown(sealed + 1);
  EXPECT_EQ(client_.peer(), 1) << "another session";
  say_unknown(sealed);
  EXPECT_EQ(client_.peer(), -1);
  Address from;
  Bytes datagram;
  while (server_->Receive(&from, &datagram)) {
    if (LooseNumber(datagram) != 0) session_ = LooseNumber(datagram);
  }
  EXPECT_NE(session_, first);
  EXPECT_TRUE(client_.fatal().empty() && !client_.closed());
}

TEST_F(ClientJoin, ARoomThatDoesNotUnpackIsRefusedInOneLine) {
  const Bytes room = Encode(Room());
  Bytes damaged = Compress(room), longer = Compress(room);
  damaged[damaged.size() / 2] ^= 1;
  longer.push_back(0);
  const Bytes bomb = Compress(Bytes(kRoomBytesMax + 1, '#'));
  ASSERT_LT(bomb.size(), 1000u);
  for (const Bytes& sent : {room, damaged, longer, bomb, Compress(Bytes(1000, 'x'))}) {
    Client client(Config(), *net_, recorder_, entropy_);
    NextOf(&client, 1000000);
    Answer(Encode(ChallengeOf(1)));
    const AnyMessage any = NextOf(&client, 10000);
    ASSERT_TRUE(std::holds_alternative<Join>(any));
    Link server(SecretsOf(std::get<Join>(any)).keys());
    Welcome welcome;
    welcome.peer = 1;
    welcome.room_bytes = static_cast<std::int32_t>(sent.size());
    welcome.key = 7;
    Chunk chunk;
    chunk.data = sent;
    server.SendReliable(Encode(welcome));
    server.SendReliable(Encode(chunk));
    server.Flush(now_us_, [&](ByteView out) { server_->Send({2, 1}, out); });
    const std::size_t before = AllocatedBytes();
    client.Tick(now_us_ + 10000, 0);
    EXPECT_LT(AllocatedBytes() - before, 200000u);
    EXPECT_EQ(client.fatal(), "the server's room does not decode");
    EXPECT_EQ(client.replica(), nullptr);
  }
}

TEST_F(ClientJoin, JoinsOnlyTheServerWhoseKeyItWasGiven) {
  for (const bool right : {true, false}) {
    ClientConfig config = Config();
    config.server_key = identity_.open;
    if (!right) (*config.server_key)[0] ^= 1;
    const std::unique_ptr<Net> net = network_.Attach({2, 1});
    Client pinned(config, *net, recorder_, entropy_);
    int joins = 0;
    for (int n = 0; n < 50 && pinned.fatal().empty(); ++n) {
      now_us_ += 100000;
      pinned.Tick(now_us_, 0);
      Address from;
      Bytes datagram;
      while (server_->Receive(&from, &datagram)) {
        session_ = LooseNumber(datagram);
        joins += std::holds_alternative<Join>(Decode(LooseMessage(datagram))) ? 1 : 0;
        Answer(Encode(ChallengeOf(5)));
      }
    }
    EXPECT_EQ(joins > 0, right);
    const bool named = pinned.fatal().find("not the one of --server-key") != std::string::npos;
    EXPECT_EQ(named, !right) << pinned.fatal();
  }
}

TEST(ClientJoinWatch, WatchersWithoutANameAreNumbered) {
  MemoryNetwork network;
  const std::unique_ptr<Net> net = network.Attach({1, 7777});
  struct Silence : Recorder {
    void Publish(const std::string&, std::int64_t, ByteView) override {}
  } silence;
  const Scene scene = ParseScene(
      "[[player]]\nname = \"ann\"\n[[part]]\nname = \"ground\"\nchain = [[-9, 0], [9, 0]]\n",
      "watched.toml");
  SeededEntropy entropy(5);
  ServerConfig settings;
  settings.sync = MakeSyncConfig(MethodNames{"buffer", "", ""});
  settings.sync.tick_hz = scene.solver.tick_hz;
  Server server(scene, settings, *net, silence, entropy);
  std::vector<std::unique_ptr<Net>> nets;
  std::vector<std::unique_ptr<Client>> clients;
  for (std::uint16_t i = 0; i < 4; ++i) {
    ClientConfig config;
    config.server = {1, 7777};
    config.watch = true;
    config.numbers_name = i < 3;  // the last one insists on the name
    nets.push_back(network.Attach({2, static_cast<std::uint16_t>(i + 1)}));
    clients.push_back(std::make_unique<Client>(config, *nets.back(), silence, entropy));
  }
  for (std::int64_t now_us = 1000000; now_us < 12000000; now_us += 5000) {
    server.Tick(now_us, 0);
    for (const auto& client : clients) client->Tick(now_us, 0);
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(clients[i]->fatal(), "");
    EXPECT_GE(clients[i]->peer(), 1);
    names.push_back(clients[i]->name());
  }
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 3u);
  for (const std::string& name : names) EXPECT_EQ(name.rfind("guest", 0), 0u) << name;
  const bool refused = clients[3]->fatal().find("the name guest is in use") != std::string::npos;
  EXPECT_TRUE(refused || clients[3]->peer() >= 1) << clients[3]->fatal();
}

}  // namespace client_join_test
}  // namespace seam
