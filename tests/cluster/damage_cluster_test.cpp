/// The server believes honest impacts, also those that come through neighbours, and no invented
/// ones.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "client/embed/cluster.h"
#include "common/codec/codec.h"
#include "common/codec/quanta.h"
#include "common/scene/part_rules.h"
#include "server/rules/rules.h"
#include "tests/cluster/rewritten_states.h"
#include "tests/support/path/rewriting_net.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace damage_cluster_test {

ClusterConfig Session(const std::string& scene, const std::string& impair) {
  std::ifstream file("tests/lab/damage/" + scene + ".toml");
  ClusterConfig config;
  config.scene = scene;
  config.scene_text.assign(std::istreambuf_iterator<char>(file), {});
  config.impair = impair;
  config.duration_s = 12;
  config.keep = false;
  return config;
}

TEST(Damage, HonestImpactsAreBelievedOnEveryNetwork) {
  std::int64_t judged = 0;
  for (const char* scene : {"row", "heap", "balls", "glued"}) {
    AuthoritySource::ReportCounts sum;
    for (const char* impair : {"perfect", "demo", "4g", "3g", "terrible"}) {
      for (const Drive drive : {Drive::kScript, Drive::kBot}) {
        ClusterConfig config = Session(scene, impair);
        config.drive = drive;
        Cluster cluster(config);
        cluster.Run();
        const auto& counts = ServerTestAccess::RuleSourceOf(cluster.server())->counts();
        EXPECT_EQ(cluster.server().stats().dropped_implausible, counts.implausible)
            << scene << " " << impair << ": of honest states none is refused";
        sum.accepted += counts.accepted;
        sum.implausible += counts.implausible;
      }
    }
    EXPECT_LE(sum.implausible * 100, sum.accepted) << scene << ": of " << sum.accepted;
    judged += sum.accepted;
  }
  EXPECT_GT(judged, 1000) << "else it says nothing";
}

/// ann's car drives into her own two crates, far from bob.
const char* const kOwn = R"(
duration = 8
buffer = 6
[[player]]
name = "ann"
region = [[-1000, -1000], [-0.001, 1000]]
script = [[0.0, {drive = 1}], [3.0, {drive = -1}], [5.0, {drive = 1}]]
[[player]]
name = "bob"
region = [[0, -1000], [1000, 1000]]
[[part]]
name = "ground"
chain = [[-90, 0], [60, 0]]
[[part]]
name = "car"
box = [2, 1]
position = [-60, 0.5]
friction = 0.1
density = 3
owner = "ann"
[[thrust]]
name = "push"
part = "car"
force = [40, 0]
player = "ann"
axis = "drive"
[[part]]
name = "crate"
box = [0.8, 0.8]
position = [-52, 0.4]
health = 1000
damage = {above = 0.5, factor = 1}
repeat = {count = [2, 1], step = [0.81, 0]}
)";

/// ann makes each of her impacts one of 150 m/s; with `velocities` she also tells that all she has
/// moves at 110 m/s, wherever it is. Returns what the server counted.
AuthoritySource::ReportCounts LieAboutImpacts(const char* impair, TrustMode trust,
                                              bool velocities) {
  ClusterConfig config;
  config.scene = "own";
  config.scene_text = kOwn;
  config.impair = impair;
  config.trust = trust;
  // With copies at the server, and without trust, a settled world would make her lie true.
  config.keep = !velocities;
  std::int64_t reported = 0;  // impacts
  RewrittenStates rewritten(ParseScene(kOwn, "own.toml"));
  config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) {
    if (client != 0) return net;
    return std::unique_ptr<Net>(
        std::make_unique<RewritingNet>(std::move(net), [&](std::int64_t, Bytes* message) {
          rewritten.Rewrite(message, [velocities](States* states) {
            if (!velocities) return;
            for (auto& vx : states->vx) vx = static_cast<std::int16_t>(110 * kQuantaPerSpeed);
          });
          AnyMessage any = Decode(*message);
          if (auto* report = std::get_if<ImpactReport>(&any)) {
            for (float& dv : report->dv) dv = 150;
            reported += static_cast<std::int64_t>(report->dv.size());
            *message = Encode(*report);
          }
          return true;
        }));
  };
  Cluster cluster(config);
  cluster.Run();
  EXPECT_GT(reported, 1) << impair;
  return ServerTestAccess::RuleSourceOf(cluster.server())->counts();
}

/// Without doubts about states: the impact's own check has to find the lie.
TEST(Damage, AnImpactOfAToldVelocityIsRefused) {
  for (const char* impair : {"perfect", "4g"}) {
    const auto counts = LieAboutImpacts(impair, TrustMode::kOff, true);
    EXPECT_EQ(counts.accepted, 0) << impair;
    EXPECT_GT(counts.implausible, 0) << impair;
  }
}

/// All states are true and believed.
TEST(Damage, AnImpactThatTrueStatesDoNotExplainIsRefused) {
  for (const char* impair : {"perfect", "4g"}) {
    const auto counts = LieAboutImpacts(impair, TrustMode::kAct, false);
    EXPECT_EQ(counts.accepted, 0) << impair;
    EXPECT_GT(counts.implausible, 0) << impair;
  }
}

}  // namespace damage_cluster_test
}  // namespace seam
