#pragma once
/// Synchronisation settings of a room: mode, reconciler and rates, as flags and messages name them.

#include <cstdint>
#include <string>

#include "common/sync/blend/reconcile.h"
#include "common/sync/policy/policy.h"

namespace seam {

/// Barriers a second (World::Barrier). Peers that are to agree bit for bit must rebuild their
/// worlds at the same ticks; fewer make a replay longer, more cost a rebuild each.
constexpr int kBarrierHz = 30;
/// Returns the ticks between two barriers; it does not depend on the rate of States.
constexpr int BarrierEvery(int tick_hz) { return tick_hz > kBarrierHz ? tick_hz / kBarrierHz : 1; }
/// States a second of a body to receivers that come to the same state by themselves
/// (Policy::CopiesAgree). Lower leaves a copy that went another way wrong for longer.
constexpr int kRefreshHz = 4;
/// For so long after a grant, an edit or a report that a copy differs they get every state, s: an
/// order or grant reaches all within it. Shorter leaves peers apart after a change; longer sends
/// what all know.
constexpr int kSettleS = 1;
/// Returns the ticks between two such states.
constexpr int RefreshEvery(int tick_hz) { return tick_hz > kRefreshHz ? tick_hz / kRefreshHz : 1; }

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
  /// Others' bodies are displayed at most this long ago (ShowAge), ticks, 0..kShowAgeTicksMax; 0:
  /// in the present. Without smoothing the view is the simulated state.
  int show_age_ticks = 0;
  /// True if this peer's view of bodies far from all that it simulates is watched. If false, these
  /// bodies stay where they were last displayed.
  bool shows_far = true;
  std::int64_t seed = 0;  ///< of bots

  /// Ticks between two States messages of a peer.
  int send_every() const { return tick_hz / send_hz > 0 ? tick_hz / send_hz : 1; }
  /// True if States are collected after this tick, or it is a barrier.
  bool IsLookTick(std::int64_t tick) const {
    return tick % send_every() == 0 || tick % BarrierEvery(tick_hz) == 0;
  }
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
