#include "tests/lab/relief/throttle.h"

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "tests/support/plan/plain_scene.h"

namespace seam {
namespace {

constexpr std::int64_t kTicks = 60;  // a second

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
  config.client_body_us = kThrottleBodyUs;
  config.client_throttle.assign(kThrottledClient, 1);
  config.client_throttle.push_back(throttle);
  return config;
}

}  // namespace

Throttled MeasureThrottled(double throttle, std::int64_t seed) {
  Cluster cluster(Plain(throttle, seed));
  cluster.RunToTick(5 * kTicks);
  const Client& slow = *cluster.client(kThrottledClient);
  Throttled session;
  session.slow_peer = slow.peer();
  // The mean of the last five seconds: what it does depends on what is around it.
  for (std::int64_t tick = 5 * kTicks; tick < 10 * kTicks; ++tick) {
    cluster.RunToTick(tick + 1);
    session.load += slow.load_permille() / 1000.0 / (5.0 * kTicks);
    session.steps += SteppedBodies(slow.replica()->world()) / (5.0 * kTicks);
  }
  const Recording& recording = cluster.recording();
  session.errors = Measure(recording, ComputeOracle(recording)).error_rms_by_peer_m;
  return session;
}

std::vector<double> ErrorRatios(const Throttled& free, const Throttled& slow) {
  std::vector<double> ratios;
  for (const auto& [peer, error] : slow.errors) {
    const auto before = free.errors.find(peer);
    const bool other = peer > 0 && peer != slow.slow_peer;
    if (other && before != free.errors.end()) ratios.push_back(error / before->second);
  }
  return ratios;
}

}  // namespace seam
