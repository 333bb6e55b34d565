#pragma once
/// How a room is synchronised: mode, reconciler and rates, as flags and messages say it.

#include <optional>
#include <string>

#include "common/sync/reconcile/reconcile.h"

namespace seam {

/// Who simulates what (Roles). kOracle: every peer simulates everything alone, with all inputs.
enum class Mode { kOracle, kCentral, kStrict, kBuffer };

/// Mode central: what a client simulates ahead of the server's states. kOwn: what its player
/// drives, the rest is interpolated. kAll: everything, with all inputs that it knows.
enum class Predict { kOwn, kAll };

/// Rate of the critically damped return of what is shown to where physics is, 1/s, and its bounds.
constexpr float kSmoothRate = 10, kSmoothRateMin = 1, kSmoothRateMax = 60;

struct SyncConfig {
  Mode mode = Mode::kBuffer;
  Reconciler reconcile = nullptr;  ///< not null in modes kBuffer and kCentral
  Puller pull = nullptr;           ///< of the reconciler, if it acts in every tick
  bool resimulates = false;        ///< the reconciler goes back and steps again
  bool rolls_back = false;         ///< ...and for late inputs, too: see NamedReconciler
  std::string reconcile_name;
  Predict predict = Predict::kAll;  ///< mode central
  int input_delay_ticks = 0;        ///< own inputs act this much later, at every peer; 0..12
  int tick_hz = 60;
  int send_hz = 30;                 ///< States per second from each peer; <= tick_hz
  float smooth_rate = kSmoothRate;  ///< of hiding corrections in the view, 1/s; 0: none are
  /// Whether somebody looks at what this peer shows of bodies that are far from all that it
  /// simulates. If not they stay where they were shown last.
  bool shows_far = true;
  std::int64_t seed = 0;  ///< of bots

  /// Whether the peer goes back and steps again when it was wrong.
  bool GoesBack(int self) const { return resimulates || (mode == Mode::kCentral && self > 0); }
  /// Whether the peer's world is built anew at every send tick. The server of predicting clients
  /// never goes back, but theirs come to the same bits only if all do it at the same ticks.
  bool TakesBarriers(int self) const {
    return GoesBack(self) || (mode == Mode::kCentral && predict == Predict::kAll);
  }
  /// Whether inputs act at the tick that they are of at every peer that simulates what they move,
  /// and one that arrives late is a reason to go back. Else only the authority acts on buttons,
  /// when it hears of them.
  bool StampsInputs(int self) const { return rolls_back || (mode == Mode::kCentral && self > 0); }

  /// Ticks between two States of a peer.
  int send_every() const { return tick_hz / send_hz > 0 ? tick_hz / send_hz : 1; }
};

/// Of mode buffer, when none is named.
constexpr const char* kDefaultReconciler = "rollback";

const char* ToString(Mode mode);
/// Nothing for an unknown name: recordings may say anything.
std::optional<Mode> FindMode(const std::string& name);
/// Throws OperatorError naming the known ones.
Mode ParseMode(const std::string& name);
/// The rate that "on" (kSmoothRate), "off" (0) or a number of 1/s says. Throws OperatorError.
float ParseSmoothRate(const std::string& text);
/// Fills mode and reconciler from their names. An empty reconciler in mode buffer means
/// kDefaultReconciler. Throws OperatorError when unknown or when a reconciler is given in another
/// mode.
SyncConfig MakeSyncConfig(const std::string& mode, const std::string& reconcile);

}  // namespace seam
