#pragma once
/// A slow machine simulates less. Virtual time has no CPU: what a client needs is a model, so much
/// for each body in each of its steps, replayed ones included.

#include <cstdint>
#include <map>
#include <vector>

namespace seam {

/// The client that is throttled, and the model's CPU time for each body, us: of a machine that
/// steps about a third of what it could.
constexpr int kThrottledClient = 1;
constexpr double kThrottleBodyUs = 60;

/// Of a session of ten seconds; loads and steps are means of its last five.
struct Throttled {
  double load = 0;               ///< of the throttled client; 1: all of its time
  double steps = 0;              ///< bodies that it steps
  std::map<int, double> errors;  ///< RMS, m, by peer
  int slow_peer = 0;             ///< which of them is slow
};

/// Four players on a plain, twelve crates each, bots; one of them so many times slower than the
/// others.
Throttled MeasureThrottled(double throttle, std::int64_t seed);

/// By how much the error of each of the others is larger when one is slow.
std::vector<double> ErrorRatios(const Throttled& free, const Throttled& slow);

}  // namespace seam
