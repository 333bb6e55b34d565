/// A slow machine simulates less. Virtual time has no CPU: what a client needs is a model, so much
/// for each body in each of its steps, replayed ones included.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <vector>

#include "common/measure/measure.h"
#include "tests/lab/cluster.h"
#include "tests/support/plan/plain_scene.h"
#include "tests/support/soak.h"

namespace seam {
namespace {

constexpr int kSlow = 1;        // the client that is throttled
constexpr double kBodyUs = 60;  // of a machine that steps about a third of what it could
constexpr std::int64_t kTicks = 60;
/// Sessions with bots of other seeds: the bar is for their median, since what tumbles otherwise
/// once stays so, in either.
constexpr int kSeeds = 6;

/// Four players on a plain, twelve crates each.
ClusterConfig Plain(double throttle, std::int64_t seed) {
  PlainScene plain;
  plain.spacing = 14;
  plain.crates = 12;
  plain.duration = 10;
  ClusterConfig config;
  config.scene = "plain";
  config.scene_text = PlainText(plain);
  config.drive = Drive::kBot;
  config.seed = seed;
  config.client_body_us = kBodyUs;
  config.client_throttle = {1, throttle};
  return config;
}

/// Bodies that the client steps.
int Steps(Cluster& cluster, int client) {
  return SteppedBodies(cluster.client(client)->replica()->world());
}

struct Session {
  Session(double throttle, std::int64_t seed) : cluster(Plain(throttle, seed)) {
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

/// By how much the error of each of the others is larger when one is slow, appended.
void CompareErrors(Session* free, Session* slow, std::vector<double>* ratios) {
  for (int i = 0; i < slow->cluster.client_count(); ++i) {
    const int peer = slow->cluster.client(i)->peer();
    const double ratio = slow->errors[peer] / free->errors[peer];
    std::printf("  peer %d: error %.4f, with one slow %.4f m, x %.2f\n", peer, free->errors[peer],
                slow->errors[peer], ratio);
    if (i != kSlow) ratios->push_back(ratio);
  }
}

TEST(Throttle, AClientThatIsSlowedToAQuarterSimulatesWhatItCanAndTheOthersSeeLittleOfIt) {
  std::vector<double> ratios;
  for (int seed = 1; seed <= Soak(kSeeds); ++seed) {
    Session free(1, seed), slow(4, seed);
    std::printf("seed %d: load %.2f with %.1f bodies; a quarter as fast: %.2f with %.1f bodies\n",
                seed, free.load, free.steps, slow.load, slow.steps);
    EXPECT_LT(free.load, 0.8) << "a machine that has time is not limited";
    EXPECT_GT(4 * free.load, 1) << "without less to do it could not keep up";
    EXPECT_LT(slow.load, 1.25);
    EXPECT_GT(slow.load, 0.5) << "it does what it can";
    EXPECT_LT(slow.steps, free.steps);
    CompareErrors(&free, &slow, &ratios);
  }
  std::sort(ratios.begin(), ratios.end());
  // Over 12 seeds the median is 1.09 and the largest 1.49; over two it may be 1.31.
  EXPECT_LE(ratios[ratios.size() / 2], 1.2);
  EXPECT_LE(ratios.back(), 2) << "a guard, no bar";
}

}  // namespace
}  // namespace seam
