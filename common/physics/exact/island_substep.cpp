/// ExactIsland: a substep. Joints by RATTLE (Andersen 1983; Hairer, Lubich and Wanner 2006,
/// VII.1.4): the impulses act along the rows of the old pose until the new pose satisfies the
/// joints, then the velocities are projected at the new one. Contacts, limits and motors take part
/// in both solves.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Of the stiffness that tension gives a body against turning, the share that its inertia is
/// enlarged by (after Tournier, Nesme, Gilles and Faure 2015: as much as keeps the step stable).
constexpr double kStiffness = 0.25;
/// It counts in full from this stiffness over inertia on, and below the other not at all.
constexpr double kStiffTo = 1, kStiffFrom = 0.4;
/// What is left of it after a substep when the tension is gone: inertias that jump make noise.
constexpr double kLasts = 0.99;
/// The inertia is found anew while it lacks more than this.
constexpr double kStifferBy = 1.1;
constexpr int kStifferTries = 4;
/// What a substep may gain of kinetic energy by itself, as a share, and J/kg: motors do, too.
constexpr double kGainShare = 0.05, kGainPerMass = 0.05;
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
/// A limit or a contact that is nearer than this is reached, m or rad.
constexpr double kReached = 1e-6;
/// Halvings of the restitution when a blow with friction would gain energy, the last is 0.
constexpr int kSofterTries = 3;
/// Joints that are farther apart than this, m or rad, are moved together before a step, and limits
/// that are overstepped by more; by at most so much for each try.
constexpr double kApart = 1e-5, kOverstepped = 5e-3, kTogetherMost = 0.2;
constexpr int kTogetherTries = 4;
/// A motor that lacks so much speed does all it may, rad/s or m/s.
constexpr double kUtmost = 50;
/// What falls for so many steps has a blow; what falls less lies.
constexpr double kRestSteps = 4;
/// A joint has at most so many rows, and a row so many ends.
constexpr int kRowsMost = 6, kEndsMost = 4;

/// kg m2, what the tension makes of a body's inertia. Little tension makes nothing of it, so that
/// a pendulum stays as exact as it is.
double Stiffened(const ExactBody& q) {
  const double tense = std::max(q.stiffness, q.lasting);
  const double share = (tense / q.inertia - kStiffFrom) / (kStiffTo - kStiffFrom);
  return q.inertia + kStiffness * std::max(0.0, tense) * std::clamp(share, 0.0, 1.0);
}

double Kinetic(const ExactBody& q) {
  return q.moves() ? ((q.vx * q.vx + q.vy * q.vy) / q.im + q.inertia * q.w * q.w) / 2 : 0;
}

double KineticOf(const std::vector<ExactBody>& bodies) {
  double sum = 0;
  for (const ExactBody& q : bodies) sum += Kinetic(q);
  return sum;
}

}  // namespace

void ExactIsland::Step(const Pace& pace, bool warm) {
  const double pull = Pull();
  for (ExactContact& contact : contacts)
    ReadContact(bodies, kRestSteps * pull * pace.h * pace.substeps, &contact);
  Fill(pace);
  const double share = warm ? 1.0 / pace.substeps : 0;
  for (Row& row : rows_) row.lambda = row.total = 0;
  for (const Held& held : joints) LoadImpulses(*held.joint, share, &At(held.row));
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].count > 0) LoadImpulses(contacts[c], share, &At(contact_row_[c]));
  }
  Tension(pace.h);
  for (Row& row : rows_) {  // a motor that is to do its utmost, whatever it did last
    if (row.kind != RowKind::kMotor) continue;
    const double lacks = row.target - Speed(row);
    if (std::fabs(lacks) > kUtmost) row.state = lacks > 0 ? RowState::kHigh : RowState::kLow;
  }
  BringTogether(pace);
  for (int i = 0; i < pace.substeps; ++i) {
    if (i > 0) Fill(pace);
    Substep(pace);
  }
}

/// The greatest acceleration that acts on a body, m/s2.
double ExactIsland::Pull() const {
  double most = 0;
  for (const ExactBody& q : bodies) most = std::max(most, std::sqrt(q.ax * q.ax + q.ay * q.ay));
  return most;
}

/// What was put apart since the last step, by a message, an edit or continuous collision, is moved
/// together, and limits that are overstepped are gone back to: positions only, as little as the
/// masses allow, no velocity comes of it.
void ExactIsland::BringTogether(const Pace& pace) {
  held_.clear();
  for (int tries = 0; tries < kTogetherTries; ++tries) {
    bool apart = false;
    for (const Row& row : rows_) {
      apart = apart || (row.kind == RowKind::kHard && std::fabs(row.error) > kApart) ||
              (row.kind == RowKind::kLimit && row.error < -kOverstepped);
    }
    if (!apart) break;
    if (held_.empty()) {
      for (const Row& row : rows_) held_.push_back(row.state);
    }
    std::fill(x_.begin(), x_.end(), 0.0);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      Row& row = rows_[i];
      const bool shuts =
          row.kind == RowKind::kHard || (row.kind == RowKind::kLimit && row.error < -kOverstepped);
      const bool held = row.kind == RowKind::kNormal && row.error <= 0;
      row.state = shuts || held ? RowState::kFree : RowState::kOut;
      if (!shuts || place_[i] < 0) continue;
      x_[static_cast<std::size_t>(place_[i])] =
          std::clamp(-row.error, -kTogetherMost, kTogetherMost);
    }
    Assemble();
    SoftenContacts();
    Factor();
    matrix_.Solve(&x_);
    for (std::size_t p = 0; p < row_at_.size(); ++p) Shift(At(row_at_[p]), x_[p]);
    Fill(pace);
  }
  for (std::size_t i = 0; i < held_.size(); ++i) rows_[i].state = held_[i];
  held_.clear();
}

void ExactIsland::Rejoin(const Pace& pace, bool struck) {
  const double pull = Pull();
  for (ExactContact& contact : contacts)
    ReadContact(bodies, kRestSteps * pull * pace.h * pace.substeps, &contact);
  Fill(pace);
  BringTogether(pace);
  if (!struck) return;
  for (Row& row : rows_) {
    row.base = row.lambda = row.total = 0;
    row.state = row.bounded() && row.error > 0 ? RowState::kLow : RowState::kFree;
    if (row.kind == RowKind::kFriction) row.state = RowState::kOut;
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (int i = 0; i < contacts[c].count && contacts[c].restitution > 0; ++i) {
      At(contact_row_[c] + 2 * i).state = RowState::kOut;  // its blow comes in the next step
    }
  }
  SolveAtEnd(pace);
}

/// What an impulse of `by` would do in a second: m or rad.
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

void ExactIsland::Substep(const Pace& pace) {
  for (ExactBody& q : bodies) {
    if (q.moves()) q.ii = 1 / Stiffened(q);
  }
  for (Row& row : rows_) row.base = 0;
  if (FindImpacts()) {
    Impact();
    Fill(pace);
    FindImpacts();  // what comes at a contact by another's blow hits in the next substep
  }
  const bool touches = !contacts.empty();
  Kick(touches ? pace.h : pace.h / 2);
  if (!touches || !PushesOut()) {
    Course(pace, touches);
    return;
  }
  // Where a mechanism is jammed, contacts that push out of an overlap make energy that the solve at
  // the end cannot take back: then without pushing out.
  bodies_before_ = bodies;
  double mass = 0;
  for (const ExactBody& q : bodies) mass += q.moves() ? 1 / q.im : 0;
  const double most = (1 + kGainShare) * KineticOf(bodies) + kGainPerMass * mass;
  rows_before_ = rows_;
  Course(pace, touches);
  if (KineticOf(bodies) <= most) return;
  bodies = bodies_before_;
  rows_ = rows_before_;
  Fill(pace);
  for (Row& row : rows_) {
    if (row.kind == RowKind::kNormal) row.target = std::min(0.0, row.target);
  }
  Course(pace, touches);
}

bool ExactIsland::PushesOut() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const Row& row) {
    return row.kind == RowKind::kNormal && row.target > 0 && row.state != RowState::kOut;
  });
}

/// The substep from its kick to its end.
void ExactIsland::Course(const Pace& pace, bool touches) {
  SolveAhead(pace);
  Move(pace.h);
  ShutJoints(pace);
  if (!touches) Kick(pace.h / 2);
  SolveAtEnd(pace);
  for (ExactBody& q : bodies) q.lasting = std::max(q.stiffness, kLasts * q.lasting);
}

void ExactIsland::Kick(double h) {
  for (ExactBody& q : bodies) {
    if (!q.moves()) continue;
    q.vx = (q.vx + h * q.ax) / (1 + h * q.slow);
    q.vy = (q.vy + h * q.ay) / (1 + h * q.slow);
    q.w = (q.w + h * q.turn) / (1 + h * q.slow_spin);
  }
}

void ExactIsland::Tension(double h) {
  for (ExactBody& q : bodies) q.stiffness = 0;
  for (const Row& row : rows_) {
    const double pull = h * (row.base + row.lambda);
    if (row.tense_a >= 0) Body(row.tense_a).stiffness += pull * row.stiff_a;
    if (row.tense_b >= 0) Body(row.tense_b).stiffness += pull * row.stiff_b;
  }
}

/// Enlarges inertias that are too small for the tension just found. False: none is.
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

void ExactIsland::ShutJoints(const Pace& pace) {
  bool anew = turned_ > kTurnsFast;
  double last = kUnbounded;
  Row now[kRowsMost];
  RowEnd ends[kRowsMost * kEndsMost];
  for (int i = 0; i < kRowsMost; ++i) now[i].end = ends + i * kEndsMost;
  for (int tries = 0; tries < kCorrections; ++tries) {
    double far = 0;
    std::fill(x_.begin(), x_.end(), 0.0);
    for (const Held& held : joints) {
      double errors[kRowsMost];
      if (anew) {
        FillJoint(*held.joint, held.ends, bodies, pace, now);
        for (int i = 0; i < held.rows; ++i) errors[i] = now[i].error;
      } else if (!PointErrors(*held.joint, held.ends, bodies, errors)) {
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
        x_[static_cast<std::size_t>(place)] =
            std::clamp(-off / pace.h, -kShutFastest, kShutFastest);
        if (anew) std::copy_n(now[i].end, row.ends, row.end);
      }
    }
    if (far < (contacts.empty() ? kShut : kShutTouching)) break;
    if (tries == 0 && !contacts.empty() && !relaxed_) SoftenContacts();
    if (!anew && tries > 1 && far > kSlow * last) {
      anew = true;
      continue;
    }
    last = far;
    if (anew) {
      Assemble();
      if (!contacts.empty()) SoftenContacts();
    }
    Factor();
    matrix_.Solve(&x_);
    for (std::size_t p = 0; p < row_at_.size(); ++p) {
      Row& row = At(row_at_[p]);
      if (row.state != RowState::kFree || x_[p] == 0) continue;
      row.base += x_[p];
      Push(row, x_[p]);
      Shift(row, pace.h * x_[p]);
    }
  }
}

/// While joints shut, contacts give way a little: with them a mechanism may be held in more ways
/// than it can move.
void ExactIsland::SoftenContacts() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool contact = rows_[i].kind == RowKind::kNormal || rows_[i].kind == RowKind::kFriction;
    if (!contact || place_[i] < 0) continue;
    matrix_.At(matrix_.Place(place_[i], place_[i])) *= 1 + kYield;
  }
  dirty_ = 0;
}

void ExactIsland::SolveAtEnd(const Pace& pace) {
  Fill(pace);
  for (Row& row : rows_) {
    row.lambda = 0;
    if (row.state == RowState::kOut) continue;
    switch (row.kind) {
      case RowKind::kHard: row.target = 0; break;
      case RowKind::kSoft:
      case RowKind::kMotor:  // have acted for the whole substep
        states_.push_back(row.state);
        row.state = RowState::kOut;
        break;
      case RowKind::kLimit:
      case RowKind::kNormal:
        row.lo = std::min(0.0, -row.base);
        row.target = row.error > kReached ? -row.error / pace.h : 0;
        break;
      case RowKind::kFriction: break;
    }
  }
  Assemble();
  Solve(false);
  std::size_t next = 0;
  for (Row& row : rows_) {
    row.base += row.lambda;
    row.total += row.base;
    row.warm = row.base;
    row.lambda = 0;
    if (row.kind == RowKind::kSoft || row.kind == RowKind::kMotor) row.state = states_[next++];
  }
  states_.clear();
  Tension(pace.h);
}

/// Whether something elastic hits. Sets `approach` of the contacts' points.
bool ExactIsland::FindImpacts() {
  bool hits = false;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    ExactContact& contact = contacts[c];
    for (int i = 0; i < contact.count; ++i) {
      ExactContact::Point& p = contact.point[i];
      Row& normal = At(contact_row_[c] + 2 * i);
      Row& friction = At(contact_row_[c] + 2 * i + 1);
      if (normal.state == RowState::kOut) normal.state = friction.state = RowState::kLow;
      p.approach = Speed(normal);
      if (contact.restitution <= 0 || std::fabs(p.approach) < contact.threshold) continue;
      hits = hits || (normal.error <= 0 && p.approach < 0);
      // It has its blow now, or when it is there; and what parts needs no push.
      normal.state = friction.state = RowState::kOut;
    }
  }
  return hits;
}

/// A blow without duration (Moreau 1988): each contact leaves at no less than its restitution times
/// the speed it came with, so that energy is never gained without friction. With it, it may be
/// (Kane and Levinson 1985): then with less restitution.
void ExactIsland::Impact() {
  Save(&start_);
  double before = 0;
  bool driven = false;
  for (ExactBody& q : bodies) {
    before += Kinetic(q);
    driven = driven || (!q.moves() && (q.vx != 0 || q.vy != 0 || q.w != 0));
    if (q.moves()) q.ii = 1 / q.inertia;
  }
  std::vector<RowState> were;
  for (Row& row : rows_) were.push_back(row.state);
  double share = 1;
  for (int tries = 0;; ++tries) {
    for (Row& row : rows_) {
      row.target = 0;
      if (row.kind == RowKind::kSoft || row.kind == RowKind::kMotor) row.state = RowState::kOut;
      if (row.kind == RowKind::kLimit && row.error > kReached) row.state = RowState::kOut;
    }
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const ExactContact& contact = contacts[c];
      for (int i = 0; i < contact.count; ++i) {
        Row& normal = At(contact_row_[c] + 2 * i);
        Row& friction = At(contact_row_[c] + 2 * i + 1);
        normal.state = friction.state = normal.error > 0 ? RowState::kOut : RowState::kLow;
        normal.target = -share * contact.restitution * contact.point[i].approach;
        friction.target = contact.belt;
        driven = driven || contact.belt != 0;
      }
    }
    Assemble();
    Solve(true);
    double after = 0;
    for (const ExactBody& q : bodies) after += Kinetic(q);
    if (driven || after <= before * (1 + 1e-9) || tries == kSofterTries) break;
    share = tries + 1 == kSofterTries ? 0 : share / 2;
    Restore(start_);
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].state = were[i];
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].total += rows_[i].lambda;
    rows_[i].state = were[i];
  }
  for (ExactBody& q : bodies) {
    if (q.moves()) q.ii = 1 / Stiffened(q);
  }
}

}  // namespace seam
