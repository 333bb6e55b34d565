#pragma once
/// Synchronisation settings of a room: mode, reconciler and rates, as flags and messages name them.

#include <string>

#include "common/sync/blend/reconcile.h"
#include "common/sync/policy/policy.h"

namespace seam {

/// Rate of the critically damped return of the view to the simulated pose, 1/s, and its bounds.
constexpr float kSmoothRate = 10, kSmoothRateMin = 1, kSmoothRateMax = 60;

struct SyncConfig {
  const Policy* policy = &BufferPolicy(false);  ///< of the mode; never null
  Reconciler reconcile = nullptr;               ///< not null in modes buffer and central
  Puller pull = nullptr;                        ///< of the reconciler, if it acts in every tick
  std::string reconcile_name;
  int input_delay_ticks = 0;  ///< own inputs act this much later, at every peer; 0..12
  int tick_hz = 60;
  int send_hz = 30;                 ///< States per second from each peer; <= tick_hz
  float smooth_rate = kSmoothRate;  ///< rate at which hidden corrections return, 1/s; 0: none are
                                    ///< hidden
  /// True if this peer's view of bodies far from all that it simulates is watched. If false, these
  /// bodies stay where they were last displayed.
  bool shows_far = true;
  std::int64_t seed = 0;  ///< of bots

  /// Ticks between two States messages of a peer.
  int send_every() const { return tick_hz / send_hz > 0 ? tick_hz / send_hz : 1; }
};

/// Default of mode buffer.
constexpr const char* kDefaultReconciler = "rollback";

/// Returns the rate for "on" (kSmoothRate), "off" (0) or a number in 1/s. Throws OperatorError.
float ParseSmoothRate(const std::string& text);
/// Fills in mode and reconciler from their names. An empty reconciler in mode buffer means
/// kDefaultReconciler. Throws OperatorError if a name is unknown, or if another mode is given a
/// reconciler.
SyncConfig MakeSyncConfig(const std::string& mode, const std::string& reconcile);

}  // namespace seam
