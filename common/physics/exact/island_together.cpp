/// ExactIsland: corrections of positions without velocity, before a step and after bodies were
/// moved from outside.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"
#include "common/physics/exact/shared_rules.h"

namespace seam {
namespace {

/// Errors from which joints are brought together before a step, and limits are restored, m or rad;
/// and the maximal correction in each try.
constexpr double kApart = 1e-5, kOverstepped = 5e-3, kTogetherMost = 0.2;
/// Error to which they are corrected then.
constexpr double kTogether = 1e-7;
constexpr int kTogetherTries = 8;
/// A try that enlarges the errors, or turns a body by more than kTurnMost, rad, is undone. The next
/// one treats all bodies as alike. After that corrections are damped: diagonal entries are enlarged
/// by kDamped, and by kDampedMore times as much after each failure.
constexpr double kTurnMost = 1, kDamped = 1e-3, kDampedMore = 10;
constexpr int kTriesThatFail = 12;
/// Bodies treated as alike are as hard to turn as a rod of so many times their length.
constexpr double kHardToTurn = 2;

}  // namespace

/// Returns the largest acceleration of a body, m/s2.
double ExactIsland::Pull() const {
  double most = 0;
  for (const ExactBody& q : bodies) most = std::max(most, std::sqrt(q.ax * q.ax + q.ay * q.ay));
  return most;
}

/// Reads the contacts before a step.
void ExactIsland::Look(const Pace& pace) {
  if (contacts.empty()) return;
  const double rest = kRestSteps * Pull() * pace.h * pace.substeps;
  for (ExactContact& contact : contacts) ReadContact(bodies, rest, &contact);
}

/// True if a row is corrected when joints are brought together.
bool ExactIsland::Shuts(RowKind kind, double error) {
  return kind == RowKind::kHard || (kind == RowKind::kLimit && error < -kOverstepped);
}

/// Adds a row to the sum and to the largest error of SquaresApart.
void ExactIsland::AddApart(RowKind kind, double error, double* sum, double* most) {
  if (!Shuts(kind, error)) return;
  *sum += error * error;
  *most = std::max(*most, kind == RowKind::kHard ? std::fabs(error) : 1.0);
}

/// Returns the sum of those rows' squared errors, m and rad. `most`: the largest error of
/// hard rows; at least 1 if a limit is exceeded.
double ExactIsland::SquaresApart(double* most) const {
  double sum = 0;
  *most = 0;
  for (const Row& row : rows_) AddApart(row.kind, row.error, &sum, most);
  return sum;
}

/// Returns the energy that gravity and forces would have to be given for the bodies' way from
/// `from`, J. Negative if they fell.
double ExactIsland::Lifted(const std::vector<ExactBody>& from) const {
  double sum = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const ExactBody &q = bodies[b], &was = from[b];
    if (!q.moves()) continue;
    sum -= (q.ax * (q.x - was.x) + q.ay * (q.y - was.y)) / q.im;
    sum -= q.inertia * q.turn * (q.a - was.a);
  }
  return sum;
}

void GoShare(const std::vector<ExactBody>& from, double share, std::vector<ExactBody>* bodies) {
  for (std::size_t b = 0; b < bodies->size(); ++b) {
    ExactBody& q = (*bodies)[b];
    const ExactBody& was = from[b];
    const double turn = share * (q.a - was.a);
    q.x = was.x + share * (q.x - was.x);
    q.y = was.y + share * (q.y - was.y);
    q.a = was.a;
    q.c = was.c;
    q.s = was.s;
    if (turn != 0) q.Turn(turn);
  }
}

/// Corrects joints that a message, an edit or continuous collision has pulled apart since the last
/// step, and limits that are exceeded: positions only, with the least motion weighted by mass, and
/// without velocity. In chains of light links that are almost straight, that motion would turn the
/// links, where only moving the load at their end helps. So if it fails, all bodies are treated as
/// alike, and then it is damped (Levenberg 1944, Marquardt 1963). The motion ends where it has
/// lifted the bodies by `lift_most`, J: what a jam holds apart for long may come together at once.
void ExactIsland::BringTogether(const Pace& pace, double lift_most) {
  held_.clear();
  double most = 0, damping = kHardShare, lifted = 0;
  double apart = SquaresApart(&most);
  bool alike = false;
  for (int tries = 0, failed = 0; tries - failed < kTogetherTries && failed < kTriesThatFail;
       ++tries) {
    if (most <= (tries == 0 ? kApart : kTogether)) break;
    if (held_.empty()) {
      for (const Row& row : rows_) held_.push_back(row.state);
    }
    bodies_before_ = bodies;
    if (alike) MakeAlike();
    ShiftTogether(damping);
    if (alike) CopyMasses(bodies_before_);
    Fill(pace);
    double turned = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      turned = std::max(turned, std::fabs(bodies[b].a - bodies_before_[b].a));
    }
    const double now = SquaresApart(&most);
    // If limits are relaxed no try restores them.
    if (relaxed_ || (now <= apart && turned <= kTurnMost)) {
      apart = now;
      damping = std::max(kHardShare, damping / kDampedMore);
      const double more = Lifted(bodies_before_);
      lifted += more;
      if (lifted <= lift_most) continue;
      GoShare(bodies_before_, 1 - (lifted - lift_most) / more, &bodies);
      Fill(pace);
      break;
    }
    bodies = bodies_before_;
    Fill(pace);
    apart = SquaresApart(&most);
    if (alike) damping = std::max(kDamped, damping * kDampedMore);
    alike = true;
    ++failed;
  }
  for (std::size_t i = 0; i < held_.size(); ++i) rows_[i].state = held_[i];
  held_.clear();
}

/// Gives all bodies the same mass, for one solve.
void ExactIsland::MakeAlike() {
  for (ExactBody& q : bodies) {
    if (!q.moves()) continue;
    q.ii = 1 / (kHardToTurn * kHardToTurn * q.inertia * q.im);
    q.im = 1;
  }
  rewritten_ = true;
}

void ExactIsland::CopyMasses(const std::vector<ExactBody>& from) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].im = from[b].im;
    bodies[b].ii = from[b].ii;
  }
  rewritten_ = true;
}

/// Shifts bodies so as to close all rows at once in linear approximation.
void ExactIsland::ShiftTogether(double damping) {
  std::fill(x_.begin(), x_.end(), 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    const bool shuts = Shuts(row.kind, row.error);
    const bool held = row.kind == RowKind::kNormal && row.error <= 0;
    row.state = shuts || held ? RowState::kFree : RowState::kOut;
    if (!shuts || place_[i] < 0) continue;
    x_[static_cast<std::size_t>(place_[i])] = std::clamp(-row.error, -kTogetherMost, kTogetherMost);
  }
  Assemble(damping);
  SoftenContacts();
  Factor();
  matrix_.Solve(&x_);
  for (std::size_t p = 0; p < row_at_.size(); ++p) Shift(*by_place_[p], x_[p]);
}

void ExactIsland::Rejoin(const Pace& pace, bool struck) {
  Look(pace);
  Fill(pace);
  BringTogether(pace, kUnbounded);
  if (!struck) return;
  for (Row& row : rows_) {
    row.base = row.lambda = row.total = 0;
    row.state = row.bounded() && row.error > 0 ? RowState::kLow : RowState::kFree;
    if (row.kind == RowKind::kFriction) row.state = RowState::kOut;
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (int i = 0; i < contacts[c].count && contacts[c].restitution > 0; ++i) {
      At(contact_row_[c] + 2 * i).state = RowState::kOut;  // its impact comes in the next step
    }
  }
  SolveAtEnd(pace, kHardShare, kFrictionRounds);
}

/// Shifts positions as an impulse of `by` would in one second: m or rad.
void ExactIsland::Shift(const Row& row, double by) {
  if (by == 0) return;
  for (int e = 0; e < row.ends; ++e) {
    const RowEnd& end = row.end[e];
    ExactBody& q = Body(end.body);
    q.x += by * end.mj[0];
    q.y += by * end.mj[1];
    q.Turn(by * end.mj[2]);
  }
}

}  // namespace seam
