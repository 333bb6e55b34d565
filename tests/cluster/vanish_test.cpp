/// A holder's process dies. What it had goes on in every view, long before its lease ends.

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/lab/cluster.h"

namespace seam {
namespace {

/// Ann's disc goes by at 5 m/s; bob only looks, and the server has nothing there.
const char* const kPassing = R"(
gravity = [0, 0]
duration = 20
buffer = 2
follow = 0
server_follow = 0
[[player]]
name = "ann"
vehicle = "disc"
[[player]]
name = "bob"
region = [[400, -100], [900, 100]]
[[part]]
name = "disc"
circle = 0.5
velocity = [5, 0]
owner = "ann"
)";

/// Bob only looks: two messages of ann's disc that were lost in a row, before or after she was
/// gone, let it stand for him (seeds 7, 18 and 1 over 4g, most over terrible).
TEST(Vanish, WhatTheHolderHadGoesOnInEveryView) {
  for (const char* reconcile : {"rollback", "retrospect", "fade"}) {
    for (const auto& [impair, seed] :
         {std::pair("demo", 1), std::pair("4g", 1), std::pair("4g", 7), std::pair("4g", 18),
          std::pair("terrible", 2), std::pair("terrible", 4), std::pair("terrible", 6)}) {
      SCOPED_TRACE(std::string(reconcile) + " " + impair + ", seed " + std::to_string(seed));
      ClusterConfig config;
      config.scene = "passing";
      config.scene_text = kPassing;
      config.reconcile = reconcile;
      config.impair = impair;
      config.seed = seed;
      config.drive = Drive::kNone;
      Cluster cluster(config);
      cluster.RunToTick(180);
      const AuthorityTable& table = cluster.server().replica().authority();
      ASSERT_EQ(table.at(0).authority, cluster.client(0)->peer());
      ASSERT_FALSE(table.at(0).secondaries.Has(0)) << "the server does not simulate it";
      const int bob = cluster.client(1)->peer();
      cluster.Kill(0);
      cluster.RunToTick(180 + 7 * 60);
      EXPECT_EQ(table.at(0).authority, 0) << "its lease is over";
      for (const int peer : {0, bob}) {
        const std::map<std::int64_t, View>& views = cluster.recording().views.at(peer);
        for (std::int64_t tick = 180; tick < 180 + 6 * 60; ++tick) {
          ASSERT_EQ(views.count(tick) + views.count(tick + 18), 2u) << tick;
          const float way = views.at(tick + 18).x[0] - views.at(tick).x[0];
          EXPECT_NEAR(way, 5 * 0.3f, 0.1f) << "in 0.3 s from tick " << tick << ", peer " << peer;
        }
      }
    }
  }
}

}  // namespace
}  // namespace seam
