/// Watchers behind a relay see the room as watchers at its server do, a little later.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "common/codec/wire_body.h"
#include "server/relay/relay.h"
#include "server/rules/rules.h"
#include "tests/relay/relayed_room.h"
#include "tests/support/soak.h"

namespace seam {
namespace relayed_views_test {

/// Shown positions by tick and body.
using Film = std::map<std::int64_t, std::map<PartId, Vec2>>;

void Shoot(const Client* client, Film* film) {
  if (client == nullptr || !client->running()) return;
  const View view = client->replica()->MakeView();
  for (std::size_t i = 0; i < view.id.size(); ++i) {
    (*film)[view.tick][view.id[i]] = Vec2(view.x[i], view.y[i]);
  }
}

void Shoot(const Server& server, Film* film) {
  const World& world = server.replica().world();
  for (int body = 0; body < world.body_count(); ++body) {
    (*film)[server.tick()][world.id(body)] = world.Read(body).position;
  }
}

/// Distances of bodies that both show at the same ticks, m, ascending.
std::vector<double> Between(const Film& a, const Film& b, std::int64_t from) {
  std::vector<double> all;
  for (const auto& [tick, poses] : a) {
    const auto other = b.find(tick);
    if (tick < from || other == b.end()) continue;
    for (const auto& [id, at] : poses) {
      const auto there = other->second.find(id);
      if (there != other->second.end()) all.push_back(double{(at - there->second).norm()});
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

double Mean(const std::vector<double>& all) {
  double sum = 0;
  for (const double one : all) sum += one;
  return all.empty() ? -1 : sum / static_cast<double>(all.size());
}

/// Share of the distances that are below the wire's rounding.
double Equal(const std::vector<double>& all) {
  const auto end = std::upper_bound(all.begin(), all.end(), 1.0 / kQuantaPerMetre);
  return static_cast<double>(end - all.begin()) / static_cast<double>(all.size());
}

/// Keeps all states that a client is told.
struct Told : ClientTap {
  using Key = std::pair<std::int64_t, std::int32_t>;  // tick, body
  using Value = std::tuple<std::uint32_t, std::uint32_t, std::int16_t, std::int16_t, std::int16_t,
                           std::int16_t, std::int8_t, std::int32_t>;
  void OnRoom() override {}
  void OnMessage(const AnyMessage&, ByteView) override {}
  void OnStates(const States& states) override {
    for (std::size_t i = 0; i < states.id.size(); ++i) {
      const WireBody b = BodyAt(states, i);
      all[{states.tick, b.id}] = {b.x, b.y, b.angle, b.vx, b.vy, b.spin, b.flags, b.epoch};
    }
  }
  std::map<Key, Value> all;
};

ClusterConfig Bots(const std::string& scene, const std::string& impair, std::int64_t seed = 1) {
  ClusterConfig config;
  config.scene = scene;
  config.impair = impair;
  config.seed = seed;
  config.drive = Drive::kBot;
  config.keep = false;
  return config;
}

/// A watcher at the server that looks as late as a relay does, and one behind a relay.
struct Pair {
  /// `listens`: told_behind is filled. That watcher is then late by as much again.
  Pair(const ClusterConfig& config, bool listens) : room(config) {
    const Address at = room.AddRelay().address;
    direct = &room.AddClient(room.cluster.server_address(), "willa", true, &told_direct);
    behind = &room.AddClient(at, "wanda", true, listens ? &told_behind : nullptr);
    room.each_instant = [this] {
      Shoot(direct->client.get(), &direct_film);
      Shoot(behind->client.get(), &behind_film);
    };
  }
  Told told_direct, told_behind;
  Film direct_film, behind_film;
  RelayedRoom room;
  RelayedRoom::Seat* direct = nullptr;
  RelayedRoom::Seat* behind = nullptr;
};

// The relay itself extrapolates for those who join late alone, and no watcher does here.
TEST(RelayedViews, TheStatesOfAWatcherAreTheServersBitForBit) {
  for (const char* scene : {"arena", "train"}) {
    for (const char* impair : {"perfect", "4g"}) {
      Pair pair(Bots(scene, impair), true);
      pair.room.cluster.RunToTick(600);
      const auto& direct = pair.told_direct.all;
      const auto& behind = pair.told_behind.all;
      std::size_t both = 0, unlike = 0, after = 0;
      // Before, each is sent the world of the moment in which it got ready.
      constexpr std::int64_t kFrom = 120, kTo = 560;
      for (const auto& [key, value] : direct) {
        if (key.first < kFrom || key.first > kTo) continue;
        ++after;
        const auto found = behind.find(key);
        both += found != behind.end() ? 1 : 0;
        unlike += found != behind.end() && found->second != value ? 1 : 0;
      }
      ASSERT_GT(after, 400u) << scene;
      EXPECT_EQ(unlike, 0u) << scene << " " << impair;
      const double share = static_cast<double>(both) / static_cast<double>(after);
      std::printf("[          ] %s, %s: %zu states, %.2f %% of them behind the relay\n", scene,
                  impair, after, 100 * share);
      EXPECT_GE(share, std::string(impair) == "perfect" ? 1 : 0.8) << scene;
    }
  }
}

TEST(RelayedViews, AWatcherShowsWhatOneAtTheServerShowsThatLooksAsLate) {
  for (const char* scene : {"crossing", "arena", "gluehouse", "train"}) {
    Pair pair(Bots(scene, "perfect"), false);
    pair.room.cluster.RunToTick(600);
    const std::vector<double> off = Between(pair.direct_film, pair.behind_film, 120);
    ASSERT_GT(off.size(), 1000u);
    std::printf("[          ] %s: %zu poses, %.2f %% equal, mean %.6f m, worst %.4f\n", scene,
                off.size(), 100 * Equal(off), Mean(off), off.back());
    EXPECT_GT(Equal(off), 0.98) << scene;
    EXPECT_LT(off.back(), 0.1) << scene;
  }
}

// Over a bad path no two watchers show the same; the relay is late enough to have most states.
TEST(RelayedViews, AWatcherIsNoFartherFromTheRoomThanOneAtTheServer) {
  std::int64_t again = 0;
  for (const char* scene : {"crossing", "arena", "train"}) {
    double direct_m = 0, behind_m = 0, late = 0, instants = 0;
    for (const int seed : SoakSeeds(1, 3)) {
      RelayedRoom room(Bots(scene, "4g", seed));
      const Address at = room.AddRelay().address;
      auto& direct = room.AddClient(room.cluster.server_address(), "willa");
      auto& behind = room.AddClient(at, "wanda");
      Film real, direct_film, behind_film;
      room.each_instant = [&] {
        Shoot(room.cluster.server(), &real);
        Shoot(direct.client.get(), &direct_film);
        Shoot(behind.client.get(), &behind_film);
        if (room.cluster.server().tick() < 120 || !behind.client->running()) return;
        late += static_cast<double>(direct.client->replica()->tick() -
                                    behind.client->replica()->tick());
        instants += 1;
      };
      room.cluster.RunToTick(600);
      ASSERT_GT(instants, 100);
      direct_m += Mean(Between(direct_film, real, 120));
      behind_m += Mean(Between(behind_film, real, 120));
      EXPECT_LT(room.spots[0]->relay->client().lag_us(), 200000);
      again += room.spots[0]->relay->composed_again();
    }
    std::printf(
        "[          ] %s, 4g: mean distance from the server's bodies %.3f m at the "
        "server, %.3f m behind the relay; %.1f ticks later\n",
        scene, direct_m, behind_m, late / instants);
    EXPECT_LT(behind_m, 1.1 * direct_m) << scene;
    EXPECT_LT(late / instants, 12) << scene;
  }
  EXPECT_GT(again, 0) << "lost states without a later one are told again";
}

TEST(RelayedViews, RestIsToldWithoutAskingForIt) {
  RelayedRoom room(Bots("stack", "perfect"));
  const Address at = room.AddRelay().address;
  const auto& seat = room.AddClient(at, "wanda");
  int compared = 0;
  std::uint64_t hash = 0;
  for (int n = 0; n < 60; ++n) {
    room.Run(10);
    const std::uint64_t now = room.cluster.server().replica().rest().Hash();
    if (now != 0 && now == hash && seat.client->running()) {
      ++compared;
      EXPECT_EQ(seat.client->replica()->rest().Hash(), now) << "10 ticks later";
    }
    hash = now;
  }
  EXPECT_GT(compared, 0);
}

/// The scene crossing with a fog that wears out the first car.
std::string Fog() {
  std::string text = LoadScene("scenes/crossing.toml").text;
  const std::string car = "name = \"car\"\n";
  text.insert(text.find(car) + car.size(), "health = 100\n");
  return text +
         "[[trigger]]\nname = \"fog\"\nkind = \"hazard\"\nposition = [0, 0]\nbox = [500, 500]\n"
         "health = 50\n";
}

TEST(RelayedViews, EditsRestAndScoresAreTheServers) {
  std::size_t values = 0;
  for (const char* scene : {"crossing", "gluehouse"}) {
    for (const char* impair : {"perfect", "4g"}) {
      ClusterConfig config = Bots(scene, impair);
      if (std::string(scene) == "crossing") config.scene_text = Fog();
      RelayedRoom room(config);
      const Address at = room.AddRelay().address;
      const auto& early = room.AddClient(at, "wanda");
      room.cluster.RunToTick(400);
      const auto& late = room.AddClient(at, "walt");  // after edits and scores
      room.cluster.RunToTick(900);
      const Replica& real = room.cluster.server().replica();
      EXPECT_GE(real.revision(), std::string(scene) == "gluehouse" ? 1 : 0);
      for (const auto* seat : {&early, &late}) {
        ASSERT_TRUE(seat->client->running());
        const Replica& shown = *seat->client->replica();
        EXPECT_EQ(shown.revision(), real.revision()) << scene << impair;
        EXPECT_EQ(shown.world().composition().hash, real.world().composition().hash);
        EXPECT_EQ(shown.rest().Hash(), real.rest().Hash()) << scene << impair;
        if (const Rules* const rules = room.cluster.server().rules()) {
          values += rules->metadata().values().size();
          EXPECT_EQ(seat->client->metadata().values(), rules->metadata().values()) << scene;
        }
        for (int m = 0; m < real.authority().count(); ++m) {
          EXPECT_EQ(shown.authority().at(m).authority, real.authority().at(m).authority);
        }
      }
    }
  }
  EXPECT_GT(values, 0u) << "there are scores";
}

}  // namespace relayed_views_test
}  // namespace seam
