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
/// The matrix is made anew in them when one leaves more than this share. Not before: impulses that
/// act along the rows of the old pose keep the energy, and those along other rows lose some. But
/// where contacts press, which takes energy anyway, as soon as a body turns by more than that, rad.
constexpr double kSlow = 0.3, kTurnsFast = 0.25;
/// Joints that hold what others hold already contradict each other by what single precision makes
/// of their lengths. So where a correction with a new matrix leaves more than this share of less
/// than that, m or rad, they are shut as far as they can be.
constexpr double kStalled = 0.7, kShutAtBest = 1e-5;
/// Of the last correction, what the next one takes back or adds at most, as a share.
constexpr double kSlopeLeast = -1, kSlopeMost = 0.5;

}  // namespace

/// The rows that shut, in the order of places: their states stay while joints are shut.
void ExactIsland::FindShutting() {
  shutting_.clear();
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    const Row& row = *by_place_[p];
    const bool shuts = row.kind == RowKind::kHard || row.kind == RowKind::kLimit;
    if (!shuts || row.state != RowState::kFree) continue;
    shutting_.push_back({static_cast<std::size_t>(row_at_[p]), p, row.goal, 0});
  }
}

/// Joints' errors less their goals, as sides of the system. Returns the greatest, m or rad. `anew`:
/// the rows are written as the bodies are now. `slope`: how much of the last correction to take
/// back, so that what the last two left cancels (Anderson 1965, of depth one; in one row the secant
/// method).
double ExactIsland::SidesOfErrors(const Pace& pace, bool anew, double* slope) {
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

/// Adds the solution to the substep's impulses, and moves the bodies by what it does.
void ExactIsland::Correct(double h) {
  const double* const x = x_.data();
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    Row& row = *by_place_[p];
    if (row.state == RowState::kFree && x[p] != 0) row.base += x[p];
  }
  const Act* act = acts_.data();
  for (ExactBody& q : bodies) {
    if (!q.moves()) break;  // those that do come first
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

/// False: they were not found shut after the last correction that there is.
bool ExactIsland::ShutJoints(const Pace& pace) {
  const auto presses = [](const Row& row) {
    return row.kind == RowKind::kNormal && row.state == RowState::kFree;
  };
  bool anew = turned_ > kTurnsFast && std::any_of(rows_.begin(), rows_.end(), presses);
  double last = kUnbounded;
  FindShutting();
  for (int tries = 0; tries < kCorrections; ++tries) {
    double slope = 0;
    const double far = SidesOfErrors(pace, anew, &slope);
    if (far < (contacts.empty() ? kShut : kShutTouching)) return true;
    if (anew && far < kShutAtBest && far > kStalled * last) return true;
    if (tries == 0 && !contacts.empty() && !relaxed_) SoftenContacts();
    if (!anew && tries > 0 && far > kSlow * last) {
      anew = true;
      SidesOfErrors(pace, anew, &slope);
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

/// Takes `slope` of the last correction back.
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
