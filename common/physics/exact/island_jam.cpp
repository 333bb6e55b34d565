/// ExactIsland: jams. Bodies clamped from more sides than they can give way to, by a press, rails
/// or joints, leave the system without a solution: then its impulses grow until rounding or the
/// rows' own share ends them, and what acts on another pose or in the engine makes speed of them.
/// Here is what tells such a substep from others, and what is done instead.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// What a substep that pushes out of an overlap may gain of kinetic energy, as a share, and J/kg.
constexpr double kGainShare = 0.05, kGainPerMass = 0.05;
/// Of that, what any substep may gain by itself; what the account of many may hold; and what is
/// left of a gain in it after a substep.
constexpr double kGainOnce = 2, kGainLasting = 4, kGainKept = 0.998;
/// A contact's impulse is taken for possible up to so many times the momentum there is.
constexpr double kImpulseMost = 50;
/// And what of it the next step begins with.
constexpr double kCarriedMost = 3;
/// What is led throws others at up to so many times its own speed.
constexpr double kLedMost = 4;
/// What a row's own entry is enlarged by in a jam, as a share: what contradicts itself by 1 m/s is
/// pressed with a thousand times the momentum, no more.
constexpr double kOwnOfJam = 1e-3;
/// m: an overlap that is undone without velocity in a jam.
constexpr double kDeep = 0.03;
/// m/s: what is pushed apart without velocity moves no faster; and what moves slower may sleep.
constexpr double kApartMost = 1, kApartStill = 0.01;

}  // namespace

/// N s: what a contact may be pressed with, so many times all momentum that may meet in one point
/// in this substep: of bodies against their mean and against what is moved by force, of gravity and
/// forces, and of motors.
double ExactIsland::MostImpulse(const Pace& pace) const {
  double mass = 0, px = 0, py = 0, led = 0;
  for (const ExactBody& q : bodies) {
    if (!q.moves()) {
      led = std::max(led, std::sqrt(q.vx * q.vx + q.vy * q.vy));
      continue;
    }
    mass += 1 / q.im;
    px += q.vx / q.im;
    py += q.vy / q.im;
  }
  const bool fixed = !bodies.back().moves();  // against what stands still, all of it counts
  if (fixed) px = py = 0;
  double sum = mass * led;
  for (const ExactBody& q : bodies) {
    if (!q.moves()) continue;
    const double vx = q.vx - px / mass, vy = q.vy - py / mass;
    sum += (std::sqrt(vx * vx + vy * vy) + pace.h * std::sqrt(q.ax * q.ax + q.ay * q.ay)) / q.im;
  }
  for (const Row& row : rows_) {
    if (row.kind == RowKind::kMotor) sum += row.most;
  }
  return kImpulseMost * sum;
}

double ExactIsland::MostCarried(const Pace& pace) const {
  return kCarriedMost / kImpulseMost * MostImpulse({pace.h * pace.substeps, 1});
}

void ExactIsland::BoundCarried() const {
  for (const ExactContact& contact : contacts) {
    b2Manifold& manifold = *contact.made->GetManifold();
    for (int i = 0; i < contact.count; ++i) {
      b2ManifoldPoint& point = manifold.points[i];
      if (static_cast<double>(point.normalImpulse) <= carried_) continue;
      point.tangentImpulse *= static_cast<float>(carried_) / point.normalImpulse;
      point.normalImpulse = static_cast<float>(carried_);
    }
  }
}

/// J: what motors, springs, belts and what is moved by force have done since `bodies_before_`, at
/// most. A motor gives nothing above the speed it is set to, and nothing gives more than it takes
/// to throw everything at kLedMost times the speed of what pushes.
double ExactIsland::WorkDone(double mass) {
  double work = 0, led = 0, fastest = 0;
  for (const Row& row : rows_) {
    const double pressed = std::fabs(row.base);
    if (row.kind == RowKind::kMotor) {
      work += pressed * std::fabs(row.target);
    } else if (row.kind == RowKind::kSoft) {
      const double after = std::fabs(Speed(row));
      bodies.swap(bodies_before_);
      work += pressed * (after + std::fabs(Speed(row))) / 2;
      bodies.swap(bodies_before_);
    }
    const double speed = std::max(std::fabs(row.fixed_speed),
                                  row.kind == RowKind::kFriction ? std::fabs(row.target) : 0);
    led += pressed * speed;
    if (row.bounded()) fastest = std::max(fastest, speed);
  }
  return work + std::min(led, kLedMost * kLedMost * mass * fastest * fastest / 2);
}

ExactIsland::Start ExactIsland::StartOf(const Pace& pace) const {
  Start start;
  start.energy = KineticOf(bodies);
  for (const ExactBody& q : bodies) start.mass += q.moves() ? 1 / q.im : 0;
  start.impulse = MostImpulse(pace);
  return start;
}

/// Whether the substep's impulses can be what happened: no contact presses with more than there is
/// to press with, and no more energy has come than was supplied, in this substep and in those
/// before it. `pushes`: contacts push out of an
/// overlap.
bool ExactIsland::Possible(const Start& start, bool pushes) {
  for (const Row& row : rows_) {
    if (row.kind == RowKind::kNormal && std::fabs(row.base) > start.impulse) return false;
  }
  const double most = kGainShare * start.energy + kGainPerMass * start.mass;
  double gained = KineticOf(bodies) - start.energy;
  if (pushes && gained > most) return false;
  if (gained > 0) gained -= WorkDone(start.mass);
  if (gained > kGainOnce * most || kGainKept * gained_ + gained > kGainLasting * most) return false;
  gained_ = std::max(0.0, kGainKept * gained_ + gained);
  return true;
}

/// Where nothing touches, poses alone are kept: SolveAhead keeps the velocities.
void ExactIsland::KeepPoses() {
  poses_.resize(5 * bodies.size());
  double* pose = poses_.data();
  for (const ExactBody& q : bodies) {
    *pose++ = q.x;
    *pose++ = q.y;
    *pose++ = q.a;
    *pose++ = q.c;
    *pose++ = q.s;
  }
}

/// A substep in which nothing touches and joints could not be shut, or energy came: a mechanism at
/// its dead end, a pulley without rope, which can do nothing but stop. If it gained more than was
/// supplied, it is calmed. `whole`: all of its kick was at the beginning.
void ExactIsland::Doubt(const Pace& pace, bool whole) {
  bodies_before_ = bodies;
  const double* pose = poses_.data();
  for (ExactBody& q : bodies_before_) {
    q.x = *pose++;
    q.y = *pose++;
    q.a = *pose++;
    q.c = *pose++;
    q.s = *pose++;
  }
  bodies.swap(bodies_before_);
  Restore(start_);
  const Start start = StartOf(pace);
  bodies.swap(bodies_before_);
  const double most = kGainShare * start.energy + kGainPerMass * start.mass;
  const double gained = KineticOf(bodies) - start.energy;
  if (gained <= kGainOnce * most || gained - WorkDone(start.mass) <= kGainOnce * most) return;
  rows_before_ = rows_;
  for (Row& row : rows_before_) row.total -= row.base;
  Calm(pace, start);
  if (!whole) Kick(pace.h / 2);
}

/// The substep as a blow without restitution: the velocities that are nearest to the ones that are
/// there, of those that neither part joints nor press anything together. With the bodies' own
/// inertias and no speed asked for but by motors and springs, that takes energy and never gives
/// any, however far the solve gets; rows give way a little, so that what contradicts itself is
/// pressed with bounded impulses. Joints are brought together without velocity.
void ExactIsland::Calm(const Pace& pace, const Start& start) {
  GoBack(pace);
  for (ExactBody& q : bodies) {
    if (q.moves()) q.ii = 1 / q.inertia;
  }
  for (Row& row : rows_) {
    row.base = row.lambda = row.warm = 0;
    if (row.state == RowState::kOut) continue;
    switch (row.kind) {
      case RowKind::kHard: row.target = 0; break;
      case RowKind::kSoft:
      case RowKind::kMotor: break;
      case RowKind::kLimit:
      case RowKind::kNormal: row.target = std::min(0.0, -row.error / pace.h); break;
      case RowKind::kFriction:
        row.most = 0;
        row.state = RowState::kLow;
        break;
    }
  }
  Assemble(kOwnOfJam, kOwnOfJam);
  Solve(true);
  double most = 0;
  for (const Row& row : rows_) {
    if (row.kind == RowKind::kNormal) most = std::max(most, std::fabs(row.lambda));
  }
  // What is told of it is what can be.
  const double share = std::min(1.0, start.impulse / std::max(most, 1e-30));
  for (Row& row : rows_) {
    row.base = row.warm = share * row.lambda;
    row.total += row.base;
    row.lambda = 0;
  }
  Move(pace.h);
  Fill(pace);
  BringTogether(pace);
  for (ExactBody& q : bodies) q.lasting *= kGainKept;
  gained_ *= kGainKept;
}

/// Overlaps that could not be undone by the substep's velocities are by a motion of its own, of
/// which no velocity is left: how fast the points part is what it is without a jam, joints stay
/// shut and what touches does not come nearer. Rows give way as in a blow, so that what pushes from
/// two sides stays between them.
void ExactIsland::PushApart(const Pace& pace) {
  const bool deep = std::any_of(rows_.begin(), rows_.end(), [](const Row& row) {
    return row.kind == RowKind::kNormal && row.error < -kDeep && row.state != RowState::kOut;
  });
  if (!deep) return;
  FillAgain(pace);
  rows_before_ = rows_;
  bodies_before_ = bodies;
  for (ExactBody& q : bodies) {
    q.vx = q.vy = q.w = 0;
    if (q.moves()) q.ii = 1 / q.inertia;
  }
  for (Row& row : rows_) {
    row.fixed_speed = row.base = row.lambda = row.warm = 0;
    const bool takes_part =
        row.kind == RowKind::kHard || row.kind == RowKind::kLimit || row.kind == RowKind::kNormal;
    if (!takes_part) row.state = RowState::kOut;
  }
  Assemble(kOwnOfJam, kOwnOfJam);
  Solve(true);
  double fastest = 0;
  for (const ExactBody& q : bodies)
    fastest = std::max(fastest, std::sqrt(q.vx * q.vx + q.vy * q.vy));
  stirred = stirred || fastest > kApartStill;
  Move(pace.h * std::min(1.0, kApartMost / std::max(fastest, 1e-30)));
  rows_ = rows_before_;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const ExactBody& was = bodies_before_[i];
    bodies[i].vx = was.vx;
    bodies[i].vy = was.vy;
    bodies[i].w = was.w;
    bodies[i].ii = was.ii;
  }
  Fill(pace);
  BringTogether(pace);
}

}  // namespace seam
