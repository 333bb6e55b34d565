/// Clients whose server is silent knock at its standby, in virtual time.

#include <algorithm>
#include <set>

#include "common/net/loose_datagram.h"
#include "server/fleet/take_over_rule.h"
#include "server/server.h"
#include "server/sessions/handshake.h"
#include "tests/fleet/fleet_rooms.h"

namespace seam {
namespace knock_test {

using Host = FleetRooms::Host;
using Guest = FleetRooms::Guest;

/// Two players at a host, and a server that stands by for it at the next address.
struct Game : FleetRooms {
  explicit Game(const std::string& impair = "perfect", bool told = false)
      : FleetRooms(impair), a(Begin(1, identity)) {
    if (told) a.server->NameStandby(now_us, ToString(kStandby));
    for (const char* name : {"ann", "bob"}) Join(name, a.address);
    EXPECT_TRUE(Run(20000000, [this] { return AllPlayAt(a); })) << "both play";
    Run(3000000);
    OpenDoor(*identity);
  }
  void OpenDoor(const KeyPair& keys) {
    door_keys = keys;
    door = network.Attach(kStandby);
    handshake = std::make_unique<Handshake>(*door, door_entropy, door_keys, traffic);
  }
  void Suggest() {
    for (const auto& guest : guests) guest->client->SuggestStandby(kStandby);
  }
  /// Lets the standby answer; counts the knocks as it would.
  bool RunWithDoor(std::int64_t us, const std::function<bool()>& until = {}) {
    return Run(us, [&] {
      Address from;
      Bytes datagram;
      while (door->Receive(&from, &datagram)) {
        JoinRequest join;
        const std::uint64_t number = LooseNumber(datagram);
        const auto verdict = handshake->Receive(now_us, from, number, datagram, &join);
        if (verdict != Handshake::Verdict::kJoins) continue;
        knocks.push_back(join);
      }
      door->Flush();
      rule.NoteLook(now_us, a.server->tick() != seen_tick, 0);
      seen_tick = a.server->tick();
      for (const JoinRequest& join : knocks) {
        const bool owner =
            a.server->places().IsOwner(join.name, static_cast<std::uint64_t>(join.place_key));
        if (owner && join.epoch_proved) rule.NoteKnock(now_us, join.name == "ann" ? 0 : 1);
        EXPECT_EQ(join.room, "main");
        EXPECT_EQ(join.epoch, 1);
        EXPECT_TRUE(owner) << join.name;
        EXPECT_TRUE(join.epoch_proved) << join.name;
        names.insert(join.name);
      }
      knocks.clear();
      due = due || rule.Due(now_us, {0, 1});
      return until && until();
    });
  }

  static constexpr Address kStandby{2, 7777};
  Host& a;
  KeyPair door_keys;
  SeededEntropy door_entropy{4242};
  TrafficCount traffic;
  std::unique_ptr<Net> door;
  std::unique_ptr<Handshake> handshake;
  std::vector<JoinRequest> knocks;
  std::set<std::string> names;  // of those who have knocked
  TakeOverRule rule;
  std::int64_t seen_tick = 0;
  bool due = false;
};

TEST(Knock, AServerThatIsSilentForAMomentKeepsItsClientsAndTheirWorld) {
  for (const char* impair : {"perfect", "4g", "delay=200ms"}) {
    Game game(impair);
    game.Suggest();
    game.RunWithDoor(3000000);
    EXPECT_EQ(game.names.size(), 0u) << impair << ": it speaks";
    game.a.runs = false;
    game.RunWithDoor(2500000);
    EXPECT_EQ(game.names.size(), 2u) << impair;
    EXPECT_TRUE(game.due) << impair;
    for (const auto& guest : game.guests) {
      EXPECT_TRUE(guest->client->knocking()) << impair;
      EXPECT_TRUE(guest->client->running()) << "the world goes on";
    }
    game.a.runs = true;
    EXPECT_TRUE(game.Run(10000000, [&] { return game.AllPlayAt(game.a); }));
    game.Run(2000000);
    for (const auto& guest : game.guests) {
      EXPECT_FALSE(guest->client->knocking());
      EXPECT_EQ(guest->client->rejoins(), 0) << "the same session";
      EXPECT_EQ(guest->client->server(), game.a.address);
    }
  }
}

TEST(Knock, TheStandbyLetsThemInWhenItHasTheRoom) {
  for (const char* impair : {"perfect", "demo", "4g"}) {
    Game game(impair);
    game.Suggest();
    const Bytes saved = [&] {
      game.a.server->GiveAway(2);
      return game.a.server->Save(game.now_us);
    }();
    const std::int64_t tick = game.a.server->tick(), begin_us = game.now_us;
    game.a.runs = false;
    ASSERT_TRUE(game.RunWithDoor(5000000, [&] { return game.due; })) << impair;
    const std::int64_t due_us = game.now_us - begin_us;
    EXPECT_LT(due_us, 1500000) << impair;
    Host& b = game.GoOn(saved);
    ASSERT_EQ(b.address, Game::kStandby);
    EXPECT_EQ(b.server->tick(), tick);
    ASSERT_TRUE(game.Run(10000000, [&] { return game.AllPlayAt(b); })) << impair;
    std::printf("%s: due after %.2f s, all play again after %.2f s\n", impair,
                static_cast<double>(due_us) * 1e-6,
                static_cast<double>(game.now_us - begin_us) * 1e-6);
    EXPECT_LT(game.now_us - begin_us, 3000000) << impair;
    for (const auto& guest : game.guests) {
      EXPECT_EQ(guest->client->epoch(), 2);
      EXPECT_EQ(guest->client->rejoins(), 1);
      EXPECT_FALSE(guest->client->knocking());
    }
    game.Run(6000000);
    EXPECT_TRUE(game.AllPlayAt(b)) << "and go on";
  }
}

TEST(Knock, OneOfTwoThatIsCutOffEndsNoRoomThatLives) {
  Game game;
  game.Suggest();
  game.guests[0]->gate->cut = game.a.address;
  game.RunWithDoor(4000000);
  EXPECT_EQ(game.names, (std::set<std::string>{"ann"}));
  EXPECT_FALSE(game.due) << "the holder lives";
  game.guests[0]->gate->cut.reset();
  EXPECT_TRUE(game.Run(20000000, [&] { return game.AllPlayAt(game.a); }));
}

TEST(Knock, AClientWithoutADirectoryKnocksWhereItsServerHasSaid) {
  for (const bool before : {true, false}) {
    Game game("perfect", before);
    if (!before) game.a.server->NameStandby(game.now_us, ToString(Game::kStandby));
    game.Run(500000);
    game.a.runs = false;
    game.RunWithDoor(1500000);
    EXPECT_EQ(game.names.size(), 2u) << (before ? "said before they came" : "said to them");
    game.a.runs = true;
    EXPECT_TRUE(game.Run(10000000, [&] { return game.AllPlayAt(game.a); })) << "not sent away";
  }
}

TEST(Knock, AServerWithOtherKeysLearnsNoNameAndNoPlace) {
  Game game;
  SeededEntropy entropy(99);
  game.OpenDoor(KeyPair(entropy));
  game.Suggest();
  game.a.runs = false;
  game.RunWithDoor(1500000);
  EXPECT_TRUE(game.guests[0]->client->knocking());
  EXPECT_EQ(game.names.size(), 0u);
  EXPECT_EQ(game.guests[0]->client->fatal(), "");
}

}  // namespace knock_test
}  // namespace seam
