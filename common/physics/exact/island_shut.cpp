/// ExactIsland: joints are shut after the move, by Newton's method with the matrix of the old pose
/// as long as that will do.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Joints are shut to this, m or rad, in at most so many corrections; less well where something
/// touches, which leaves more behind.
constexpr double kShut = 1e-9, kShutTouching = 1e-7;
constexpr int kCorrections = 8;
/// By no more than this, m/s or rad/s; contacts yield by this share.
constexpr double kShutFastest = 8, kYield = 1e-3;
/// The matrix is made anew in them when one leaves more than this share, or when a body turns by
/// more than kTurnsFast, rad.
constexpr double kSlow = 0.3;
constexpr double kTurnsFast = 0.25;
/// Of the last correction, what the next one takes back or adds at most, as a share.
constexpr double kSlopeLeast = -1, kSlopeMost = 0.5;

}  // namespace

/// Joints' errors less their goals, as sides of the system. Returns the greatest, m or rad. `anew`:
/// the rows are written as the bodies are now.
double ExactIsland::SidesOfErrors(const Pace& pace, bool anew) {
  double far = 0;
  Row* const now = now_.data();
  std::fill(x_.begin(), x_.end(), 0.0);
  for (const Held& held : joints) {
    double errors[kJointRowsMost];
    if (anew || !JointErrors(*held.joint, held.ends, bodies, errors)) {
      FillJoint(*held.joint, held.ends, bodies, pace, now);
      for (int i = 0; i < held.rows; ++i) errors[i] = now[i].error;
    }
    for (int i = 0; i < held.rows; ++i) {
      Row& row = At(held.row + i);
      const bool shuts = row.kind == RowKind::kHard || row.kind == RowKind::kLimit;
      const int place = place_[static_cast<std::size_t>(held.row + i)];
      if (!shuts || place < 0 || row.state != RowState::kFree) continue;
      const double off = errors[i] - row.goal;
      far = std::max(far, std::fabs(off));
      x_[static_cast<std::size_t>(place)] = std::clamp(-off / pace.h, -kShutFastest, kShutFastest);
      if (anew) std::copy_n(now[i].end, row.ends, row.end);
    }
  }
  return far;
}

/// Adds the solution to the substep's impulses, and moves the bodies by what it does.
void ExactIsland::Correct(double h) {
  push_.assign(3 * bodies.size(), 0.0);
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    Row& row = *by_place_[p];
    const double x = x_[p];
    if (row.state != RowState::kFree || x == 0) continue;
    row.base += x;
    for (const RowEnd* end = row.end; end != row.end + row.ends; ++end) {
      double* const push = push_.data() + 3 * static_cast<std::size_t>(end->body);
      for (int i = 0; i < 3; ++i) push[i] += x * end->mj[i];
    }
  }
  const double* push = push_.data();
  for (ExactBody& q : bodies) {
    q.vx += push[0];
    q.vy += push[1];
    q.w += push[2];
    q.x += h * push[0];
    q.y += h * push[1];
    if (push[2] != 0) q.Turn(h * push[2]);
    push += 3;
  }
}

void ExactIsland::ShutJoints(const Pace& pace) {
  bool anew = turned_ > kTurnsFast;
  double last = kUnbounded;
  for (int tries = 0; tries < kCorrections; ++tries) {
    const double far = SidesOfErrors(pace, anew);
    if (far < (contacts.empty() ? kShut : kShutTouching)) break;
    if (tries == 0 && !contacts.empty() && !relaxed_) SoftenContacts();
    if (!anew && tries > 0 && far > kSlow * last) {
      anew = true;
      SidesOfErrors(pace, anew);
    }
    last = far;
    if (anew) {
      Assemble();
      if (!contacts.empty()) SoftenContacts();
    }
    Factor();
    const double slope = tries > 0 && !anew ? SlopeOfSides() : 0;
    side_ = x_;
    matrix_.Solve(&x_);
    Accelerate(slope);
    Correct(pace.h);
  }
}

/// How much of the last correction to take back, so that what the last two left cancels (Anderson
/// 1965, of depth one; in one row the secant method).
double ExactIsland::SlopeOfSides() const {
  double up = 0, down = 0;
  for (std::size_t p = 0; p < x_.size(); ++p) {
    const double change = x_[p] - side_[p];
    up += x_[p] * change;
    down += change * change;
  }
  return down > 0 ? std::clamp(up / down, kSlopeLeast, kSlopeMost) : 0;
}

void ExactIsland::Accelerate(double slope) {
  shift_.resize(x_.size());
  last_.resize(x_.size());
  for (std::size_t p = 0; p < x_.size(); ++p) {
    const double step = x_[p];
    if (slope != 0) x_[p] = step - slope * (shift_[p] + step - last_[p]);
    last_[p] = step;
    shift_[p] = x_[p];
  }
}

/// While joints shut, contacts give way a little: with them a mechanism may be held in more ways
/// than it can move.
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
