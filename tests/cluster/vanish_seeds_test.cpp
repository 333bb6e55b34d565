/// A holder is killed or cut off, in rooms of several kinds and over networks drawn from seeds:
/// what it had stands nowhere for longer than 0.3 s, and jumps nowhere by more than half a metre.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "common/base/random.h"
#include "tests/lab/cluster.h"
#include "tests/support/soak.h"
#include "tests/support/soak/cut_net.h"

namespace seam {
namespace {

constexpr int kSeeds = 4, kSeedsSoak = 20;
constexpr double kSpeed = 6;  // m/s
/// Of the holder's last state, s, and m.
constexpr double kStandsMax = 0.3, kJumpMax = 0.5;

/// Ann's disc goes by; bob looks on.
const char* const kPlayers = R"(
duration = 20
buffer = 2
follow = 0
[[player]]
name = "ann"
vehicle = "disc"
[[player]]
name = "bob"
region = [[400, -100], [900, 100]]
)";
const char* const kDisc = R"(
[[part]]
name = "disc"
circle = 0.5
position = [0, 0.5]
velocity = [6, 0]
friction = 0
owner = "ann"
)";
/// Nothing else; so many bodies that the server simulates only what its own may meet; a cart of two
/// that turns about its middle; on a floor.
const char* const kAlone = "gravity = [0, 0]\nserver_follow = 0\n";
const char* const kCrowd = R"(
[[part]]
name = "pebble"
circle = 0.2
position = [-20, 20]
repeat = {count = [20, 15], step = [3, 3]}
)";
const char* const kCart = R"(
[[part]]
name = "mate"
circle = 0.5
position = [0, 2]
velocity = [6, 0]
owner = "ann"
[[joint]]
name = "bar"
kind = "distance"
a = "disc"
b = "mate"
anchor_a = [0, 0.5]
anchor_b = [0, 2]
)";
const char* const kFloor = R"(
[[part]]
name = "floor"
box = [400, 2]
position = [150, -1]
anchored = true
friction = 0
)";

struct Kind {
  const char* name;
  std::string scene;
};

std::vector<Kind> Kinds() {
  const std::string players = kPlayers, alone = kAlone, still = "gravity = [0, 0]\n";
  return {{"alone", alone + players + kDisc},
          {"crowd", still + players + kDisc + kCrowd},
          {"cart", alone + players + kDisc + kCart},
          {"floor", "server_follow = 0\n" + players + kDisc + kFloor}};
}

struct Figures {
  double stands_s = 0, jump_m = 0;
  int looked = 0;
};

/// From the fault on, in the views of the server and of bob.
Figures LookAt(const std::map<std::int64_t, View>& views, PartId id, std::int64_t from) {
  Figures figures;
  int standing = 0;
  float before = 0;
  bool has_before = false;
  for (auto it = views.find(from); it != views.end(); ++it) {
    const View& view = it->second;
    const auto found = std::find(view.id.begin(), view.id.end(), id);
    if (found == view.id.end()) continue;
    const float x = view.x[static_cast<std::size_t>(found - view.id.begin())];
    const double way = double{x} - double{before};
    if (std::exchange(has_before, true)) {
      ++figures.looked;
      standing = way < 0.2 * kSpeed / 60 ? standing + 1 : 0;
      figures.stands_s = std::max(figures.stands_s, standing / 60.0);
      figures.jump_m = std::max(figures.jump_m, std::fabs(way - kSpeed / 60));
    }
    before = x;
  }
  return figures;
}

Figures Vanish(const Kind& kind, std::uint64_t seed) {
  Random random(seed);
  const bool killed = random.Chance(0.5);
  char network[80];
  std::snprintf(network, sizeof network, "delay=%dms,jitter=%dms,loss=%d%%",
                20 + static_cast<int>(random.Next() % 81), static_cast<int>(random.Next() % 16),
                static_cast<int>(random.Next() % 11));
  const auto at = static_cast<std::int64_t>(120 + random.Next() % 60);
  bool cut = false;
  ClusterConfig config;
  config.scene = kind.name;
  config.scene_text = kind.scene;
  config.impair = network;
  config.seed = static_cast<std::int64_t>(seed);
  config.drive = Drive::kNone;
  config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    if (client != 0) return net;
    return std::make_unique<CutNet>(std::move(net), &cut);
  };
  Cluster cluster(config);
  cluster.RunToTick(at);
  const PartId disc = cluster.scene().players[0].vehicle;
  const World& world = cluster.server().replica().world();
  const int mechanism = world.mechanism(world.BodyOfId(disc));
  EXPECT_EQ(cluster.server().replica().authority().at(mechanism).authority,
            cluster.client(0)->peer())
      << kind.name;
  const int bob = cluster.client(1)->peer();
  if (killed) {
    cluster.Kill(0);
  } else {
    cut = true;
  }
  cluster.RunToTick(at + 6 * 60);
  Figures worst;
  for (const int peer : {0, bob}) {
    const Figures now = LookAt(cluster.recording().views.at(peer), disc, at);
    worst.stands_s = std::max(worst.stands_s, now.stands_s);
    worst.jump_m = std::max(worst.jump_m, now.jump_m);
    EXPECT_GT(now.looked, 5 * 60);
  }
  return worst;
}

TEST(VanishCluster, NothingStandsOrJumpsWhoeverVanishesWherever) {
  const int seeds = Soak(kSeeds) > kSeeds ? kSeedsSoak : kSeeds;
  for (const Kind& kind : Kinds()) {
    Figures worst;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Figures now = Vanish(kind, static_cast<std::uint64_t>(seed));
      EXPECT_LE(now.stands_s, kStandsMax) << kind.name << ", seed " << seed;
      EXPECT_LE(now.jump_m, kJumpMax) << kind.name << ", seed " << seed;
      worst.stands_s = std::max(worst.stands_s, now.stands_s);
      worst.jump_m = std::max(worst.jump_m, now.jump_m);
    }
    std::printf("  %-6s %d seeds: stands for %.3f s, jumps by %.3f m\n", kind.name, seeds,
                worst.stands_s, worst.jump_m);
  }
}

}  // namespace
}  // namespace seam
