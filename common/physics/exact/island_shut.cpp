/// ExactIsland: closes joints after the move, by Newton's method with the matrix of the old pose as
/// long as that converges.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Error to which joints are closed, m or rad; larger with contacts, which leave larger errors.
/// kCorrections: maximal number of corrections.
constexpr double kShut = 1e-9, kShutTouching = 1e-7;
constexpr int kCorrections = 8;
/// Maximal speed of a correction, m/s or rad/s; and softness of contacts, as a share.
constexpr double kShutFastest = 8, kYield = 1e-3;
/// The matrix is rebuilt when a correction leaves more than kRebuildShare of the error. Not before:
/// impulses along the rows of the old pose keep the energy, and those along other rows lose some.
/// But if contacts press, which takes energy anyway, it is rebuilt as soon as a body turns by more
/// than kTurnsFast, rad.
constexpr double kRebuildShare = 0.3, kTurnsFast = 0.25;
/// Redundant joints contradict each other by the rounding of their lengths in single precision. So
/// if a correction with a new matrix leaves more than kStalled of an error below kShutAtBest, m or
/// rad, joints are closed as far as possible.
constexpr double kStalled = 0.7, kShutAtBest = 1e-5;
/// Bounds of the share of the last correction that the next one takes back or adds.
constexpr double kSlopeLeast = -1, kSlopeMost = 0.5;

}  // namespace

/// Lists the rows to be closed, in the order of the matrix: their states stay during the
/// corrections.
void ExactIsland::FindShutting() {
  shutting_.clear();
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    const Row& row = *by_place_[p];
    const bool shuts = row.kind == RowKind::kHard || row.kind == RowKind::kLimit;
    if (!shuts || row.state != RowState::kFree) continue;
    shutting_.push_back({static_cast<std::size_t>(row_at_[p]), p, row.goal, 0});
  }
}

/// Writes joints' errors less their goals as right-hand sides. Returns the greatest error, m or
/// rad. `anew`: writes the rows for the current bodies. `slope`: share of the last correction to
/// take back, so that the errors of the last two cancel (Anderson 1965, of depth one; for a single
/// row the secant method).
double ExactIsland::RightHandSides(const Pace& pace, bool anew, double* slope) {
  double* const errors = errors_.data();
  for (const Held& held : joints) {
    if (!anew && JointErrors(*held.joint, held.ends, bodies, errors + held.row)) continue;
    FillJoint(*held.joint, held.ends, bodies, pace, now_.data());
    for (int i = 0; i < held.rows; ++i) {
      const Row& now = now_[static_cast<std::size_t>(i)];
      const Row& row = At(held.row + i);
      errors[held.row + i] = now.error;
      const bool shuts = row.kind == RowKind::kHard || row.kind == RowKind::kLimit;
      if (anew && shuts && row.state == RowState::kFree) std::copy_n(now.end, row.ends, row.end);
    }
  }
  rewritten_ = rewritten_ || anew;
  double far = 0, up = 0, down = 0;
  double* const x = x_.data();
  std::fill(x_.begin(), x_.end(), 0.0);
  for (Shutting& shut : shutting_) {
    const double off = errors[shut.row] - shut.goal;
    const double side = std::clamp(-off / pace.h, -kShutFastest, kShutFastest);
    const double change = side - shut.side;
    far = std::max(far, std::fabs(off));
    up += side * change;
    down += change * change;
    x[shut.place] = shut.side = side;
  }
  *slope = down > 0 ? std::clamp(up / down, kSlopeLeast, kSlopeMost) : 0;
  return far;
}

/// Adds the solution to the substep's impulses, and moves the bodies accordingly.
void ExactIsland::Correct(double h) {
  const double* const x = x_.data();
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    Row& row = *by_place_[p];
    if (row.state == RowState::kFree && x[p] != 0) row.base += x[p];
  }
  const Act* act = acts_.data();
  for (ExactBody& q : bodies) {
    if (!q.moves()) break;  // moving bodies come first
    double vx = 0, vy = 0, w = 0;
    for (const Act* const stop = act + q.acts; act != stop; ++act) {
      const double by = x[act->place];
      vx += by * act->mj[0];
      vy += by * act->mj[1];
      w += by * act->mj[2];
    }
    q.vx += vx;
    q.vy += vy;
    q.w += w;
    q.x += h * vx;
    q.y += h * vy;
    if (w != 0) q.Turn(h * w);
  }
}

/// Closes the joints. False if they are not closed after the last correction.
bool ExactIsland::ShutJoints(const Pace& pace) {
  const auto presses = [](const Row& row) {
    return row.kind == RowKind::kNormal && row.state == RowState::kFree;
  };
  bool anew = turned_ > kTurnsFast && std::any_of(rows_.begin(), rows_.end(), presses);
  double last = kUnbounded;
  FindShutting();
  for (int tries = 0; tries < kCorrections; ++tries) {
    double slope = 0;
    const double far = RightHandSides(pace, anew, &slope);
    if (far < (contacts.empty() ? kShut : kShutTouching)) return true;
    if (anew && far < kShutAtBest && far > kStalled * last) return true;
    if (tries == 0 && !contacts.empty() && !relaxed_) SoftenContacts();
    if (!anew && tries > 0 && far > kRebuildShare * last) {
      anew = true;
      RightHandSides(pace, anew, &slope);
    }
    last = far;
    if (anew) {
      Assemble();
      if (!contacts.empty()) SoftenContacts();
    }
    if (anew || tries == 0) Factor();
    matrix_.Solve(&x_);
    Accelerate(tries > 0 && !anew ? slope : 0);
    Correct(pace.h);
  }
  return false;
}

/// Takes back `slope` of the last correction.
void ExactIsland::Accelerate(double slope) {
  const std::size_t n = x_.size();
  double* const x = x_.data();
  double* const last = last_.data();
  double* const shift = shift_.data();
  for (std::size_t p = 0; p < n; ++p) {
    const double step = x[p];
    if (slope != 0) x[p] = step - slope * (shift[p] + step - last[p]);
    last[p] = step;
    shift[p] = x[p];
  }
}

/// Softens contacts a little while joints are closed: with them a mechanism may be constrained in
/// more directions than it can move.
void ExactIsland::SoftenContacts() {
  int first = matrix_.size();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool contact = rows_[i].kind == RowKind::kNormal || rows_[i].kind == RowKind::kFriction;
    if (!contact || place_[i] < 0) continue;
    matrix_.At(matrix_.Place(place_[i], place_[i])) *= 1 + kYield;
    first = std::min(first, place_[i]);
  }
  changed_ = std::min(changed_, first);
  dirty_ = std::min(dirty_, first);
}

}  // namespace seam
