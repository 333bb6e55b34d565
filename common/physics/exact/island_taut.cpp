/// ExactIsland: a substep of a taut mechanism, with contacts or where RATTLE cannot close it. In a
/// chain that is almost straight, a load moves by far more than its joints are apart, and its light
/// links swing many times in a substep. Closing the joints there gives any speed. So here errors do
/// not become speed: links turn by implicit Euler with their tension as stiffness (Tournier, Nesme,
/// Gilles and Faure 2015), velocities are projected at both poses, which only takes energy, and
/// then the joints are closed without velocity.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Ratio of stiffness to inertia from which a link is taut: about pi^2, at which its tension swings
/// it by half a period in a substep, so that no substep can follow.
constexpr double kTautFrom = 10;
/// rad: links that turn by more in a substep are under tension because they turn.
constexpr double kTautTurn = 0.1;
/// Share by which diagonal entries of hard rows are enlarged. A load on a chain of 60 that is 5 cm
/// from straight sinks through rows that are enlarged by 1e-9.
constexpr double kTautShare = 1e-12;
/// Rounds of friction: its bounds follow the normal impulses of the solve before.
constexpr int kTautRounds = 1;
/// Errors that are closed, and errors that may be left, m or rad.
constexpr double kTautClosed = 1e-7, kLeftOpen = 1e-5;
/// A way that leaves joints farther apart is cut to this share, so many times, and then not gone.
constexpr double kCutTo = 0.25;
constexpr int kCuts = 2;

}  // namespace

/// True if tension resists the turning of a link so much that a substep of `h` cannot follow it, in
/// a mechanism that hardly turns.
bool ExactIsland::Taut(double h) const {
  bool taut = false;
  for (const ExactBody& q : bodies) {
    if (!q.moves()) continue;
    if (std::fabs(h * q.w) > kTautTurn) return false;
    taut = taut || q.stiffness > kTautFrom * q.inertia;
  }
  return taut;
}

/// Takes the tension as the stiffness of an implicit step: (I + T) w = I w before.
void ExactIsland::Stiffen() {
  for (ExactBody& q : bodies) {
    if (!q.moves()) continue;
    q.ii = 1 / (q.inertia + std::max(0.0, q.stiffness));
    q.w *= q.inertia * q.ii;
  }
}

/// True if the tension just found is greater than the one used.
bool ExactIsland::TooSoft() const {
  return std::any_of(bodies.begin(), bodies.end(), [](const ExactBody& q) {
    return q.moves() && (q.inertia + q.stiffness) * q.ii > kStifferBy;
  });
}

/// Advances the substep from its whole kick to its end. False if joints are not closed.
bool ExactIsland::TautCourse(const Pace& pace) {
  for (Row& row : rows_) {
    if (row.kind == RowKind::kHard) row.target = 0;
    if (row.kind == RowKind::kNormal) row.target = std::min(0.0, row.target);
  }
  Save(&start_);
  for (int tries = 0;; ++tries) {
    Stiffen();
    Assemble(kTautShare);
    Solve(true, kTautRounds);
    if (tries == kStifferTries) break;
    Tension(pace.h);
    if (!TooSoft()) break;
    Restore(start_);
  }
  for (Row& row : rows_) row.base += row.lambda;
  Move(pace.h);
  SolveAtEnd(pace, kTautShare, kTautRounds);
  for (ExactBody& q : bodies) q.lasting = std::max(q.stiffness, kLasts * q.lasting);
  return CloseTaut(pace);
}

/// Closes joints, and moves bodies out of overlaps, without velocity: by a step of Newton's method.
/// The tension in the inertias is the second derivative of the joints, so that light links do not
/// turn instead of the load's moving. False if joints are not closed.
bool ExactIsland::CloseTaut(const Pace& pace) {
  double most = 0;
  const double apart = SquaresApart(&most);
  if (most <= kTautClosed) return true;
  FindWay(pace);
  KeepPoses();
  double share = 1;
  for (int cuts = 0; cuts <= kCuts; ++cuts) {
    for (std::size_t p = 0; p < row_at_.size(); ++p) Shift(*by_place_[p], share * x_[p]);
    double left = 0;
    if (SquaresHere(pace, &left) <= apart) {
      Fill(pace);
      return left <= kLeftOpen;
    }
    RestorePoses(&bodies);
    share *= kCutTo;
  }
  return most <= kLeftOpen;
}

/// Returns SquaresApart for where the bodies are now, without writing their rows.
double ExactIsland::SquaresHere(const Pace& pace, double* most) {
  double sum = 0;
  *most = 0;
  for (const Held& held : joints) {
    double* const errors = &errors_[static_cast<std::size_t>(held.row)];
    if (!JointErrors(*held.joint, held.ends, bodies, errors)) {
      FillJoint(*held.joint, held.ends, bodies, pace, now_.data());
      for (int i = 0; i < held.rows; ++i) errors[i] = now_[static_cast<std::size_t>(i)].error;
    }
    for (int i = 0; i < held.rows; ++i) AddApart(At(held.row + i).kind, errors[i], &sum, most);
  }
  return sum;
}

/// Moves bodies out of deep overlaps as after a jam, unless that opens joints.
void ExactIsland::PushTautApart(const Pace& pace) {
  double before = 0, most = 0;
  SquaresApart(&before);
  KeepPoses();
  PushApart(pace);
  SquaresApart(&most);
  if (most <= std::max(before, kTautClosed)) return;
  RestorePoses(&bodies);
  Fill(pace);
}

/// Solves for the impulses of that way, with the states of the last solve.
void ExactIsland::FindWay(const Pace& pace) {
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    const Row& row = *by_place_[p];
    x_[p] = 0;
    if (row.state != RowState::kFree) continue;
    if (row.kind == RowKind::kHard) x_[p] = -row.error;
    if (row.kind == RowKind::kNormal) {
      x_[p] = pace.h * std::max(0.0, NormalTarget(row.error, pace));
    }
  }
  Factor();
  matrix_.Solve(&x_);
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    if (by_place_[p]->state != RowState::kFree) x_[p] = 0;
  }
}

}  // namespace seam
