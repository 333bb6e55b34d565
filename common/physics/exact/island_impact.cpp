/// ExactIsland: impacts with restitution.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"
#include "common/physics/exact/shared_rules.h"

namespace seam {
namespace {

/// Impacts in one substep, for each contact.
constexpr int kImpactsEach = 8;
/// Shares by which diagonal entries are enlarged in an impact. More takes energy where a mechanism
/// can hardly give way. kDiagonalOfLost is used if with less a joint's row is lost in rounding,
/// that is, leaves its ends a relative speed above kHeldTo, m/s or rad/s.
constexpr double kDiagonalOfImpact = 1e-12, kDiagonalOfLost = 1e-9, kHeldTo = 1e-3;
/// Share of the energy that joints may absorb by giving way in an impact with an excessive impulse.
constexpr double kYieldedMost = 0.05;
/// Energy that an impact may gain, as a share: without friction, by rounding, which a fast impact
/// makes of joints' residual speeds; with friction; and in the last try, without restitution.
constexpr double kGainRounded = 1e-3, kGainRubbed = 1e-9, kGainLast = 0.01;
/// Bounds for scaling the impulses so as to keep the energy.
constexpr double kScaledLeast = 0.5, kScaledMost = 2;

double Kinetic(const ExactBody& q) {
  return q.moves() ? ((q.vx * q.vx + q.vy * q.vy) / q.im + q.inertia * q.w * q.w) / 2 : 0;
}

}  // namespace

double KineticOf(const std::vector<ExactBody>& bodies) {
  double sum = 0;
  for (const ExactBody& q : bodies) sum += Kinetic(q);
  return sum;
}

/// True if an elastic contact has an impact. Sets `approach` of the contacts' points.
bool ExactIsland::FindImpacts() {
  bool hits = false;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    ExactContact& contact = contacts[c];
    bool strikes = false;
    for (int i = 0; i < contact.count; ++i) {
      ExactContact::Point& p = contact.point[i];
      Row& normal = At(contact_row_[c] + 2 * i);
      Row& friction = At(contact_row_[c] + 2 * i + 1);
      if (normal.state == RowState::kOut) normal.state = friction.state = RowState::kLow;
      p.approach = Speed(normal);
      strikes = strikes || std::fabs(p.approach) >= contact.threshold;
    }
    for (int i = 0; i < contact.count && contact.restitution > 0; ++i) {
      const ExactContact::Point& p = contact.point[i];
      Row& normal = At(contact_row_[c] + 2 * i);
      Row& friction = At(contact_row_[c] + 2 * i + 1);
      // For full restitution: no point is pushed while another has an impact or separates.
      const bool whole = strikes && contact.returns;
      if (std::fabs(p.approach) < contact.threshold && !whole) continue;
      hits = hits || (normal.error <= 0 && p.approach < 0);
      // Its impact is now, or when it touches; and separating points need no push.
      normal.state = friction.state = RowState::kOut;
    }
  }
  return hits;
}

/// Returns the touching elastic contact with the fastest approach; -1: none.
int ExactIsland::FastestImpact() {
  int fastest = -1;
  double most = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    ExactContact& contact = contacts[c];
    if (contact.restitution <= 0) continue;
    for (int i = 0; i < contact.count; ++i) {
      const Row& normal = At(contact_row_[c] + 2 * i);
      contact.point[i].approach = Speed(normal);
      if (normal.error > 0 || contact.point[i].approach > -contact.threshold) continue;
      if (contact.point[i].approach >= most) continue;
      most = contact.point[i].approach;
      fastest = static_cast<int>(c);
    }
  }
  return fastest;
}

/// Solves impacts without duration one pair of bodies after the other, the fastest first, as a wave
/// would travel through them: so the last ball of a cradle flies off, and not all of them back.
void ExactIsland::Impact(double pressed) {
  for (ExactBody& q : bodies) {
    if (q.moves()) q.ii = 1 / q.inertia;
  }
  std::vector<RowState> were;
  for (Row& row : rows_) were.push_back(row.state);
  HoldBefore();
  const int most = kImpactsEach * static_cast<int>(contacts.size());
  for (int blow = 0; blow < most; ++blow) {
    const int contact = FastestImpact();
    if (contact < 0) break;
    ExactContact& struck = contacts[static_cast<std::size_t>(contact)];
    // In a jam every impact would gain energy: treat it as a resting contact.
    if (!Blow(struck, contact_row_[static_cast<std::size_t>(contact)], pressed)) {
      struck.restitution = 0;
    }
    // The reported impulse is bounded, as in a jam.
    const double press = Pressed(struck, contact_row_[static_cast<std::size_t>(contact)]);
    const double told = press > pressed ? pressed / press : 1;
    for (Row& row : rows_) {
      if (row.state != RowState::kOut) row.total += told * row.lambda;
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].state = were[i];
  for (ExactBody& q : bodies) {
    if (q.moves()) q.ii = 1 / Stiffened(q);
  }
}

/// Returns the largest normal impulse of this impact, N s.
double ExactIsland::Pressed(const ExactContact& contact, int first_row) const {
  double most = 0;
  for (int i = 0; i < contact.count; ++i) {
    most = std::max(most, std::fabs(rows_[static_cast<std::size_t>(first_row + 2 * i)].lambda));
  }
  return most;
}

/// True if the relative speeds at joints are at most `speed`, m/s or rad/s.
bool ExactIsland::Holds(double speed) const {
  return std::none_of(rows_.begin(), rows_.end(), [&](const Row& row) {
    return row.kind == RowKind::kHard && std::fabs(Speed(row)) > speed;
  });
}

/// Returns the energy that joints and limits absorb in this impact by the enlarged diagonal, J.
double ExactIsland::AbsorbedEnergy() const {
  double work = 0;
  for (const Row& row : rows_) {
    const bool holds = row.kind == RowKind::kHard || row.kind == RowKind::kLimit;
    if (holds && row.state != RowState::kOut) work += std::fabs(row.lambda * Speed(row)) / 2;
  }
  return work;
}

/// Returns the maximal energy supplied by a belt or kinematic bodies in this impact, J.
double ExactIsland::Driven(const ExactContact& contact, int first_row) const {
  double work = 0;
  for (int i = 0; i < 2 * contact.count; ++i) {
    const Row& row = rows_[static_cast<std::size_t>(first_row + i)];
    work += std::fabs(row.lambda) * (std::fabs(row.fixed_speed) + std::fabs(contact.belt));
  }
  return work;
}

/// True if a limit takes part in this impact: a limit has no restitution.
bool ExactIsland::Stops() const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [](const Row& row) { return row.kind == RowKind::kLimit && row.lambda != 0; });
}

/// True if a kinematic body is moving.
bool ExactIsland::Leads() const {
  return std::any_of(bodies.begin(), bodies.end(), [](const ExactBody& q) {
    return !q.moves() && (q.vx != 0 || q.vy != 0 || q.w != 0);
  });
}

/// An impact gains or loses energy by residual speeds of joints and by rows that give way. Scales
/// its impulses to restore the energy, which keeps the momentum. `all`: also if energy was lost.
/// False if that is not possible.
bool ExactIsland::GiveBack(bool all) {
  const double* v = start_.data();
  double square = 0, cross = 0;  // of the change, and of the change with the old velocities
  for (const ExactBody& q : bodies) {
    const double was[3] = {v[0], v[1], v[2]};
    v += 3;
    if (!q.moves()) continue;
    const double dx = q.vx - was[0], dy = q.vy - was[1], dw = q.w - was[2];
    square += (dx * dx + dy * dy) / q.im + q.inertia * dw * dw;
    cross += (dx * was[0] + dy * was[1]) / q.im + q.inertia * dw * was[2];
  }
  if (square <= 0) return false;
  const double scale = -2 * cross / square;
  if (scale < kScaledLeast || scale > (all ? kScaledMost : 1)) return false;
  v = start_.data();
  for (ExactBody& q : bodies) {
    if (q.moves()) {
      q.vx = v[0] + scale * (q.vx - v[0]);
      q.vy = v[1] + scale * (q.vy - v[1]);
      q.w = v[2] + scale * (q.w - v[2]);
    }
    v += 3;
  }
  return true;
}

/// Removes residual speeds of joints before an impact, as after a jam: they would change its
/// energy.
void ExactIsland::HoldBefore() {
  if (Holds(kHeldTo)) return;
  for (Row& row : rows_) {
    row.state = row.kind == RowKind::kHard ? RowState::kFree : RowState::kOut;
    row.target = row.lambda = 0;
  }
  Assemble(kDiagonalOfImpact, kDiagonalOfImpact);
  Solve(true);
  for (Row& row : rows_) {
    if (row.kind == RowKind::kHard) row.total += row.lambda;
  }
}

/// Solves an impact (Moreau 1988): each of its points separates at no less than its restitution
/// times its approach speed, so that without friction energy is never gained. With friction it may
/// be (Kane and Levinson 1985): then restitution is reduced. False, with nothing changed, if no try
/// gives a possible result.
bool ExactIsland::Blow(const ExactContact& contact, int first_row, double most) {
  Save(&start_);
  const double before = KineticOf(bodies);
  bool driven = contact.belt != 0;
  for (const int body : {contact.a, contact.b}) {
    const ExactBody& q = Body(body);
    driven = driven || (!q.moves() && (q.vx != 0 || q.vy != 0 || q.w != 0));
  }
  const bool leads = Leads();
  double share = 1;
  for (int tries = 0;; ++tries) {
    for (Row& row : rows_) {
      const bool limit = row.kind == RowKind::kLimit;
      row.state = row.kind == RowKind::kHard       ? RowState::kFree
                  : limit && row.error <= kReached ? RowState::kLow
                                                   : RowState::kOut;
      row.target = 0;
      row.lambda = 0;
      if (limit) row.lo = 0;
    }
    for (int i = 0; i < contact.count; ++i) {
      Row& normal = At(first_row + 2 * i);
      Row& friction = At(first_row + 2 * i + 1);
      if (normal.error > 0) continue;
      normal.state = friction.state = RowState::kLow;
      normal.lo = 0;
      normal.target = -share * contact.restitution * contact.point[i].approach;
      friction.target = contact.belt;
      friction.most = 0;
    }
    Assemble(kDiagonalOfImpact, kDiagonalOfImpact);
    Solve(true);
    if (!Holds(kHeldTo)) {
      Restore(start_);
      Assemble(kDiagonalOfLost, kDiagonalOfLost);
      Solve(true);
    }
    const bool last = tries == kSofterTries;
    double gain = last ? kGainLast : kGainRounded;
    bool rubs = false;
    for (int i = 0; i < contact.count; ++i) rubs = rubs || At(first_row + 2 * i + 1).lambda != 0;
    if (rubs && !last) gain = kGainRubbed;
    const bool all = share * contact.restitution >= 1 && !Stops();
    const bool kept = !rubs && !last && !driven && !leads && GiveBack(all);
    const double spare = driven ? Driven(contact, first_row) : gain * before;
    // A mechanism that can hardly give way, as a folded one that is hit along its links, has many
    // times its momentum as impulse. That is accepted if its joints hold.
    const bool can_be = Pressed(contact, first_row) <= most || (kept && all && Holds(kHeldTo)) ||
                        AbsorbedEnergy() <= kYieldedMost * before;
    const double after = KineticOf(bodies);
    if (can_be && after <= before + spare) return true;
    if (last) break;
    share = tries + 1 == kSofterTries ? 0 : share / 2;
    Restore(start_);
  }
  Restore(start_);
  for (Row& row : rows_) row.lambda = 0;
  return false;
}

}  // namespace seam
