/// ExactIsland: jams. Bodies clamped by a press, rails or joints from more sides than they can give
/// way to make the system unsolvable: then its impulses grow until rounding or the enlarged
/// diagonal ends them, and would turn into speed at another pose or in the engine. This file
/// detects such a substep and solves it differently.

#include <algorithm>
#include <array>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Kinetic energy that a substep may gain while it resolves an overlap, as a share, and J/kg.
constexpr double kGainShare = 0.05, kGainPerMass = 0.05;
/// Multiples of that: the gain that any substep may have unexplained; the accumulated gain of many.
/// kGainKept: share of that sum left per substep.
constexpr double kGainOnce = 2, kGainLasting = 4, kGainKept = 0.998;
/// Limit of a contact's impulse, as a multiple of all momentum.
constexpr double kJamImpulseMost = 50;
/// The same limit for the next step's warm start.
constexpr double kCarriedMost = 3;
/// Bodies are thrown at up to this many times the speed of a kinematic one.
constexpr double kLedMost = 4;
/// Share by which diagonal entries are enlarged in a jam: a contradiction of 1 m/s then makes an
/// impulse of at most a thousand times the momentum.
constexpr double kDiagonalOfJam = 1e-3;
/// m: an overlap that is resolved without velocity in a jam.
constexpr double kDeep = 0.03;
/// m/s: maximal speed of that motion; and the speed below which it may be ignored for sleep.
constexpr double kApartMost = 1, kApartStill = 0.01;
/// Numbers of a body's kept pose: place, angle, its cosine and sine.
constexpr std::size_t kPoseNumbers = 5;

}  // namespace

/// Returns the maximal impulse of a contact, N s: a multiple of all momentum that may meet in one
/// point in this substep. That is the momentum of bodies relative to their mean and to kinematic
/// bodies, of gravity and forces, and of motors.
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
  const bool fixed = !bodies.back().moves();  // relative to something stationary, all of it counts
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
  return kJamImpulseMost * sum;
}

double ExactIsland::MostWarmStart(const Pace& pace) const {
  return kCarriedMost / kJamImpulseMost * MostImpulse({pace.h * pace.substeps, 1});
}

void ExactIsland::BoundWarmStart() const {
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

/// Returns an upper bound of the work of motors, springs, belts and kinematic bodies since
/// `bodies_before_`, J. A motor does no work above its set speed, and belts and kinematic bodies do
/// no more than throws all bodies at kLedMost times their speed.
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
  start.lift = LiftMost(pace.h);
  for (const ExactBody& q : bodies) {
    if (!q.moves()) continue;
    const double h = pace.h;
    const double along = q.ax * (q.vx - h * q.ax / 2) + q.ay * (q.vy - h * q.ay / 2);
    start.kick += h * (along / q.im + q.inertia * q.turn * (q.w - h * q.turn / 2));
  }
  return start;
}

/// Returns the energy of lifting all bodies at kApartMost for `time`, J: as far as overlaps and
/// joints that a jam holds apart may be resolved in that time, although nothing supplies it.
double ExactIsland::LiftMost(double time) const {
  double weight = 0;
  for (const ExactBody& q : bodies) {
    if (q.moves()) weight += std::sqrt(q.ax * q.ax + q.ay * q.ay) / q.im;
  }
  return kApartMost * time * weight;
}

/// True if the substep's impulses are possible: no contact exceeds its maximal impulse, and no more
/// energy was gained than supplied, in this substep and in those before it. That of places counts
/// too: closing joints or resolving overlaps can lift bodies at any speed, which the solve at the
/// end then takes from them. `pushes`: contacts resolve an overlap.
bool ExactIsland::Possible(const Start& start, bool pushes) {
  for (const Row& row : rows_) {
    if (row.kind == RowKind::kNormal && std::fabs(row.base) > start.impulse) return false;
  }
  const double most = kGainShare * start.energy + kGainPerMass * start.mass;
  double gained = KineticOf(bodies) - start.energy;
  if (pushes && gained > most) return false;
  const double lifted = gained + start.kick + Lifted(bodies_before_) - start.lift;
  const double work = gained > 0 || lifted > kGainOnce * most ? WorkDone(start.mass) : 0;
  if (lifted - work > kGainOnce * most) return false;
  if (gained > 0) gained -= work;
  if (gained > kGainOnce * most || kGainKept * gained_ + gained > kGainLasting * most) return false;
  gained_ = std::max(0.0, kGainKept * gained_ + gained);
  return true;
}

/// Saves poses. With the velocities that SolveAhead saves, that is enough to go back.
void ExactIsland::KeepPoses() {
  poses_.resize(kPoseNumbers * bodies.size());
  double* pose = poses_.data();
  for (const ExactBody& q : bodies) {
    *pose++ = q.x;
    *pose++ = q.y;
    *pose++ = q.a;
    *pose++ = q.c;
    *pose++ = q.s;
  }
}

/// Returns bodies to the saved poses.
void ExactIsland::RestorePoses(std::vector<ExactBody>* to) const {
  const double* pose = poses_.data();
  for (ExactBody& q : *to) {
    q.x = *pose++;
    q.y = *pose++;
    q.a = *pose++;
    q.c = *pose++;
    q.s = *pose++;
  }
}

/// True if a substep without contacts has gained more energy than was supplied.
bool ExactIsland::Gains(const Start& start) {
  const double most = kGainOnce * (kGainShare * start.energy + kGainPerMass * start.mass);
  const double gained = KineticOf(bodies) - start.energy;
  return gained > most && gained - WorkDone(start.mass) > most;
}

/// Checks a substep without contacts in which joints could not be satisfied or energy grew: a
/// mechanism at its dead centre or a pulley without rope can only stop. Solves it as taut if it is,
/// and calms it if it gained more than was supplied. `whole`: all of its kick was at the beginning.
/// `shut`: its joints are closed.
void ExactIsland::CheckWithoutContacts(const Pace& pace, bool whole, bool shut) {
  bodies_before_ = bodies;
  RestorePoses(&bodies_before_);
  bodies.swap(bodies_before_);
  Restore(start_);
  const Start start = StartOf(pace);
  const bool taut = !shut && Taut(pace.h);
  bodies.swap(bodies_before_);
  if (!taut && !Gains(start)) return;
  rows_before_ = rows_;
  for (Row& row : rows_before_) {
    row.total -= row.base;
    row.base = 0;
  }
  if (taut) {
    GoBack(pace);
    if (!whole) Kick(pace.h / 2);
    if (TautCourse(pace) && !Gains(start)) return;
  }
  Calm(pace, start);
  if (!whole) Kick(pace.h / 2);
}

/// Solves the substep as an inelastic impact: finds the velocities nearest to the current ones that
/// neither separate joints nor press contacts together. With the bodies' own inertias, and target
/// speeds only for motors and springs, that takes energy and never adds any, however far the solve
/// gets. Rows give way a little, so that contradictions make bounded impulses. Joints are brought
/// together without velocity, after which the velocities agree with the way.
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
  Assemble(kDiagonalOfJam, kDiagonalOfJam);
  Solve(true);
  double most = 0;
  for (const Row& row : rows_) {
    if (row.kind == RowKind::kNormal) most = std::max(most, std::fabs(row.lambda));
  }
  // The reported impulses are bounded by the possible.
  const double share = std::min(1.0, start.impulse / std::max(most, 1e-30));
  for (Row& row : rows_) {
    row.base = row.warm = share * row.lambda;
    row.total += row.base;
    row.lambda = 0;
  }
  KeepPoses();
  Move(pace.h);
  const double lift_most = start.lift + std::max(0.0, -Lifted(bodies_before_));
  Fill(pace);
  BringTogether(pace, lift_most);
  Agree(pace.h);
  for (ExactBody& q : bodies) q.lasting *= kGainKept;
  gained_ *= kGainKept;
}

/// Changes velocities towards those of the way from the kept poses to here, as far as that takes
/// kinetic energy. Rows that give way let a load on a taut chain sink, and the joints lift it again
/// without velocity: its speed would grow by gravity for ever, while it stays where it is.
void ExactIsland::Agree(double h) {
  const auto left = [h](const ExactBody& q, const double* pose) {
    return std::array<double, 3>{(q.x - pose[0]) / h - q.vx, (q.y - pose[1]) / h - q.vy,
                                 (q.a - pose[2]) / h - q.w};
  };
  double along = 0, square = 0;
  const double* pose = poses_.data();
  for (const ExactBody& q : bodies) {
    const std::array<double, 3> by = left(q, pose);
    pose += kPoseNumbers;
    if (!q.moves()) continue;
    along += (by[0] * q.vx + by[1] * q.vy) / q.im + by[2] * q.w * q.inertia;
    square += (by[0] * by[0] + by[1] * by[1]) / q.im + by[2] * by[2] * q.inertia;
  }
  if (along >= 0) return;
  const double share = std::min(1.0, -along / square);
  pose = poses_.data();
  for (ExactBody& q : bodies) {
    const std::array<double, 3> by = left(q, pose);
    pose += kPoseNumbers;
    if (!q.moves()) continue;
    q.vx += share * by[0];
    q.vy += share * by[1];
    q.w += share * by[2];
  }
}

/// Resolves overlaps that remain after a jammed substep by a separate motion that leaves no
/// velocity. Points separate as fast as without a jam, joints stay satisfied and touching points do
/// not approach. Rows give way as in an impact, so that a body pushed from two sides stays between
/// them.
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
  Assemble(kDiagonalOfJam, kDiagonalOfJam);
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
  BringTogether(pace, LiftMost(pace.h));
}

}  // namespace seam
