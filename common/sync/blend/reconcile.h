#pragma once
/// Rules by which a secondary corrects its copy of a body when the authority's state arrives. Each
/// file has one rule; all have one signature, so that two can be compared file by file.
///
///   remote  ----o t1 ........................ the authority's state, as old as the network made it
///   local   ----o t1 ----------------------o t2   our copy then, and now
///                \___ dt = t2 - t1 ________/

#include <cfloat>
#include <string>
#include <vector>

#include "common/scene/types.h"
#include "common/sync/state_arithmetic.h"

namespace seam {

struct ReconcileInput {
  BodyState local;   ///< Xl: our copy now, at t2
  BodyState remote;  ///< Xr: the authority's, at t1 (angle unwrapped near ours)
  const BodyState* local_then = nullptr;  ///< our copy at t1; nullptr: not (or no longer) known
  float dt = 0;                           ///< t2 - t1, s, >= 0
  float since_impact = 1e9f;              ///< s since our copy's last major impact
  bool coupled = false;                   ///< the body touches, or is jointed to one that touches,
                                          ///< a body of another authority
  float gain = 1;                         ///< for coupled bodies: largest stable share to correct
  /// Mass-weighted mean of Xr(t1) - Xl(t1) over the mechanism's bodies in this message; only
  /// position and velocity. For a single body its own difference.
  BodyState common;
  /// Speed at which the body has its authority's kinetic energy plus our copy's gain since t1, m/s.
  /// More would create energy.
  float speed_max = FLT_MAX;
  bool alone = true;                              ///< its mechanism is this one body
  int blocked_count = 0;                          ///< number of blocked_directions
  Vec2 blocked_directions[2] = {{0, 0}, {0, 0}};  ///< unit vectors
};

/// Correction of our copy. `then` is the part already due at t1. If the rule knows it, the history
/// between t1 and t2 is corrected along the line from `then` to `now`.
struct Correction {
  BodyState now;  ///< added to the state at t2
  bool rewrites_history = false;
  BodyState then;  ///< added to the state at t1
};

using Reconciler = Correction (*)(const ReconcileInput&);

/// Inputs of a rule that acts in every tick between two messages. Times in s.
///
///   authority   --o t1 ............... target: moved on from there to now
///   our copy         -----------------o local
struct PullInput {
  BodyState local;   ///< our copy, before the step
  BodyState target;  ///< the authority's state, extrapolated to now
  BodyState drift;   ///< change by the step of a free body that starts at rest
  float step = 0;    ///< length of a tick
};

/// Memory of a puller for one body.
struct PullMemory {
  Vec2 before{0, 0};  ///< velocity before the last pull
  Vec2 asked{0, 0};   ///< change of velocity by the last pull
  float share = 1;    ///< share of the wanted change that is asked for; below 1: blocked
};

/// Returns the change of velocity and spin before the step. Poses are left to the step.
using Puller = Correction (*)(const PullInput&, PullMemory*);

Correction PullSpring(const PullInput&, PullMemory*);

Correction ReconcileSnap(const ReconcileInput&);
Correction ReconcileInterleave(const ReconcileInput&);
Correction ReconcileCompensated(const ReconcileInput&);
Correction ReconcileFade(const ReconcileInput&);
Correction ReconcileRetrospect(const ReconcileInput&);
Correction ReconcileRollback(const ReconcileInput&);
Correction ReconcileSpring(const ReconcileInput&);

struct NamedReconciler {
  const char* name;
  Reconciler rule;
  const char* about;
  Puller pull = nullptr;  ///< also acts in every tick
  /// A late state or input starts a replay (Replay), states are those of input-complete ticks, and
  /// differences of a few quanta are left alone.
  bool rolls_back = false;
};
const std::vector<NamedReconciler>& Reconcilers();
/// Throws OperatorError with the known names.
const NamedReconciler& FindReconciler(const std::string& name);

}  // namespace seam
