/// Explosions with the real server and real clients: each is ordered once and acts on every peer at
/// one tick.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

#include "common/codec/codec.h"
#include "common/measure/measure.h"
#include "common/sync/edits/edit_order.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace blast_cluster_test {

/// Crates on both sides of the seam, some of them behind walls, and two charges.
std::string Yard() {
  return std::string("duration = 60\nbuffer = 8\n") + kTwoSides + R"(
[[part]]
name = "floor"
chain = [[-40, 9], [-20, 0], [20, 0], [40, 9]]
friction = 0.8
[[part]]
name = "wall"
box = [0.3, 2]
position = [3, 1]
anchored = true
[[bricks]]
name = "shed"
brick = [0.5, 0.25]
position = [-5, 0]
count = [1, 8]
strength = 2
[[part]]
name = "crate"
box = [0.7, 0.7]
position = [-3, 0.37]
friction = 0.6
repeat = {count = 6, step = [1.4, 0]}
[[part]]
name = "covered"
box = [0.7, 0.7]
position = [4.2, 0.37]
friction = 0.6
[[charges]]
name = "first"
position = [0.6, 0.4]
radius = 6
impulse = 4
at = 1
[[charges]]
name = "second"
position = [-4.3, 0.6]
radius = 3
impulse = 3
speed = 12
at = 2.5
)";
}

ClusterConfig With(const char* mode, const char* reconcile, const char* impair, std::int64_t seed) {
  ClusterConfig config;
  config.scene = "yard.toml";
  config.scene_text = Yard();
  config.mode = mode;
  config.reconcile = reconcile;
  config.impair = impair;
  config.seed = seed;
  config.drive = Drive::kNone;
  return config;
}

TEST(BlastCluster, AllPeersComeToTheSameRestBitForBit) {
  for (const char* reconcile : {"rollback", "retrospect"}) {
    for (const std::int64_t seed : {1, 2}) {
      Cluster cluster(With("buffer", reconcile, "4g", seed));
      cluster.RunToTick(40 * 60);
      const World& world = cluster.server().replica().world();
      EXPECT_GT(world.body_count(), 7 + 2) << "bricks have come loose";
      for (int c = 0; c < cluster.client_count(); ++c) {
        const World& copy = cluster.client(c)->replica()->world();
        ASSERT_EQ(copy.composition().hash, world.composition().hash) << reconcile << " " << seed;
        for (int body = 0; body < world.body_count(); ++body) {
          const BodyState ours = world.Read(body), theirs = copy.Read(body);
          EXPECT_FALSE(world.awake(body)) << reconcile << " " << seed << " " << world.id(body);
          EXPECT_EQ(ours.position, theirs.position) << reconcile << " " << seed << " " << c;
          EXPECT_EQ(ours.angle, theirs.angle) << reconcile << " " << seed << " " << c;
        }
      }
      const auto moved = [&](const std::string& name, float from) {
        for (const Part& part : world.scene().parts) {
          if (part.name != name) continue;
          return std::fabs(world.Read(world.BodyOfId(part.id)).position.x() - from);
        }
        return -1.0f;
      };
      EXPECT_GT(moved("crate.3", 1.2f), 0.5f) << reconcile << " " << seed;
    }
  }
}

/// Four posts of bricks on bob's side, each blown apart at its foot by two charges.
std::string Posts() {
  std::string text = std::string("duration = 5\nbuffer = 8\n[solver]\nsubsteps = 4\n") + kTwoSides +
                     "[[part]]\nname = \"ground\"\nfriction = 0.8\nchain = [[-99, 0], [99, 0]]\n";
  const auto charge = [&](const char* name, double x, double y, double at) {
    text += fmt::format(
        "[[charges]]\nname = \"{}{:.0f}\"\nposition = [{:.1f}, {:.1f}]\nradius = 2\nimpulse = 4\n"
        "speed = 20\nat = {:.1f}\n",
        name, x, x, y, at);
  };
  for (int i = 0; i < 4; ++i) {
    const double x = 20 + 10 * i;
    text += fmt::format(
        "[[bricks]]\nname = \"post-{}\"\nbrick = [0.5, 0.25]\nposition = [{:.1f}, 0]\n"
        "count = [3, 24]\nstrength = 2\ndensity = 2\n",
        i, x);
    charge("within", x + 0.7, 1, 1);
    charge("beside", x - 0.4, 0.6, 1 + 0.1 * i);
  }
  return text;
}

TEST(BlastCluster, PiecesThatFallBeforeTheirFirstStateStayOnTheGround) {
  for (std::int64_t seed = 1; seed <= 6; ++seed) {
    ClusterConfig config = With("buffer", "rollback", "4g", seed);
    config.scene_text = Posts();
    Cluster cluster(config);
    cluster.RunToTick(4 * 60);
    EXPECT_GT(cluster.server().replica().world().body_count(), 40);
    for (int c = -1; c < cluster.client_count(); ++c) {
      const Replica& replica = c < 0 ? cluster.server().replica() : *cluster.client(c)->replica();
      int lost = 0;
      for (int body = 0; body < replica.world().body_count(); ++body) {
        lost += replica.world().Read(body).position.y() < -1 ? 1 : 0;
      }
      EXPECT_EQ(lost, 0) << "pieces below the ground, seed " << seed << ", client " << c;
    }
  }
}

TEST(BlastCluster, InModeOracleEveryScreenEqualsTheOracle) {
  ClusterConfig config = With("oracle", "", "perfect", 1);
  config.duration_s = 6;
  const Recording recording = RunCluster(config);
  const Oracle oracle = ComputeOracle(recording);
  const Measures m = Measure(recording, oracle);
  EXPECT_GE(recording.edits.size(), 2u);
  EXPECT_EQ(recording.edits.size(), oracle.edits.size());
  EXPECT_GT(m.compared, 0);
  EXPECT_EQ(m.error_max_m, 0);
  EXPECT_EQ(m.error_rms_rad, 0);
}

/// Farthest from the oracle at a tick in anybody's view, m.
double WorstAt(const Recording& recording, const Oracle& oracle, std::int64_t tick) {
  double worst = 0;
  for (const auto& [peer, views] : recording.views) {
    const auto found = views.find(tick);
    if (found == views.end()) continue;
    const View& view = found->second;
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      const std::optional<BodyState> truth = oracle.At(tick, view.id[i]);
      if (!truth) continue;
      const Vec2 at(view.x[i], view.y[i]);
      worst = std::max(worst, static_cast<double>((at - truth->position).norm()));
    }
  }
  return worst;
}

TEST(BlastCluster, UnderRollbackTheBlastEqualsTheOraclesAtItsTick) {
  ClusterConfig config = With("buffer", "rollback", "4g", 3);
  config.duration_s = 2.3;  // before the second
  const Recording recording = RunCluster(config);
  const Oracle oracle = ComputeOracle(recording, WithBarriers(recording.room));
  ASSERT_EQ(recording.edits.size(), 1u);
  // A second later the order has long arrived; a peer that applied it at another tick is 10 cm off.
  EXPECT_LT(WorstAt(recording, oracle, 125), 0.02);
  EXPECT_GT(recording.edits.begin()->second.tick, 55);
}

TEST(BlastCluster, AMessageWithAWrongImpulseIsRefused) {
  const auto decodes = [](const Bytes& bytes) {
    return std::holds_alternative<EditOrder>(Decode(ByteView(bytes)));
  };
  const EditOrder good = ToOrder(Edit(BlastEdit{{1, 2}, 3, 4, 5}, EditCause::kOutside));
  ASSERT_EQ(good.value.size(), 5u);
  const Bytes bytes = Encode(good);
  EXPECT_TRUE(decodes(bytes));
  const Edit back = ToEdit(good);
  ASSERT_NE(back.As<BlastEdit>(), nullptr);
  EXPECT_EQ(back.As<BlastEdit>()->impulse, 5);
  EXPECT_EQ(back.As<BlastEdit>()->radius, 3);
  EditOrder old = good;  // of a recording before there were impulses
  old.value.resize(4);
  EXPECT_TRUE(decodes(Encode(old)));
  EXPECT_EQ(ToEdit(old).As<BlastEdit>()->impulse, 0);
  // The bytes end with the count, of 2 bytes, and the five numbers; the kind is the 37th byte.
  Bytes nan = bytes, more = bytes, push = bytes;
  nan[nan.size() - 4] = 0x7f;
  nan[nan.size() - 3] = 0xc0;
  more[more.size() - 21] = 6;
  more.insert(more.end(), 4, 0);
  ASSERT_EQ(push[36], kEditKindBlast);
  push[36] = 6;
  for (const Bytes& wrong : {nan, more, push}) EXPECT_FALSE(decodes(wrong));
}

}  // namespace blast_cluster_test
}  // namespace seam
