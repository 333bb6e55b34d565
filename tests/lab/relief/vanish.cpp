#include "tests/lab/relief/vanish.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "client/embed/cluster.h"
#include "common/base/random.h"
#include "tests/lab/relief/relief_scene.h"
#include "tests/support/soak/cut_net.h"

namespace seam {
namespace {

constexpr double kSpeed = 6;  // m/s, of the disc

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

}  // namespace

std::vector<VanishKind> VanishKinds() {
  const std::string players = kPlayers, alone = kAlone, still = "gravity = [0, 0]\n";
  ReliefRoom cars;
  cars.players = 4;
  cars.each = 15;
  cars.spacing = 14;
  return {{"alone", alone + players + kDisc},
          {"crowd", still + players + kDisc + kCrowd},
          {"cart", alone + players + kDisc + kCart},
          {"floor", "server_follow = 0\n" + players + kDisc + kFloor},
          {"cars", ReliefText(cars), true}};
}

namespace {

/// From the fault on, a body in a view.
Vanished LookAt(const std::map<std::int64_t, View>& views, PartId id, std::int64_t from) {
  Vanished figures;
  int standing = 0, known = 0;
  Vec2 before{0, 0}, way_before{0, 0};
  for (auto it = views.find(from); it != views.end(); ++it) {
    const View& view = it->second;
    const auto found = std::find(view.id.begin(), view.id.end(), id);
    if (found == view.id.end()) continue;
    const auto i = static_cast<std::size_t>(found - view.id.begin());
    const Vec2 at(view.x[i], view.y[i]), way = at - before;
    if (known > 1) {
      ++figures.looked;
      standing = way.x() < 0.2 * kSpeed / 60 ? standing + 1 : 0;
      figures.stands_s = std::max(figures.stands_s, standing / 60.0);
      figures.jump_m = std::max(figures.jump_m, double{(way - way_before).norm()});
    }
    ++known;
    before = at;
    way_before = way;
  }
  return figures;
}

}  // namespace

Vanished Vanish(const VanishKind& kind, std::uint64_t seed) {
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
  config.drive = kind.driven ? Drive::kBot : Drive::kNone;
  config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    if (client != 0) return net;
    return std::make_unique<CutNet>(std::move(net), &cut);
  };
  Cluster cluster(config);
  cluster.RunToTick(at);
  const Replica& server = cluster.server().replica();
  const World& world = server.world();
  const auto held = [&](int body) {
    return server.authority().at(world.mechanism(body)).authority == cluster.client(0)->peer();
  };
  const PartId vehicle = cluster.scene().players[0].vehicle;
  Vanished worst;
  worst.held = held(world.BodyOfId(vehicle));
  worst.looked = std::numeric_limits<int>::max();
  std::vector<PartId> ids = {vehicle};
  for (int body = 0; kind.driven && body < world.body_count(); ++body) {
    if (held(body)) ids.push_back(world.id(body));
  }
  const int other = cluster.client(1)->peer();
  if (killed) {
    cluster.Kill(0);
  } else {
    cut = true;
  }
  cluster.RunToTick(at + 6 * 60);
  for (const int peer : {0, other}) {
    for (const PartId id : ids) {
      const Vanished now = LookAt(cluster.recording().views.at(peer), id, at);
      if (!kind.driven) worst.stands_s = std::max(worst.stands_s, now.stands_s);
      worst.jump_m = std::max(worst.jump_m, now.jump_m);
      worst.looked = std::min(worst.looked, now.looked);
    }
  }
  return worst;
}

}  // namespace seam
