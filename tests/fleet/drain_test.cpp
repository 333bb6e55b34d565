/// Rooms that move to another server, and servers that had them, in virtual time.

#include <algorithm>

#include "server/server.h"
#include "tests/fleet/fleet_rooms.h"

namespace seam {
namespace drain_test {

using Host = FleetRooms::Host;

/// Two players at a host, in the middle of a game.
struct Game : FleetRooms {
  explicit Game(const std::string& impair) : FleetRooms(impair), a(Begin(1, identity)) {
    for (const char* name : {"ann", "bob"}) Join(name, a.address);
    EXPECT_TRUE(Run(20000000, [this] { return AllPlayAt(a); })) << "both play";
    Run(3000000);
  }
  Host& a;
};

TEST(Drain, ClientsGoOnAtTheOtherServerAndKeepTheirWorldUntilItsWelcome) {
  for (const char* impair : {"perfect", "demo", "4g", "delay=200ms"}) {
    for (const std::int64_t down_us :
         {std::int64_t{0}, std::int64_t{300000}, std::int64_t{4000000}}) {
      Game game(impair);
      const std::int64_t begin_us = game.now_us, tick = game.a.server->tick();
      game.a.server->GiveAway(2);
      const Bytes saved = game.a.server->Save(game.now_us);
      Redirect to;
      to.address = ToString(Address{2, 7777});
      to.room = "main";
      to.epoch = 2;
      game.a.server->RedirectAll(game.now_us, to);
      std::int64_t longest_us = 0, stepped_us = game.now_us, newest = -1;
      bool gone = false;
      const auto watch = [&] {
        for (const auto& guest : game.guests) {
          const Replica* const replica = guest->client->replica();
          // From its welcome on it loads the room anew.
          gone = gone || (replica == nullptr && guest->client->moving());
        }
        const Replica* const first = game.guests[0]->client->replica();
        if (first != nullptr && first->tick() > newest) {
          longest_us = std::max(longest_us, game.now_us - stepped_us);
          newest = first->tick();
          stepped_us = game.now_us;
        }
        return false;
      };
      game.Run(down_us, watch);
      EXPECT_EQ(game.a.server->tick(), tick) << "it does no tick more";
      Host& b = game.GoOn(saved);
      EXPECT_EQ(b.server->tick(), tick) << "the room's ticks go on";
      EXPECT_EQ(b.server->epoch(), 2);
      const bool all = game.Run(20000000, [&] { return watch() || game.AllPlayAt(b); });
      const double gap_s = static_cast<double>(game.now_us - begin_us) * 1e-6;
      EXPECT_TRUE(all) << impair << " " << down_us;
      EXPECT_TRUE(game.a.server->all_redirected());
      EXPECT_FALSE(gone) << "the world is kept until the welcome";
      for (const auto& guest : game.guests) {
        EXPECT_FALSE(guest->client->closed());
        EXPECT_EQ(guest->client->fatal(), "");
        EXPECT_EQ(guest->client->rejoins(), 1);
        EXPECT_EQ(guest->client->epoch(), 2);
      }
      std::printf(
          "%s, the other server there after %.1f s: all play again after %.2f s, longest "
          "stand of a client's world %.2f s\n",
          impair, static_cast<double>(down_us) * 1e-6, gap_s,
          static_cast<double>(longest_us) * 1e-6);
      EXPECT_LT(gap_s - static_cast<double>(down_us) * 1e-6, 3.5) << impair;
    }
  }
}

TEST(Drain, AJoinThatComesDuringTheDrainIsSentOnToo) {
  Game game("demo");
  game.a.server->GiveAway(2);
  Host& b = game.GoOn(game.a.server->Save(game.now_us));
  game.a.server->RedirectAll(game.now_us, FleetRooms::RedirectTo(b, 2));
  ClientConfig watcher;
  watcher.server = game.a.address;
  watcher.watch = true;
  FleetRooms::Guest& late = game.Join("late", game.a.address);
  FleetRooms::Silence silence;
  late.client = std::make_unique<Client>(watcher, *late.net, silence, *late.entropy);
  EXPECT_TRUE(game.Run(10000000, [&] { return late.client->running(); }));
  EXPECT_EQ(late.client->server(), b.address);
  EXPECT_EQ(late.client->epoch(), 2);
}

TEST(Drain, FourRedirectsInARowAreTooManyAndThreeAreNot) {
  for (const int hops : {3, 4}) {
    FleetRooms fleet("perfect");
    for (int i = 0; i < hops; ++i) fleet.Begin(1, fleet.identity);
    Host& last = fleet.Begin(1, fleet.identity);
    for (int i = 0; i < hops; ++i) {
      Host& next = *fleet.hosts[static_cast<std::size_t>(i) + 1];
      fleet.hosts[static_cast<std::size_t>(i)]->server->RedirectAll(
          fleet.now_us, FleetRooms::RedirectTo(next, 1));
    }
    const Client& client = *fleet.Join("ann", fleet.hosts[0]->address).client;
    fleet.Run(8000000);
    if (hops == 3) {
      EXPECT_EQ(client.fatal(), "");
      EXPECT_EQ(client.server(), last.address);
      EXPECT_GE(client.peer(), 0);
    } else {
      EXPECT_EQ(client.fatal(),
                "the servers redirect again and again, now to " + ToString(last.address));
    }
  }
}

TEST(StaleServer, OneThatIsShownAHigherEpochWithItsProofIsToldSo) {
  Game game("demo");
  // Another server takes the room over, and nobody tells the first, which stands still meanwhile.
  game.a.runs = false;
  game.a.server->GiveAway(2);
  Host& b = game.GoOn(game.a.server->Save(game.now_us));
  for (const auto& guest : game.guests) guest->client->Suggest(b.address, 2);
  ASSERT_TRUE(game.Run(20000000, [&] { return game.AllPlayAt(b); })) << "they go where the room is";
  b.runs = false;
  game.a.runs = true;
  for (const auto& guest : game.guests) guest->client->Suggest(game.a.address, 2);
  EXPECT_TRUE(game.Run(20000000, [&] { return game.a.server->shown_epoch() == 2; }));
  game.a.server->Forsake(game.now_us);
  const std::int64_t tick = game.a.server->tick();
  game.Run(1000000);
  EXPECT_EQ(game.a.server->tick(), tick);
  EXPECT_EQ(game.a.server->client_count(), 0);
  for (const auto& guest : game.guests) EXPECT_LT(guest->client->peer(), 0) << "not let in";
}

TEST(StaleServer, AnEpochWithoutProofStopsNoRoomAndItsClientIsNotLetIn) {
  FleetRooms fleet("perfect");
  SeededEntropy other(3);
  Host& a = fleet.Begin(1, fleet.identity);
  Host& b = fleet.Begin(2, std::make_shared<const KeyPair>(other));
  Client& client = *fleet.Join("ann", b.address).client;
  ASSERT_TRUE(fleet.Run(10000000, [&] { return client.running(); }));
  ASSERT_EQ(client.epoch(), 2);
  b.runs = false;
  client.Suggest(a.address, 2);
  fleet.Run(15000000);
  EXPECT_EQ(client.server(), a.address);
  EXPECT_LT(client.peer(), 0);
  EXPECT_NE(client.fatal().find("goes on elsewhere"), std::string::npos) << client.fatal();
  EXPECT_EQ(a.server->shown_epoch(), 0);
  const std::int64_t tick = a.server->tick();
  fleet.Run(500000);
  EXPECT_GT(a.server->tick(), tick);
}

TEST(EpochProof, IsOfOneKeyRoomAndEpoch) {
  SeededEntropy entropy(1);
  const Secret a(entropy), b(entropy);
  const std::int64_t proof = EpochProof(a, "main", 2);
  EXPECT_EQ(EpochProof(a, "main", 2), proof);
  EXPECT_NE(EpochProof(b, "main", 2), proof);
  EXPECT_NE(EpochProof(a, "mai", 2), proof);
  EXPECT_NE(EpochProof(a, "main", 3), proof);
}

}  // namespace drain_test
}  // namespace seam
