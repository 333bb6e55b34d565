/// A relay whose server ends, moves or comes back, and clients that are no watchers.

#include <gtest/gtest.h>

#include "server/relay/relay.h"
#include "tests/fleet/fleet_rooms.h"
#include "tests/relay/relayed_room.h"

namespace seam {
namespace relay_upstream_test {

ClusterConfig Crossing() {
  ClusterConfig config;
  config.impair = "demo";
  config.drive = Drive::kBot;
  config.keep = false;
  return config;
}

/// Two players at a host of a fleet, a relay of its room, and watchers behind it.
struct Game : FleetRooms {
  Game() : FleetRooms("demo"), a(Begin(1, identity)) {
    for (const char* name : {"ann", "bob"}) Join(name, a.address);
    EXPECT_TRUE(Run(20000000, [this] { return AllPlayAt(a); })) << "both play";
    RelayConfig config;
    config.upstream.server = a.address;
    config.limits.watchers = 10;
    up = network.Attach({0xb000001, 9000});
    down = network.Attach(kRelay);
    relay = std::make_unique<Relay>(config, *up, *down, entropy);
    for (std::uint16_t n = 0; n < 3; ++n) {
      watchers.push_back(std::make_unique<Guest>());
      Guest& guest = *watchers.back();
      guest.net = network.Attach({0xc000001, static_cast<std::uint16_t>(100 + n)});
      guest.entropy = std::make_unique<SeededEntropy>(900 + n);
      ClientConfig watch;
      watch.server = kRelay;
      watch.watch = true;
      watch.name = "w" + std::to_string(n);
      guest.client = std::make_unique<Client>(watch, *guest.net, silence, *guest.entropy);
    }
  }
  static constexpr Address kRelay{0xb000002, 7778};
  /// Lets the time pass with all of them, or less when `until` holds.
  bool Pass(std::int64_t us, const std::function<bool()>& until = {}) {
    return Run(us, [&] {
      relay->Tick(now_us + 5000000000);
      for (const auto& watcher : watchers) watcher->client->Tick(now_us + 77777777, 0);
      return until && until();
    });
  }
  bool AllWatch(std::int64_t from_tick) const {
    return std::all_of(watchers.begin(), watchers.end(), [&](const auto& watcher) {
      return watcher->client->running() && watcher->client->replica()->tick() > from_tick;
    });
  }
  /// True if all have joined anew, and watch later ticks.
  bool AllWatchAgain(std::int64_t from_tick) const {
    return AllWatch(from_tick) &&
           std::all_of(watchers.begin(), watchers.end(),
                       [](const auto& watcher) { return watcher->client->rejoins() == 1; });
  }

  Host& a;
  Silence silence;
  SeededEntropy entropy{4711};
  std::unique_ptr<Net> up, down;
  std::unique_ptr<Relay> relay;
  std::vector<std::unique_ptr<Guest>> watchers;
};

TEST(RelayUpstream, WatchersGoOnWhereTheServersRoomIsSent) {
  Game game;
  ASSERT_TRUE(game.Pass(10000000, [&] { return game.AllWatch(60); }));
  game.a.server->GiveAway(2);
  FleetRooms::Host& b = game.GoOn(game.a.server->Save(game.now_us));
  const std::int64_t tick = game.a.server->tick(), begin_us = game.now_us;
  game.a.server->RedirectAll(game.now_us, FleetRooms::RedirectTo(b, 2));
  EXPECT_TRUE(game.Pass(15000000, [&] { return game.AllWatchAgain(tick + 30); }));
  EXPECT_EQ(game.relay->client().server(), b.address);
  EXPECT_EQ(game.relay->client().epoch(), 2);
  for (const auto& watcher : game.watchers) {
    EXPECT_EQ(watcher->client->server(), Game::kRelay);
    EXPECT_EQ(watcher->client->fatal(), "");
    EXPECT_FALSE(watcher->client->closed());
  }
  std::printf("[          ] all watch again %.2f s after the redirect\n",
              static_cast<double>(game.now_us - begin_us) * 1e-6);
}

TEST(RelayUpstream, WatchersGoOnAfterTheServerWasKilledAndResumed) {
  Game game;
  ASSERT_TRUE(game.Pass(10000000, [&] { return game.AllWatch(60); }));
  const Bytes saved = game.a.server->Save(game.now_us);
  game.a.runs = false;
  game.a.server.reset();
  game.Pass(1000000);
  // Another process with the same keys, at the same address.
  Status status;
  const auto room = SavedRoom::Read(saved, &status);
  ASSERT_NE(room, nullptr) << status.why();
  ServerConfig config;
  const Room& was = room->room();
  config.sync = MakeSyncConfig(MethodNames{was.mode, was.reconcile, was.predict});
  config.sync.tick_hz = was.tick_hz;
  config.sync.send_hz = was.send_hz;
  config.sync.input_delay_ticks = was.input_delay_ticks;
  config.seed = was.seed;
  config.identity = game.identity;
  game.a.server =
      std::make_unique<Server>(*room, config, *game.a.path, game.silence, *game.a.entropy);
  status = game.a.server->Resume(*room, game.now_us);
  ASSERT_TRUE(status.ok()) << status.why();
  game.a.runs = true;
  const std::int64_t tick = game.a.server->tick(), begin_us = game.now_us;
  EXPECT_TRUE(game.Pass(15000000, [&] { return game.AllWatchAgain(tick + 30); }));
  std::printf("[          ] all watch again %.2f s after the restart\n",
              static_cast<double>(game.now_us - begin_us) * 1e-6);
  for (const auto& watcher : game.watchers) EXPECT_EQ(watcher->client->fatal(), "");
}

TEST(RelayUpstream, WatchersAreToldWhenTheServerClosesTheRoom) {
  RelayedRoom room(Crossing());
  auto& spot = room.AddRelay();
  const auto& seat = room.AddClient(spot.address, "wanda");
  room.cluster.RunToTick(200);
  ASSERT_TRUE(seat.client->running());
  Server& server = room.cluster.server();
  server.Shutdown(room.cluster.now_us(), "the session is over");
  for (int i = 0; i < 400 && !seat.client->closed(); ++i) {
    const std::int64_t now_us = room.cluster.now_us() + 5000 * i;
    room.cluster.server_net().Advance(now_us);
    room.cluster.server_net().Flush();
    spot.path->Advance(now_us + spot.clock_us);
    if (spot.relay->closed()) spot.relay->Shutdown(now_us + spot.clock_us, "it is closed");
    if (!spot.relay->closed()) spot.relay->Tick(now_us + spot.clock_us);
    seat.client->Tick(now_us + seat.clock_us, 0);
  }
  EXPECT_TRUE(spot.relay->closed());
  EXPECT_TRUE(seat.client->closed());
}

TEST(RelayUpstream, APlayerIsSentOnToTheServer) {
  ClusterConfig config = Crossing();
  config.players = 1;  // bob is free
  RelayedRoom room(config);
  const Address at = room.AddRelay().address;
  room.cluster.RunToTick(120);
  const auto& bob = room.AddClient(at, "bob", false);
  room.cluster.RunToTick(400);
  EXPECT_EQ(bob.client->server(), room.cluster.server_address());
  EXPECT_TRUE(bob.client->running());
  EXPECT_EQ(room.cluster.server().player_count(), 2);
  EXPECT_EQ(room.spots[0]->relay->watchers().count(), 0);
}

TEST(RelayUpstream, APlayerIsSentToTheAddressThatTheOperatorNames) {
  ClusterConfig config = Crossing();
  config.players = 1;
  RelayedRoom room(config);
  RelayConfig relay;
  relay.play_at = "10.1.2.3:7777";
  const Address at = room.AddRelay(relay).address;
  room.cluster.RunToTick(120);
  const auto& bob = room.AddClient(at, "bob", false);
  room.cluster.RunToTick(160);
  EXPECT_EQ(ToString(bob.client->server()), "10.1.2.3:7777");
}

TEST(RelayUpstream, AClientThatIsNoPlayerAndDoesNotWatchIsToldWhereToPlay) {
  RelayedRoom room(Crossing());
  const Address at = room.AddRelay().address;
  room.cluster.RunToTick(120);
  const auto& zed = room.AddClient(at, "zed", false);
  room.cluster.RunToTick(400);
  EXPECT_EQ(zed.client->fatal(),
            "there is no player \"zed\" here; this relay takes watchers "
            "alone, play at 127.0.0.1:7777; --watch only looks on");
}

TEST(RelayUpstream, ARelayMayWatchARelay) {
  RelayedRoom room(Crossing());
  const Address first = room.AddRelay().address;
  room.cluster.RunToTick(120);
  const Address second = room.AddRelay({}, &first).address;
  const auto& seat = room.AddClient(second, "wanda");
  room.cluster.RunToTick(400);
  ASSERT_TRUE(seat.client->running());
  EXPECT_GT(seat.client->replica()->tick(), 360);
}

TEST(RelayUpstream, OneWatcherMoreThanThereIsRoomForIsRefused) {
  RelayedRoom room(Crossing());
  RelayConfig relay;
  relay.limits.watchers = 1;
  const Address at = room.AddRelay(relay).address;
  room.cluster.RunToTick(120);
  const auto& first = room.AddClient(at, "wanda");
  room.cluster.RunToTick(240);
  const auto& second = room.AddClient(at, "walt");
  room.cluster.RunToTick(600);
  EXPECT_TRUE(first.client->running());
  EXPECT_EQ(second.client->fatal(), "the server refuses: the relay is full: it takes 1 watchers");
}

TEST(RelayUpstream, ARoomWhosePeersSendInputsAloneIsNotPassedOn) {
  ClusterConfig config = Crossing();
  config.mode = "lockstep";
  RelayedRoom room(config);
  const auto& spot = room.AddRelay();
  room.cluster.RunToTick(240);
  EXPECT_NE(spot.relay->fatal().find("mode lockstep"), std::string::npos) << spot.relay->fatal();
}

TEST(RelayUpstream, WatchersMayComeBeforeTheRoomStarts) {
  RelayedRoom room(Crossing());
  room.cluster.Kill(1);  // the room waits for it
  const Address at = room.AddRelay().address;
  const auto& seat = room.AddClient(at, "wanda");
  bool waited = false;
  room.each_instant = [&] {
    if (waited || room.cluster.now_us() < 5000000) return;
    waited = true;
    EXPECT_TRUE(seat.client->waits_for_start());
    EXPECT_EQ(room.spots[0]->relay->watchers().ready(), 1);
    room.cluster.Revive(1);
  };
  room.cluster.RunToTick(120);
  EXPECT_TRUE(waited);
  ASSERT_TRUE(seat.client->running());
  EXPECT_GT(seat.client->replica()->tick(), 100);
}

}  // namespace relay_upstream_test
}  // namespace seam
