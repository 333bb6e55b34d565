/// ExactIsland: blows with restitution.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// A limit or a contact that is nearer than this is reached, m or rad.
constexpr double kReached = 1e-6;
/// Halvings of the restitution when a blow with friction would gain energy, the last is 0.
constexpr int kSofterTries = 3;

double Kinetic(const ExactBody& q) {
  return q.moves() ? ((q.vx * q.vx + q.vy * q.vy) / q.im + q.inertia * q.w * q.w) / 2 : 0;
}

}  // namespace

double KineticOf(const std::vector<ExactBody>& bodies) {
  double sum = 0;
  for (const ExactBody& q : bodies) sum += Kinetic(q);
  return sum;
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
