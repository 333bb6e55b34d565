/// ExactIsland: what is moved without velocities, before a step and after others have moved bodies.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Joints that are farther apart than this, m or rad, are moved together before a step, and limits
/// that are overstepped by more; by at most so much for each try.
constexpr double kApart = 1e-5, kOverstepped = 5e-3, kTogetherMost = 0.2;
/// Once they are moved, to this.
constexpr double kTogether = 1e-7;
constexpr int kTogetherTries = 8;
/// What falls for so many steps has a blow; what falls less lies.
constexpr double kRestSteps = 4;

}  // namespace

/// The greatest acceleration that acts on a body, m/s2.
double ExactIsland::Pull() const {
  double most = 0;
  for (const ExactBody& q : bodies) most = std::max(most, std::sqrt(q.ax * q.ax + q.ay * q.ay));
  return most;
}

/// Reads the contacts as they are before a step.
void ExactIsland::Look(const Pace& pace) {
  if (contacts.empty()) return;
  const double rest = kRestSteps * Pull() * pace.h * pace.substeps;
  for (ExactContact& contact : contacts) ReadContact(bodies, rest, &contact);
}

/// What was put apart since the last step, by a message, an edit or continuous collision, is moved
/// together, and limits that are overstepped are gone back to: positions only, as little as the
/// masses allow, no velocity comes of it.
void ExactIsland::BringTogether(const Pace& pace) {
  held_.clear();
  for (int tries = 0; tries < kTogetherTries; ++tries) {
    bool apart = false;
    for (const Row& row : rows_) {
      const double most = tries == 0 ? kApart : kTogether;
      apart = apart || (row.kind == RowKind::kHard && std::fabs(row.error) > most) ||
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
    for (std::size_t p = 0; p < row_at_.size(); ++p) Shift(*by_place_[p], x_[p]);
    Fill(pace);
  }
  for (std::size_t i = 0; i < held_.size(); ++i) rows_[i].state = held_[i];
  held_.clear();
}

void ExactIsland::Rejoin(const Pace& pace, bool struck) {
  Look(pace);
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

}  // namespace seam
