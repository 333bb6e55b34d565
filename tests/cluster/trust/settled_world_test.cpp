/// Clients that come into a room that runs, or whose copies have parted: a settled world makes them
/// the server's to the last bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "client/embed/cluster.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/method.h"
#include "server/trust/trust_ladder.h"
#include "tests/support/replica_test_access.h"
#include "tests/support/wired_replicas.h"

namespace seam {
namespace settled_world_test {

ClusterConfig Bots(const std::string& scene, const std::string& impair) {
  ClusterConfig config;
  config.scene = scene;
  config.impair = impair;
  config.drive = Drive::kBot;
  config.trust = TrustMode::kAct;
  return config;
}

/// Compares the clients' copies with the server's, of ticks that nothing can change any more.
class Comparison {
 public:
  explicit Comparison(Cluster& cluster) : cluster_(cluster) {
    cluster.each_instant = [this] { Look(); };
  }
  /// Of all looks since the last call.
  int TakeDiffering() { return std::exchange(differing_, 0); }
  int TakeCompared() { return std::exchange(compared_, 0); }
  int step() const { return step_; }  ///< highest TrustStep of any player

 private:
  void Look() {
    const Server& server = cluster_.server();
    if (!server.started() || server.tick() == looked_) return;
    looked_ = server.tick();
    for (int p = 0; p < 2; ++p) step_ = std::max(step_, static_cast<int>(server.ladder().step(p)));
    for (int i = 0; i < 2; ++i) {
      const Client* const client = cluster_.client(i);
      if (client == nullptr || client->replica() == nullptr || !client->running()) continue;
      Compare(server.replica(), *client->replica());
    }
  }
  void Compare(const Replica& truth, const Replica& copy) {
    const std::int64_t tick = truth.tick() - 60;
    if (copy.revision() != truth.revision()) return;
    for (int body = 0; body < truth.world().body_count(); ++body) {
      const BodyState* const there = truth.SettledPast(body, tick);
      const BodyState* const here = copy.SettledPast(body, tick);
      if (there == nullptr || here == nullptr) continue;
      ++compared_;
      differing_ += std::memcmp(there, here, sizeof *there) == 0 ? 0 : 1;
    }
  }

  Cluster& cluster_;
  std::int64_t looked_ = -1;
  int differing_ = 0, compared_ = 0, step_ = 0;
};

void ComeBack(Cluster& cluster) {
  for (int i = 0; i < 2; ++i) cluster.Leave(i);
  cluster.RunToTick(cluster.server().tick() + 20);
  for (int i = 0; i < 2; ++i) cluster.Revive(i);
}

class SettledWorldOver : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Networks, SettledWorldOver, ::testing::Values("perfect", "4g", "3g"));

TEST_P(SettledWorldOver, PlayersWhoComeBackHaveTheServersBits) {
  for (const char* scene : {"crossing", "scrum", "arena"}) {
    Cluster cluster(Bots(scene, GetParam()));
    Comparison comparison(cluster);
    cluster.RunToTick(264);
    EXPECT_EQ(comparison.TakeDiffering(), 0) << scene << ": before they leave";
    EXPECT_GT(comparison.TakeCompared(), 100) << scene;
    ComeBack(cluster);
    cluster.RunToTick(720);
    comparison.TakeDiffering();
    comparison.TakeCompared();
    cluster.RunToTick(960);
    const int compared = comparison.TakeCompared();
    EXPECT_GT(compared, 100) << scene;
    // Where inputs come later than replays reach, copies part for a moment now and then.
    const bool late = GetParam() == std::string("3g");
    EXPECT_LE(comparison.TakeDiffering(), late ? compared / 20 : 0) << scene;
    EXPECT_LE(comparison.step(), static_cast<int>(TrustStep::kWatched)) << scene;
  }
}

/// Two sledges with a tower of boxes between, which both push; and a box that nobody is near to.
/// Nothing sleeps: being at rest has rules of its own.
constexpr char kTower[] = R"(
[solver]
sleep = false
[[player]]
name = "ann"
vehicle = "hers"
[[player]]
name = "bob"
vehicle = "his"
[[part]]
name = "floor"
chain = [[-90, 0], [90, 0]]
friction = 0.5
[[part]]
name = "hers"
box = [1, 1]
position = [-1.6, 0.5]
owner = "ann"
density = 2
[[part]]
name = "his"
box = [1, 1]
position = [1.6, 0.5]
owner = "bob"
density = 2
[[part]]
name = "low"
box = [1, 1]
position = [0, 0.5]
[[part]]
name = "top"
box = [1.2, 1]
position = [0.1, 1.5]
[[part]]
name = "far"
box = [1, 1]
position = [40, 0.5]
[[thrust]]
name = "jet-a"
part = "hers"
force = [30, 0]
player = "ann"
[[thrust]]
name = "jet-b"
part = "his"
force = [30, 0]
player = "bob"
)";

class SettledWorldOfReplicas : public ::testing::Test {
 protected:
  SettledWorldOfReplicas() {
    replicas_.states_flow = false;
  }  // nothing else brings copies together
  static Input Push(int peer, std::int64_t tick) {
    Input input;
    input.drive = static_cast<std::int8_t>(peer == 1 ? 90 : -60);
    if (tick % 50 > 40) input.drive = 0;
    return input;
  }
  void MoveTop(int peer) {
    const int top = replicas_.Body(peer, "top");
    BodyState state = replicas_.Read(peer, "top");
    state.position.x() += 0.05f;
    ReplicaTestAccess::world(replicas_.at(peer)).Write(top, state);
  }
  Bytes World() {
    const Replica& server = replicas_.at(0);
    return server.SettledWorld(server.tick() - 10, server.tick() - 2);
  }
  int Differing(int peer) {
    const std::int64_t tick = replicas_.at(0).tick() - 20;
    int differing = 0;
    for (int body = 0; body < replicas_.at(0).world().body_count(); ++body) {
      const BodyState* const there = replicas_.at(0).SettledPast(body, tick);
      const BodyState* const here = replicas_.at(peer).SettledPast(body, tick);
      EXPECT_TRUE(there != nullptr && here != nullptr) << body;
      if (there == nullptr || here == nullptr) return -1;
      differing += std::memcmp(there, here, sizeof *there) == 0 ? 0 : 1;
    }
    return differing;
  }

  WiredReplicas replicas_{ParseScene(kTower, "tower.toml"), MakeSyncConfig("buffer", "rollback"), 3,
                          Push};
};

TEST_F(SettledWorldOfReplicas, MakesACopyThatHasPartedTheSame) {
  replicas_.StepTo(60);
  EXPECT_EQ(Differing(2), 0);
  MoveTop(2);
  replicas_.StepTo(90);
  EXPECT_GT(Differing(2), 0);
  ASSERT_FALSE(World().empty());
  const Status status = replicas_.at(2).TakeWorld(World());
  EXPECT_TRUE(status.ok()) << status.why();
  replicas_.StepTo(150);
  EXPECT_EQ(Differing(2), 0);
  EXPECT_EQ(Differing(1), 0);
}

TEST_F(SettledWorldOfReplicas, ChangesNothingInACopyThatIsTheSame) {
  replicas_.StepTo(90);
  ASSERT_TRUE(replicas_.at(2).TakeWorld(World()).ok());
  replicas_.StepTo(150);
  EXPECT_EQ(Differing(2), 0);
}

TEST_F(SettledWorldOfReplicas, LeavesACopyAloneWhoseEditsAreOthers) {
  replicas_.StepTo(90);
  const Bytes world = World();
  EditOrder order = ToOrder(Edit(BlastEdit{Vec2(60, 0), 1, 0, 0}));
  order.number = replicas_.at(2).revision();
  order.tick = 90;
  ASSERT_TRUE(replicas_.at(2).Queue(order));
  replicas_.StepTo(105);  // inputs change at tick 100
  MoveTop(2);
  ASSERT_TRUE(replicas_.at(2).TakeWorld(world).ok());
  replicas_.StepTo(135);
  EXPECT_GT(Differing(2), 0);
}

TEST_F(SettledWorldOfReplicas, IsRefusedOrHarmlessWhereAByteIsWrong) {
  replicas_.StepTo(60);
  const Bytes world = World();
  ASSERT_FALSE(world.empty());
  int refused = 0;
  for (std::size_t at = 0; at < world.size(); ++at) {
    Bytes changed = world;
    changed[at] ^= static_cast<std::uint8_t>(1 + at * 37 % 255);
    refused += replicas_.at(2).TakeWorld(changed).ok() ? 0 : 1;
    replicas_.Step();  // stepped again from there
    EXPECT_FALSE(replicas_.at(2).TakeWorld(ByteView(world.data(), at)).ok()) << at;
  }
  EXPECT_GT(refused, 100);
  EXPECT_FALSE(replicas_.at(2).TakeWorld(Bytes()).ok());
}

/// Ann's button kicks his sledge, which his client has. It hears of it only after it was given a
/// world in which the kick has acted.
TEST(SettledWorld, APressFromBeforeItThatIsHeardAfterItDoesNotActAgain) {
  std::string text = kTower;
  const std::string of = "vehicle = \"hers\"\n";
  text.insert(text.find(of), "actions = [{button = 0, part = \"his\", impulse = [0, 8]}]\n");
  WiredReplicas replicas(ParseScene(text, "kick.toml"), MakeSyncConfig("buffer", "rollback"), 3,
                         [](int peer, std::int64_t tick) {
                           const bool pressed = peer == 1 && tick >= 60 && tick < 64;
                           return Input{0, 0, static_cast<std::int16_t>(pressed ? 1 : 0)};
                         });
  replicas.states_flow = false;
  replicas.held_up = [&](int from, int to) {
    return from == 1 && to == 2 && replicas.at(0).tick() >= 55 && replicas.at(0).tick() < 85;
  };
  replicas.StepTo(80);
  const Bytes world = replicas.at(0).SettledWorld(65, 76);
  ASSERT_FALSE(world.empty());
  EXPECT_NE(replicas.Read(0, "his").velocity.y(), replicas.Read(2, "his").velocity.y());
  ASSERT_TRUE(replicas.at(2).TakeWorld(world).ok());
  float highest[3] = {};
  while (replicas.at(0).tick() < 150) {
    replicas.Step();
    for (const int peer : {0, 2}) {
      const float height = replicas.Read(peer, "his").position.y();
      highest[peer] = std::max(highest[peer], replicas.at(0).tick() > 84 ? height : 0);
    }
  }
  EXPECT_GT(highest[0], 0.8f) << "it is kicked";
  EXPECT_EQ(highest[2], highest[0]) << "and once";
  EXPECT_EQ(replicas.Read(2, "his").position.x(), replicas.Read(0, "his").position.x());
}

}  // namespace settled_world_test
}  // namespace seam
