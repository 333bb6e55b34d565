/// Grouping in a session: sixty crates on a rolling cart are one body for all peers until it
/// brakes, and nobody sees them jump when they become one or sixty.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/measure/revisions.h"
#include "tests/support/soak.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace freight_cluster_test {

struct Session {
  const char *mode, *reconcile;
};
/// Under `retrospect` copies of a pile err by up to a decimetre, and jump by that when they become
/// one body.
constexpr Session kSessions[] = {{"central", ""}, {"buffer", "rollback"}};

/// The tick at which bob throws the keg: from there on blows are steps, too.
constexpr std::int64_t kThrown = 540;

class Freight : public ::testing::TestWithParam<int> {};

std::unique_ptr<Cluster> Begun(const Session& session, int seed) {
  ClusterConfig config;
  config.scene = "freight";
  config.mode = session.mode;
  config.reconcile = session.reconcile;
  config.impair = "4g";
  config.seed = seed;
  return std::make_unique<Cluster>(config);
}

/// The most by which a part of a view is elsewhere than where its way of the last two ticks led,
/// m, at the ticks at which the view's bodies had become others, up to `last`.
float LargestStep(const Recording& recording, const Scene& scene, std::int64_t last) {
  const RevisionHistory history(scene, recording);
  float most = 0;
  std::size_t index = 0;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      const View* const before = FindView(views, tick - 1);
      const View* const earlier = FindView(views, tick - 2);
      if (tick > last || before == nullptr || earlier == nullptr ||
          view.revision == before->revision)
        continue;
      for (const Part& part : scene.parts) {
        const auto now = history.InView(view, part.id, &index);
        const auto then = history.InView(*before, part.id, &index);
        const auto first = history.InView(*earlier, part.id, &index);
        if (!now || !then || !first) continue;
        const Vec2 way = 2 * then->position - first->position;
        most = std::max(most, (now->position - way).norm());
      }
    }
  }
  return most;
}

TEST_P(Freight, SixtyCratesAreOneBodyWhileTheCartRollsAndSixtyWhenItBrakes) {
  for (const Session& session : kSessions) {
    const auto cluster = Begun(session, GetParam());
    const World& world = cluster->server().replica().world();
    const std::string name = std::string(session.mode) + " " + session.reconcile;
    int most = 0;
    cluster->RunToTick(120);
    for (int tick = 121; tick <= 300; ++tick) {
      cluster->RunToTick(tick);
      most = std::max(most, world.body_count());
    }
    EXPECT_LE(most, 10) << name << ", from 2 s to 5 s: cart, two wheels, keg, crates";
    cluster->RunToTick(345);
    EXPECT_EQ(world.body_count(), 64) << name << ", while it brakes";
    cluster->RunToTick(kThrown);
    EXPECT_LE(world.body_count(), 10) << name << ", at rest again";
    cluster->RunToTick(600);
    EXPECT_GE(world.body_count(), 30) << name << ", hit by the keg";
    cluster->Run();
    const auto settled = [&] {
      for (int i = 0; i < cluster->client_count(); ++i) {
        const Replica& replica = *cluster->client(i)->replica();
        if (replica.revision() != cluster->server().replica().revision()) return false;
      }
      return true;
    };
    for (int tick = 721; tick < 840 && !settled(); ++tick) cluster->RunToTick(tick);
    ASSERT_TRUE(settled()) << name;
    for (int i = 0; i < cluster->client_count(); ++i) {
      const Replica& replica = *cluster->client(i)->replica();
      EXPECT_EQ(replica.world().composition().hash, world.composition().hash) << name;
    }
    const float step = LargestStep(cluster->recording(), cluster->scene(), kThrown);
    RecordProperty("step", std::to_string(step));
    EXPECT_LT(step, 0.05f) << name << ", m";
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Freight, ::testing::ValuesIn(SoakSeeds(1, 2)));

}  // namespace freight_cluster_test
}  // namespace seam
