#pragma once
/// Synchronisation settings of a room: mode, reconciler and rates, as flags and messages name them.

#include <optional>
#include <string>

#include "common/sync/reconcile/reconcile.h"

namespace seam {

/// Assignment of simulation to peers (Roles). kOracle: every peer simulates everything alone, with
/// all inputs.
enum class Mode { kOracle, kCentral, kStrict, kBuffer };

/// Mode central: the mechanisms that a client simulates ahead of the server's states. kOwn: those
/// that its player drives; the rest is interpolated. kAll: everything, with all inputs known.
enum class Predict { kOwn, kAll };

/// Rate of the critically damped return of the view to the simulated pose, 1/s, and its bounds.
constexpr float kSmoothRate = 10, kSmoothRateMin = 1, kSmoothRateMax = 60;

struct SyncConfig {
  Mode mode = Mode::kBuffer;
  Reconciler reconcile = nullptr;  ///< not null in modes kBuffer and kCentral
  Puller pull = nullptr;           ///< of the reconciler, if it acts in every tick
  bool rolls_back = false;         ///< of the reconciler: see NamedReconciler
  std::string reconcile_name;
  Predict predict = Predict::kAll;  ///< mode central
  int input_delay_ticks = 0;        ///< own inputs act this much later, at every peer; 0..12
  int tick_hz = 60;
  int send_hz = 30;                 ///< States per second from each peer; <= tick_hz
  float smooth_rate = kSmoothRate;  ///< rate at which hidden corrections return, 1/s; 0: none are
                                    ///< hidden
  /// True if this peer's view of bodies far from all that it simulates is watched. If false, these
  /// bodies stay where they were last displayed.
  bool shows_far = true;
  std::int64_t seed = 0;  ///< of bots

  /// True if inputs take effect at their own tick at every peer that simulates their mechanisms,
  /// and a late input or a state that differs starts a replay. Otherwise only the authority acts on
  /// buttons, when they arrive.
  bool GoesBack(int self) const { return rolls_back || (mode == Mode::kCentral && self > 0); }
  /// True if the peer's world is rebuilt at every send tick. The server of predicting clients never
  /// rolls back, but its clients can reproduce its bits only if all rebuild at the same ticks.
  bool TakesBarriers(int self) const {
    return GoesBack(self) || (mode == Mode::kCentral && predict == Predict::kAll);
  }

  /// Ticks between two States messages of a peer.
  int send_every() const { return tick_hz / send_hz > 0 ? tick_hz / send_hz : 1; }
};

/// Default of mode buffer.
constexpr const char* kDefaultReconciler = "rollback";

const char* ToString(Mode mode);
/// Returns nothing for an unknown name: recordings may contain any.
std::optional<Mode> FindMode(const std::string& name);
/// Throws OperatorError with the known names.
Mode ParseMode(const std::string& name);
/// Returns the rate for "on" (kSmoothRate), "off" (0) or a number in 1/s. Throws OperatorError.
float ParseSmoothRate(const std::string& text);
/// Fills in mode and reconciler from their names. An empty reconciler in mode buffer means
/// kDefaultReconciler. Throws OperatorError if a name is unknown, or if another mode is given a
/// reconciler.
SyncConfig MakeSyncConfig(const std::string& mode, const std::string& reconcile);

}  // namespace seam
