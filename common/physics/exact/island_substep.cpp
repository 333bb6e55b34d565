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
/// The inertia is found anew while it lacks more than this.
constexpr double kStifferBy = 1.1;
constexpr int kStifferTries = 4;
/// Joints are shut to this, m or rad, in at most so many corrections.
constexpr double kShut = 1e-7;
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
/// A joint has at most so many rows, and a row so many ends.
constexpr int kRowsMost = 6, kEndsMost = 4;

/// kg m2, what the tension makes of a body's inertia. Little tension makes nothing of it, so that
/// a pendulum stays as exact as it is.
double Stiffened(const ExactBody& q) {
  const double share = (q.stiffness / q.inertia - kStiffFrom) / (kStiffTo - kStiffFrom);
  return q.inertia + kStiffness * std::max(0.0, q.stiffness) * std::clamp(share, 0.0, 1.0);
}

double Kinetic(const ExactBody& q) {
  return q.moves() ? ((q.vx * q.vx + q.vy * q.vy) / q.im + q.inertia * q.w * q.w) / 2 : 0;
}

}  // namespace

void ExactIsland::Step(const Pace& pace, bool warm) {
  for (ExactContact& contact : contacts) ReadContact(bodies, &contact);
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
  for (int i = 0; i < pace.substeps; ++i) Substep(pace);
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
      const bool shuts = row.kind == RowKind::kHard ||
                         (row.kind == RowKind::kLimit && row.error < -kOverstepped);
      const bool held = row.kind == RowKind::kNormal && row.error <= 0;
      row.state = shuts || held ? RowState::kFree : RowState::kOut;
      if (!shuts) continue;
      x_[static_cast<std::size_t>(place_[i])] =
          std::clamp(-row.error, -kTogetherMost, kTogetherMost);
    }
    Assemble();
    SoftenContacts();
    Factor();
    matrix_.Solve(&x_);
    for (std::size_t p = 0; p < rows_.size(); ++p) Shift(At(row_at_[p]), x_[p]);
    Fill(pace);
  }
  for (std::size_t i = 0; i < held_.size(); ++i) rows_[i].state = held_[i];
  held_.clear();
}

void ExactIsland::Rejoin(const Pace& pace) {
  for (ExactContact& contact : contacts) ReadContact(bodies, &contact);
  Fill(pace);
  BringTogether(pace);
  for (Row& row : rows_) {
    row.base = row.lambda = row.total = 0;
    row.state = row.bounded() && row.error > 0 ? RowState::kLow : RowState::kFree;
    if (row.kind == RowKind::kFriction) row.state = RowState::kOut;
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
  Fill(pace);
  if (FindImpacts()) {
    Impact();
    Fill(pace);
  }
  const bool touches = !contacts.empty();
  Kick(touches ? pace.h : pace.h / 2);
  SolveAhead(pace);
  Move(pace.h);
  ShutJoints(pace);
  if (!touches) Kick(pace.h / 2);
  SolveAtEnd(pace);
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
    Solve();
    if (tries == kStifferTries) break;
    Tension(pace.h);
    if (!Stiffer()) break;
    Restore(start_);
  }
  for (Row& row : rows_) row.base += row.lambda;
}

void ExactIsland::Move(double h) {
  for (ExactBody& q : bodies) {
    q.x += h * q.vx;
    q.y += h * q.vy;
    if (q.w != 0) q.Turn(h * q.w);
  }
}

void ExactIsland::ShutJoints(const Pace& pace) {
  bool anew = false;
  for (const ExactBody& q : bodies) anew = anew || std::fabs(q.w * pace.h) > kTurnsFast;
  double last = kUnbounded;
  Row now[kRowsMost];
  RowEnd ends[kRowsMost * kEndsMost];
  for (int i = 0; i < kRowsMost; ++i) now[i].end = ends + i * kEndsMost;
  for (int tries = 0; tries < kCorrections; ++tries) {
    double far = 0;
    std::fill(x_.begin(), x_.end(), 0.0);
    for (const Held& held : joints) {
      FillJoint(*held.joint, held.ends, bodies, pace, now);
      for (int i = 0; i < held.rows; ++i) {
        Row& row = At(held.row + i);
        const bool shuts = row.kind == RowKind::kHard || row.kind == RowKind::kLimit;
        if (!shuts || row.state != RowState::kFree) continue;
        const double off = now[i].error - row.goal;
        far = std::max(far, std::fabs(off));
        x_[static_cast<std::size_t>(place_[static_cast<std::size_t>(held.row + i)])] =
            std::clamp(-off / pace.h, -kShutFastest, kShutFastest);
        if (anew) std::copy_n(now[i].end, row.ends, row.end);
      }
    }
    if (far < kShut) break;
    if (tries == 0 && !contacts.empty()) YieldContacts();
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
    for (std::size_t p = 0; p < rows_.size(); ++p) {
      Row& row = At(row_at_[p]);
      if (row.state != RowState::kFree || x_[p] == 0) continue;
      row.base += x_[p];
      Push(row, x_[p]);
      Shift(row, pace.h * x_[p]);
    }
  }
  for (std::size_t i = 0; i < held_.size(); ++i) rows_[i].state = held_[i];
  held_.clear();
}

/// While joints shut, contacts give way a little and friction altogether: with them a mechanism may
/// be held in more ways than it can move.
void ExactIsland::YieldContacts() {
  for (Row& row : rows_) {
    held_.push_back(row.state);
    if (row.kind == RowKind::kFriction) row.state = RowState::kOut;
  }
  SoftenContacts();
}

void ExactIsland::SoftenContacts() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].kind != RowKind::kNormal) continue;
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
  Solve();
  std::size_t next = 0;
  for (Row& row : rows_) {
    row.base += row.lambda;
    row.total += row.base;
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
      if (contact.restitution <= 0 || p.approach > -contact.threshold) continue;
      if (normal.error <= 0) {
        hits = true;
      } else {
        normal.state = friction.state = RowState::kOut;  // next time, when it is there
      }
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
        if (normal.error > 0) normal.state = friction.state = RowState::kOut;
        normal.target = -share * contact.restitution * contact.point[i].approach;
        friction.target = contact.belt;
        driven = driven || contact.belt != 0;
      }
    }
    Assemble();
    Solve();
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
