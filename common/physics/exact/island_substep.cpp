/// ExactIsland: a substep. Joints by RATTLE (Andersen 1983; Hairer, Lubich and Wanner 2006,
/// VII.1.4): the impulses act along the rows of the old pose until the new pose satisfies the
/// joints, then the velocities are projected at the new one. Contacts, limits and motors take part
/// in both solves.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"
#include "common/physics/exact/shared_rules.h"

namespace seam {
namespace {

/// Share of the rotational stiffness by tension that is added to a body's inertia (after Tournier,
/// Nesme, Gilles and Faure 2015: as much as keeps the step stable).
constexpr double kTensionShare = 0.35;
/// It counts in full from this ratio of stiffness to inertia on, and below kStiffFrom not at all.
constexpr double kStiffTo = 1, kStiffFrom = 0.4;
/// A little less than that, to allow for rounding.
constexpr double kSurelyLittle = 0.39;
/// Limit of the stiffness, as a multiple of the inertia: a jam may report any tension.
constexpr double kStiffMost = 100;
/// Growth of energy from which a substep without contacts is checked.
constexpr double kMuchMore = 2;
/// A motor that lacks this much speed applies its maximum, rad/s or m/s.
constexpr double kUtmost = 50;

}  // namespace

void ExactIsland::Step(const Pace& pace, bool warm) {
  stirred = false;
  work_ = 0;
  Look(pace);
  FillFirst(pace);
  const double share = warm ? 1.0 / pace.substeps : 0;
  for (Row& row : rows_) row.lambda = row.total = 0;
  for (const Held& held : joints) LoadImpulses(*held.joint, share, rows_.data() + held.row);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].count > 0) LoadImpulses(contacts[c], share, &At(contact_row_[c]));
  }
  Tension(pace.h);
  for (ExactBody& q : bodies) {  // impacts are among the last step's impulses, and are no tension
    if (q.lasting > 0) q.stiffness = std::min(q.stiffness, q.lasting);
  }
  for (Row& row : rows_) {  // a motor far below its speed starts at its maximum
    if (row.kind != RowKind::kMotor) continue;
    const double lacks = row.target - Speed(row);
    if (std::fabs(lacks) > kUtmost) row.state = lacks > 0 ? RowState::kHigh : RowState::kLow;
  }
  BringTogether(pace, displaced ? kUnbounded : LiftMost(pace.h * pace.substeps));
  if (!contacts.empty()) carried_ = MostWarmStart(pace);
  for (int i = 0; i < pace.substeps; ++i) {
    if (i > 0) FillAgain(pace);
    Substep(pace);
    if (given_up()) return;
  }
}

void ExactIsland::Substep(const Pace& pace) {
  for (ExactBody& q : bodies) {
    if (q.moves()) q.ii = 1 / Stiffened(q);
  }
  for (Row& row : rows_) row.base = 0;
  if (FindImpacts()) {
    Impact(MostImpulse(pace));
    Fill(pace);
    FindImpacts();  // approaches caused by these impacts are solved in the next substep
  }
  // With contacts or springs, half a kick would be left over: only projections take it back.
  const bool whole = !contacts.empty() || std::any_of(rows_.begin(), rows_.end(), [](const Row& r) {
    return r.kind == RowKind::kSoft;
  });
  Depart();
  Kick(whole ? pace.h : pace.h / 2);
  if (contacts.empty()) {
    KeepPoses();
    const double most = kMuchMore * KineticOf(bodies);
    const bool shut = Course(pace, whole);
    if (!shut || KineticOf(bodies) > most) CheckWithoutContacts(pace, whole, shut);
    return;
  }
  bodies_before_ = bodies;
  rows_before_ = rows_;
  const Start start = StartOf(pace);
  const bool pushes = PushesOut();
  if (Taut(pace.h)) {
    if (TautCourse(pace) && Possible(start, false)) {
      PushTautApart(pace);
      return;
    }
    GoBack(pace);
  }
  Course(pace, whole);
  if (Possible(start, pushes)) return;
  // In a jam, contacts that resolve an overlap add energy that the solve at the end cannot take
  // back: try without that.
  if (pushes) {
    GoBack(pace);
    for (Row& row : rows_) {
      if (row.kind == RowKind::kNormal) row.target = std::min(0.0, row.target);
    }
    Course(pace, whole);
    if (Possible(start, false)) {
      PushApart(pace);
      return;
    }
  }
  Calm(pace, start);
  PushApart(pace);
}

/// Returns to the state before the substep's course.
void ExactIsland::GoBack(const Pace& pace) {
  bodies = bodies_before_;
  rows_ = rows_before_;
  Fill(pace);
}

bool ExactIsland::PushesOut() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const Row& row) {
    return row.kind == RowKind::kNormal && row.target > 0 && row.state != RowState::kOut;
  });
}

/// Advances the substep from its kick to its end. `whole`: the kick was whole, not half. Returns
/// true if joints are closed.
bool ExactIsland::Course(const Pace& pace, bool whole) {
  SolveAhead(pace);
  Move(pace.h);
  const bool shut = ShutJoints(pace);
  if (!whole) Kick(pace.h / 2);
  SolveAtEnd(pace, kHardShare, kFrictionRounds);
  Arrive();
  for (ExactBody& q : bodies) q.lasting = std::max(q.stiffness, kLasts * q.lasting);
  return shut;
}

void ExactIsland::Kick(double h) {
  for (ExactBody& q : bodies) {
    if (!q.moves()) continue;
    q.vx = (q.vx + h * q.ax) / (1 + h * q.slow);
    q.vy = (q.vy + h * q.ay) / (1 + h * q.slow);
    q.w = (q.w + h * q.turn) / (1 + h * q.slow_spin);
  }
}

/// Returns a body's inertia including tension, kg m2. A small tension is ignored, so that a
/// pendulum stays exact.
double ExactIsland::Stiffened(const ExactBody& q) {
  const double tense = std::min(std::max(q.stiffness, q.lasting), kStiffMost * q.inertia);
  if (tense < kSurelyLittle * q.inertia) return q.inertia;
  const double share = (tense / q.inertia - kStiffFrom) / (kStiffTo - kStiffFrom);
  return q.inertia + kTensionShare * std::max(0.0, tense) * std::clamp(share, 0.0, 1.0);
}

void ExactIsland::Tension(double h) {
  for (ExactBody& q : bodies) q.stiffness = 0;
  for (const Row& row : rows_) {
    const double pull = h * (row.base + row.lambda);
    if (row.tense_a >= 0) Body(row.tense_a).stiffness += pull * row.stiff_a;
    if (row.tense_b >= 0) Body(row.tense_b).stiffness += pull * row.stiff_b;
  }
}

/// Enlarges inertias that are too small for the tension just found. False if none is.
bool ExactIsland::Stiffer() {
  bool lacks = false;
  for (const ExactBody& q : bodies) {
    lacks = lacks || (q.moves() && Stiffened(q) * q.ii > kStifferBy);
  }
  if (!lacks) return false;
  for (ExactBody& q : bodies) {
    if (q.moves()) q.ii = std::min(q.ii, 1 / Stiffened(q));
  }
  return true;
}

void ExactIsland::SolveAhead(const Pace& pace) {
  for (Row& row : rows_) row.goal = row.error + pace.h * row.target;
  Save(&start_);
  for (int tries = 0;; ++tries) {
    Assemble();
    Solve(true);
    if (tries == kStifferTries) break;
    Tension(pace.h);
    if (!Stiffer()) break;
    Restore(start_);
  }
  for (Row& row : rows_) row.base += row.lambda;
}

void ExactIsland::Move(double h) {
  turned_ = 0;
  for (ExactBody& q : bodies) {
    q.x += h * q.vx;
    q.y += h * q.vy;
    if (q.w != 0) q.Turn(h * q.w);
    turned_ = std::max(turned_, std::fabs(h * q.w));
  }
}

void ExactIsland::SolveAtEnd(const Pace& pace, double hard, int rounds) {
  Fill(pace);
  for (Row& row : rows_) {
    row.lambda = 0;
    if (row.state == RowState::kOut) continue;
    switch (row.kind) {
      case RowKind::kHard: row.target = 0; break;
      case RowKind::kSoft:  // acts for the whole substep already
        row.state = RowState::kOut;
        break;
      case RowKind::kMotor:
        row.lo = -row.most - row.base;
        row.hi = row.most - row.base;
        break;
      case RowKind::kLimit:
      case RowKind::kNormal:
        row.lo = std::min(0.0, -row.base);
        row.target = row.error > kReached ? -row.error / pace.h : 0;
        break;
      case RowKind::kFriction: break;
    }
  }
  Assemble(hard);
  Solve(false, rounds);
  for (Row& row : rows_) {
    row.base += row.lambda;
    row.total += row.base;
    row.warm = row.base;
    row.lambda = 0;
    if (row.kind == RowKind::kSoft) row.state = RowState::kFree;
  }
  Tension(pace.h);
}

}  // namespace seam
