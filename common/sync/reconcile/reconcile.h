#pragma once
/// The rule by which a secondary corrects its copy of a body when the authority's state arrives.
/// One rule per file, all of one signature, so that two are compared by opening two files.
///
///   remote  ----o t1 ........................ the authority's state, as old as the network made it
///   local   ----o t1 ----------------------o t2   our copy then, and now
///                \___ dt = t2 - t1 ________/

#include <cfloat>
#include <string>
#include <vector>

#include "common/scene/types.h"

namespace seam {

struct ReconcileInput {
  BodyState local;   ///< Xl: our copy now, at t2
  BodyState remote;  ///< Xr: the authority's, at t1 (angle unwrapped near ours)
  const BodyState* local_then = nullptr;  ///< our copy at t1; nullptr: no longer (or not yet) known
  float dt = 0;                           ///< t2 - t1, s, >= 0
  float since_impact = 1e9f;              ///< s since our copy's last major impact
  bool coupled = false;                   ///< it touches, or is jointed to one that touches, a body
                                          ///< of another authority than its own
  float gain = 1;                         ///< for coupled bodies: largest stable share to correct
  /// Of the whole mechanism, mass-weighted over the bodies of this message: Xr(t1) - Xl(t1), only
  /// position and velocity. A body alone: its own difference.
  BodyState common;
  /// The speed of a body that has the kinetic energy its authority's had, and what our copy has
  /// gained since t1, m/s: more would be energy out of nothing.
  float speed_max = FLT_MAX;
  bool alone = true;      ///< its mechanism is this one body
  int blocked_count = 0;  ///< directions in which something holds the
  Vec2 blocked_directions[2] = {{0, 0}, {0, 0}};  ///< mechanism back, unit vectors
};

/// What to add to our copy. `then` is the part that was already due at t1; a rule that knows it
/// has the history between t1 and t2 corrected along the line from `then` to `now`.
struct Correction {
  BodyState now;  ///< added to the state at t2
  bool rewrites_history = false;
  BodyState then;  ///< added to the state at t1
};

using Reconciler = Correction (*)(const ReconcileInput&);

/// What a rule that acts in every tick between two messages goes by. Times in s.
///
///   authority   --o t1 ......................... target: moved on from there to now
///   our copy         arrival o-------------o local, now     (since_arrival)
struct PullInput {
  BodyState local;          ///< our copy, before the step
  BodyState arrival;        ///< our copy when the newest message came
  BodyState target_then;    ///< the authority's, moved on to when the message came
  BodyState target;         ///< the authority's, moved on to now
  BodyState target_next;    ///< and to after the step
  BodyState drift;          ///< what the step adds to a free body that is let go at rest
  float since_arrival = 0;  ///< before the step
  float interval = 0;       ///< between two messages, as expected
  float step = 0;           ///< length of a tick
  bool coupled = false;     ///< as in ReconcileInput
};

/// What the replica remembers of a body for its puller.
struct PullMemory {
  Vec2 before{0, 0};  ///< velocity before the last pull
  Vec2 asked{0, 0};   ///< change of velocity by the last pull
  float share = 1;    ///< of what is wanted that is asked; below 1: it is blocked
};

/// What to add to velocity and spin before the step. Poses are the step's business.
using Puller = Correction (*)(const PullInput&, PullMemory*);

Correction PullSpring(const PullInput&, PullMemory*);
Correction PullPvb(const PullInput&, PullMemory*);

Correction ReconcileSnap(const ReconcileInput&);
Correction ReconcileInterleave(const ReconcileInput&);
Correction ReconcileCompensated(const ReconcileInput&);
Correction ReconcileFade(const ReconcileInput&);
Correction ReconcileRetrospect(const ReconcileInput&);
Correction ReconcileResimulate(const ReconcileInput&);
Correction ReconcilePvb(const ReconcileInput&);
Correction ReconcileSpring(const ReconcileInput&);

struct NamedReconciler {
  const char* name;
  Reconciler rule;
  const char* about;
  Puller pull = nullptr;     ///< also acts in every tick
  bool resimulates = false;  ///< the replica goes back and steps again (Replay)
  /// Late inputs are a reason to go back, states are those of input-complete ticks, and what agrees
  /// within a few quanta is left alone.
  bool rolls_back = false;
};
const std::vector<NamedReconciler>& Reconcilers();
/// Throws OperatorError naming the known ones.
const NamedReconciler& FindReconciler(const std::string& name);

/// a - b, component by component.
BodyState Minus(const BodyState& a, const BodyState& b);
/// a + s b, component by component.
BodyState PlusScaled(const BodyState& a, const BodyState& b, float s);
/// Xr' = Xr moved on by its own velocity for dt.
BodyState Extrapolate(const BodyState& remote, float dt);

}  // namespace seam
