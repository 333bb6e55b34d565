/// A slow machine simulates less. Virtual time has no CPU: what a client needs is a model, so much
/// for each body in each of its steps, replayed ones included.

#include <gtest/gtest.h>

#include <cstdio>

#include "common/measure/measure.h"
#include "tests/lab/cluster.h"
#include "tests/support/plain_scene.h"

namespace seam {
namespace {

constexpr int kSlow = 1;        // the client that is throttled
constexpr double kBodyUs = 60;  // of a machine that steps about a third of what it could
constexpr std::int64_t kTicks = 60;

/// Four players on a plain, twelve crates each.
ClusterConfig Plain(double throttle) {
  PlainScene plain;
  plain.spacing = 14;
  plain.crates = 12;
  plain.duration = 10;
  ClusterConfig config;
  config.scene = "plain";
  config.scene_text = PlainText(plain);
  config.drive = Drive::kBot;
  config.client_body_us = kBodyUs;
  config.client_throttle = {1, throttle};
  return config;
}

/// Bodies that the client steps.
int Steps(Cluster& cluster, int client) {
  return SteppedBodies(cluster.client(client)->replica()->world());
}

struct Session {
  explicit Session(double throttle) : cluster(Plain(throttle)) {
    cluster.RunToTick(5 * kTicks);
    // The mean of the last five seconds: what it does depends on what is around it.
    for (std::int64_t tick = 5 * kTicks; tick < 10 * kTicks; ++tick) {
      cluster.RunToTick(tick + 1);
      load += cluster.client(kSlow)->load_permille() / 1000.0 / (5.0 * kTicks);
      steps += Steps(cluster, kSlow) / (5.0 * kTicks);
    }
    errors = Measure(cluster.recording(), ComputeOracle(cluster.recording())).error_rms_by_peer_m;
  }
  Cluster cluster;
  double load = 0, steps = 0;
  std::map<int, double> errors;
};

TEST(Throttle, AClientThatIsSlowedToAQuarterSimulatesWhatItCanAndTheOthersSeeLittleOfIt) {
  Session free(1), slow(4);
  std::printf("load %.2f with %.1f bodies; a quarter as fast: %.2f with %.1f bodies\n", free.load,
              free.steps, slow.load, slow.steps);
  EXPECT_LT(free.load, 0.8) << "a machine that has time is not limited";
  EXPECT_GT(4 * free.load, 1.25) << "without less to do it could not keep up";
  EXPECT_LT(slow.load, 1.25);
  EXPECT_GT(slow.load, 0.5) << "it does what it can";
  EXPECT_LT(slow.steps, free.steps);
  for (int i = 0; i < slow.cluster.client_count(); ++i) {
    const int peer = slow.cluster.client(i)->peer();
    std::printf("peer %d: error %.4f, with one slow %.4f m\n", peer, free.errors[peer],
                slow.errors[peer]);
    if (i == kSlow) continue;
    // The slow one's carts strike crates late, and what tumbles otherwise stays so: a guard, no
    // bar.
    EXPECT_LE(slow.errors[peer], 2 * free.errors[peer] + 0.01) << peer;
  }
}

}  // namespace
}  // namespace seam
