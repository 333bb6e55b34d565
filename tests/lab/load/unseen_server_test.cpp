/// A server whose view nobody watches does not simulate the clients' bodies in a small room, and no
/// client's view gets worse, even if a holder falls silent for a moment.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "common/scene/scene.h"

namespace seam {
namespace unseen_server_test {

/// Two discs, each a player's, that pass each other.
const char* const kTwo = R"(
gravity = [0, 0]
duration = 2
[[player]]
name = "ann"
vehicle = "disc.0"
[[player]]
name = "bob"
vehicle = "disc.1"
[[part]]
name = "disc"
circle = 0.5
velocity = [1, 0]
repeat = {count = 2, step = [0, 8]}
)";

/// Bodies of clients that the server follows, and bodies that are present in its world, at the end.
std::vector<int> FollowsAndHas(Publish publish, bool keep) {
  ClusterConfig config;
  config.scene = "two";
  config.scene_text = kTwo;
  config.drive = Drive::kNone;
  config.publish = publish;
  config.keep = keep;
  Cluster cluster(config);
  cluster.Run();
  const Replica& server = cluster.server().replica();
  std::vector<int> counts = {0, 0};
  for (int body = 0; body < server.world().body_count(); ++body) {
    const AuthorityRecord& record = server.authority().at(server.world().mechanism(body));
    EXPECT_GT(record.authority, 0) << "a client has it";
    counts[0] += record.secondaries.Has(0) ? 1 : 0;
    counts[1] += IsPresent(server.world().activity(body)) ? 1 : 0;
  }
  return counts;
}

TEST(UnseenServer, SimulatesNoBodyThatAClientHolds) {
  const std::vector<int> all = {2, 2}, nothing = {0, 0};
  EXPECT_EQ(FollowsAndHas(Publish::kAll, true), all) << "its view is as good as a player's";
  EXPECT_EQ(FollowsAndHas(Publish::kNone, true), nothing) << "it shows nothing";
  EXPECT_EQ(FollowsAndHas(Publish::kAll, false), nothing) << "nobody listens";
}

/// Two sleds that their players drive past piles of crates, 6 m from each and 20 m apart.
const char* const kPlain = R"(
duration = 6
server_follow = 0
follow = 0
buffer = 4
[[player]]
name = "p"
repeat = {count = 2, step = [20, 0]}
vehicle = "sled.0"
script = [[0.0, {}], [0.5, {drive = 0.5}], [2.0, {drive = -0.5}], [3.5, {}]]
[[part]]
name = "ground"
chain = [[-90, 20], [-90, 0], [290, 0], [290, 20]]
friction = 0.5
[[part]]
name = "sled"
box = [2, 0.5]
position = [0, 0.26]
friction = 0.6
conveyor = {player = "p-0", speed = 1}
owners = ["p-*"]
repeat = {count = 2, step = [20, 0]}
[[part]]
name = "crate"
box = [0.7, 0.7]
position = [6, 0.36]
density = 0.5
repeat = {count = [8, 2], step = [20, 0.71]}
)";

/// Bodies at rest are the server's, which loads them only when one of its own may touch them.
TEST(UnseenServer, HasNoRestingBodyInItsWorld) {
  ClusterConfig config;
  config.scene = "plain";
  config.scene_text = kPlain;
  config.publish = Publish::kNone;
  config.keep = false;
  Cluster cluster(config);
  cluster.Run();
  const Replica& server = cluster.server().replica();
  int own = 0, sleds = 0;
  for (int body = 0; body < server.world().body_count(); ++body) {
    const int authority = server.authority().at(server.world().mechanism(body)).authority;
    (authority == 0 ? own : sleds) += 1;
  }
  EXPECT_EQ(own, 16) << "all crates";
  EXPECT_EQ(sleds, 2);
  EXPECT_TRUE(server.world().present().empty());
}

/// Error of other players' bodies on the clients' screens, m.
double ErrorOfOthers(const std::string& text, int seed) {
  ClusterConfig config;
  config.scene = "obstacle";
  config.scene_text = text;
  config.impair = "4g";
  config.seed = seed;
  const Recording recording = RunCluster(config);
  return Measure(recording, ComputeOracle(recording, WithBarriers(recording.room)))
      .error_others_m.value_or(1e9);
}

/// Bursts of losses make holders silent for longer than 0.2 s. A server that only then begins to
/// simulate a character, from its last state, does not know its gait phase: its states in the
/// holder's name made peers that had simulated it all along err two to five times as much.
TEST(UnseenServer, SendsNoStatesForASilentHolderToBetterInformedFollowers) {
  const std::string text = LoadScene("scenes/obstacle.toml").text;
  for (const int seed : {1, 2, 3}) {
    const double followed = ErrorOfOthers(text, seed);
    const double unseen = ErrorOfOthers("server_follow = 0\n" + text, seed);
    EXPECT_LT(unseen, 1.3 * followed) << "seed " << seed;
  }
}

/// Final positions of every body at every client.
std::vector<Vec2> ClientsEnd(const std::string& scene, int seed, bool listening) {
  ClusterConfig config;
  config.scene = scene;
  config.scene_text = LoadScene("scenes/" + scene + ".toml").text;
  config.impair = "4g";
  config.seed = seed;
  config.publish = Publish::kNone;
  config.keep = listening;
  Cluster cluster(config);
  cluster.Run();
  std::vector<Vec2> places;
  for (int i = 0; i < cluster.client_count(); ++i) {
    const World& world = cluster.client(i)->replica()->world();
    for (int body = 0; body < world.body_count(); ++body) {
      places.push_back(world.Read(body).position);
    }
  }
  return places;
}

/// Clients reach the same bits with and without a listener on a bus without views.
TEST(UnseenServer, ABusWithoutViewsChangesNoBitsOfClients) {
  for (const char* scene : {"crossing", "obstacle", "heap"}) {
    for (const int seed : {1, 2}) {
      EXPECT_TRUE(ClientsEnd(scene, seed, true) == ClientsEnd(scene, seed, false))
          << scene << " seed " << seed;
    }
  }
}

/// Largest distance between the server's view and its world for mechanisms of one body, m: caused
/// by smoothing, and slightly by closing joints to anchored bodies.
float MostHidden(Publish publish, bool keep) {
  ClusterConfig config;
  config.scene = "heap";
  config.scene_text = LoadScene("scenes/heap.toml").text;
  config.impair = "4g";
  config.publish = publish;
  config.keep = keep;
  Cluster cluster(config);
  const Replica& server = cluster.server().replica();
  const World& world = server.world();
  std::vector<int> bodies(world.composition().mechanisms.size(), 0);
  for (int body = 0; body < world.body_count(); ++body) {
    ++bodies[static_cast<std::size_t>(world.mechanism(body))];
  }
  float most = 0;
  for (std::int64_t tick = 60; tick <= 360; tick += 5) {
    cluster.RunToTick(tick);
    const View view = server.MakeView();
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      const int body = world.BodyOfId(view.id[i]);
      if (bodies[static_cast<std::size_t>(world.mechanism(body))] > 1) continue;
      most = std::max(most, (Vec2(view.x[i], view.y[i]) - world.Read(body).position).norm());
    }
  }
  return most;
}

TEST(UnseenServer, SmoothsNoViewsThatNobodyReceives) {
  EXPECT_GT(MostHidden(Publish::kAll, true), 0.01f);
  EXPECT_LT(MostHidden(Publish::kNone, true), 0.001f) << "it shows nothing";
  EXPECT_LT(MostHidden(Publish::kAll, false), 0.001f) << "nobody listens";
}

}  // namespace unseen_server_test
}  // namespace seam
