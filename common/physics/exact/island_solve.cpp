/// ExactIsland: the system of rows, a linear complementarity problem with bounds. Solved by block
/// pivoting (Júdice and Pires 1994), with Descend once that stalls. The bounds of friction come
/// from the normal impulses of the round before.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Rounds of friction end when the bounds change by less than this share.
constexpr double kFrictionSame = 0.02;
/// Pivots before Descend takes over; and the number of those without progress.
constexpr int kPivots = 12, kPatience = 3;
/// Maximal number of rounds of Descend.
constexpr int kRounds = 200;
/// Tolerated error of the speed of a row at its bound, m/s.
constexpr double kSpeedError = 1e-6;

}  // namespace

void ExactIsland::Save(std::vector<double>* velocities) const {
  velocities->resize(3 * bodies.size());
  double* v = velocities->data();
  for (const ExactBody& q : bodies) {
    *v++ = q.vx;
    *v++ = q.vy;
    *v++ = q.w;
  }
}

void ExactIsland::Restore(const std::vector<double>& velocities) {
  const double* v = velocities.data();
  for (ExactBody& q : bodies) {
    q.vx = *v++;
    q.vy = *v++;
    q.w = *v++;
  }
}

/// Returns the first row, by index in the matrix, that has changed since it was assembled, or had
/// another share. At the beginning of a substep the matrix still is that of the last one's end.
int ExactIsland::FirstChanged(double hard, double bounded) {
  const int n = std::min(changed_, matrix_.size());
  for (int p = 0; p < n; ++p) {
    const Assembled& was = assembled_[static_cast<std::size_t>(p)];
    const Row& row = *by_place_[static_cast<std::size_t>(p)];
    if (row.gamma != was.gamma || (row.bounded() ? bounded : hard) != was.share) return p;
    for (int e = was.end; e < was.end + was.ends; ++e) {
      const auto at = static_cast<std::size_t>(e);
      if (!in_matrix_[at].Has(ends_[at])) return p;
    }
  }
  return n;
}

/// True if rows, inertias and shares are those of the last assembled matrix.
bool ExactIsland::Assembles(double hard, double bounded) {
  bool same = !rewritten_ && changed_ == matrix_.size() && hard == hard_ && bounded == bound_;
  for (ExactBody& q : bodies) {
    same = same && q.ii == q.ii_before;
    q.ii_before = q.ii;
  }
  rewritten_ = false;
  hard_ = hard;
  bound_ = bounded;
  return same;
}

void ExactIsland::Assemble(double hard, double bounded) {
  if (Assembles(hard, bounded)) return;
  for (RowEnd& end : ends_) {
    if (end.body < 0) continue;
    const ExactBody& q = bodies[static_cast<std::size_t>(end.body)];
    end.mj[0] = q.im * end.j[0];
    end.mj[1] = q.im * end.j[1];
    end.mj[2] = q.ii * end.j[2];
  }
  const int size = matrix_.size();
  const int from = FirstChanged(hard, bounded);
  changed_ = size;
  dirty_ = std::min(dirty_, from);
  if (from >= size) return;
  matrix_.Clear(from);
  const Pair* const stop = pairs_.data() + pairs_.size();
  for (const Pair* pair = pairs_.data() + assembled_[static_cast<std::size_t>(from)].pair;
       pair != stop; ++pair) {
    const double* const m = pair->m;
    const double* const j = pair->j;
    *pair->at += m[0] * j[0] + m[1] * j[1] + m[2] * j[2];
  }
  for (int p = from; p < size; ++p) {
    const Row& row = *by_place_[static_cast<std::size_t>(p)];
    Assembled& now = assembled_[static_cast<std::size_t>(p)];
    now.gamma = row.gamma;
    now.share = row.bounded() ? bounded : hard;
    double& own = matrix_.At(matrix_.Place(p, p));
    own += own * now.share + row.gamma;
  }
  for (std::size_t e = 0; e < ends_.size(); ++e) in_matrix_[e].Take(ends_[e]);
}

void ExactIsland::Factor() {
  const int size = matrix_.size();
  for (int p = 0; p < size; ++p) {
    const auto at = static_cast<std::size_t>(p);
    const char in = by_place_[at]->state == RowState::kFree ? 1 : 0;
    if (in == in_[at]) continue;
    in_[at] = in;
    dirty_ = std::min(dirty_, p);
  }
  work_ += matrix_.CostFrom(dirty_) + matrix_.SolveCost();  // a Solve follows
  if (dirty_ >= size) return;
  matrix_.Factor(in_, dirty_);
  dirty_ = size;
}

/// Solves with the current states and finds the next ones. True if none changes.
bool ExactIsland::Pivot(int* wrong) {
  if (moved_) Restore(before_);
  moved_ = true;
  for (Row& row : rows_) {
    if (row.state == RowState::kFree) continue;
    row.lambda = row.state == RowState::kLow ? row.lo : row.state == RowState::kHigh ? row.hi : 0;
    Push(row, row.lambda);
  }
  Factor();
  const std::size_t n = rows_.size();
  for (std::size_t p = 0; p < n; ++p) {
    const Row& row = *by_place_[p];
    x_[p] = row.state == RowState::kFree ? row.target - Speed(row) : 0;
  }
  matrix_.Solve(&x_);
  double scale = 0;
  for (std::size_t p = 0; p < n; ++p) {
    Row& row = *by_place_[p];
    if (row.state == RowState::kFree) {
      row.lambda = x_[p];
      Push(row, row.lambda);
    }
    if (row.bounded()) scale = std::max(scale, std::fabs(row.lambda));
  }
  *wrong = 0;
  const double slack = 1e-12 + 1e-7 * scale;
  for (const int place : bounded_places_) {
    const auto p = static_cast<std::size_t>(place);
    Row& row = *by_place_[p];
    next_[p] = row.state;
    if (row.state == RowState::kOut) continue;
    if (row.state == RowState::kFree) {
      if (row.lambda < row.lo - slack) next_[p] = RowState::kLow;
      if (row.lambda > row.hi + slack) next_[p] = RowState::kHigh;
    } else if (row.hi > row.lo) {
      const double off = Speed(row) - row.target + row.gamma * row.lambda;
      if (row.state == RowState::kLow && off < -kSpeedError) next_[p] = RowState::kFree;
      if (row.state == RowState::kHigh && off > kSpeedError) next_[p] = RowState::kFree;
    }
    if (next_[p] != row.state) ++*wrong;
  }
  return *wrong == 0;
}

bool ExactIsland::PivotToTheEnd() {
  int fewest = static_cast<int>(rows_.size()) + 1, patience = kPatience;
  for (int i = 0; i < kPivots; ++i) {
    if (given_up()) return true;
    int wrong = 0;
    if (Pivot(&wrong)) return true;
    if (wrong < fewest) {
      fewest = wrong;
      patience = kPatience;
    } else {
      --patience;
    }
    if (patience < 0) return false;
    for (const int p : bounded_places_) {
      by_place_[static_cast<std::size_t>(p)]->state = next_[static_cast<std::size_t>(p)];
    }
  }
  return false;
}

void ExactIsland::SetFrictionBounds() {
  for (Row& row : rows_) {
    if (row.kind != RowKind::kFriction) continue;
    row.lo = -row.most - row.base;
    row.hi = row.most - row.base;
  }
}

/// False if the bounds have hardly changed.
bool ExactIsland::NextFrictionBounds() {
  double change = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    if (row.kind != RowKind::kFriction || row.state == RowState::kOut) continue;
    const Row& normal = rows_[i - 1];
    const double most = row.friction * std::max(0.0, normal.base + normal.lambda);
    const double now = row.base + row.lambda;
    if (row.state != RowState::kFree || std::fabs(now) > most) {
      change = std::max(change, std::fabs(most - row.most) / (1e-9 + most + row.most));
    }
    row.most = most;
    if (row.state == RowState::kFree && std::fabs(now) > most) {
      row.state = now > 0 ? RowState::kHigh : RowState::kLow;
    }
  }
  return change > kFrictionSame;
}

void ExactIsland::Solve(bool ahead, int rounds) {
  if (given_up()) return;
  if (relaxed_) {
    Relax(ahead);
    return;
  }
  if (bounded_ > 0) Save(&before_);  // else the first pivot is the last
  moved_ = false;
  next_.resize(rows_.size());
  for (int round = 0; round < rounds; ++round) {
    SetFrictionBounds();
    if (!PivotToTheEnd()) Descend();
    if (contacts.empty() || !NextFrictionBounds()) break;
  }
}

/// Solves with the impulses kept within their bounds. Each round moves towards the solution for the
/// free rows until one of them meets its bound; once that solution is reached, it frees the rows at
/// a bound that push the wrong way. The quadratic form that the solution minimises only decreases
/// (Nocedal and Wright 2006, 16.5), so that any round improves on the one before.
void ExactIsland::Descend() {
  Restore(before_);
  for (Row& row : rows_) {
    if (row.state == RowState::kOut) continue;
    row.lambda = std::clamp(row.lambda, row.lo, row.hi);
    Push(row, row.lambda);
  }
  const std::size_t n = rows_.size();
  for (int round = 0; round < kRounds; ++round) {
    if (given_up()) return;
    Factor();
    for (std::size_t p = 0; p < n; ++p) {
      const Row& row = *by_place_[p];
      x_[p] = row.state == RowState::kFree ? row.target - Speed(row) - row.gamma * row.lambda : 0;
    }
    matrix_.Solve(&x_);
    double way = 1;
    int meets = -1;
    for (std::size_t p = 0; p < n; ++p) {
      const Row& row = *by_place_[p];
      if (row.state != RowState::kFree || !row.bounded() || x_[p] == 0) continue;
      const double room = (x_[p] < 0 ? row.lo : row.hi) - row.lambda;
      if (std::fabs(x_[p]) * way <= std::fabs(room)) continue;
      way = std::fabs(room / x_[p]);
      meets = static_cast<int>(p);
    }
    for (std::size_t p = 0; p < n; ++p) {
      Row& row = *by_place_[p];
      if (row.state != RowState::kFree) continue;
      row.lambda += way * x_[p];
      Push(row, way * x_[p]);
    }
    if (meets >= 0) {
      Row& row = At(row_at_[static_cast<std::size_t>(meets)]);
      const bool low = x_[static_cast<std::size_t>(meets)] < 0;
      Push(row, (low ? row.lo : row.hi) - row.lambda);
      row.lambda = low ? row.lo : row.hi;
      row.state = low ? RowState::kLow : RowState::kHigh;
      continue;
    }
    bool freed = false;
    for (std::size_t p = 0; p < n; ++p) {
      Row& row = *by_place_[p];
      if (row.state != RowState::kLow && row.state != RowState::kHigh) continue;
      if (row.hi <= row.lo) continue;
      const double off = Speed(row) - row.target + row.gamma * row.lambda;
      if (row.state == RowState::kLow ? off >= -kSpeedError : off <= kSpeedError) continue;
      row.state = RowState::kFree;
      freed = true;
    }
    if (!freed) return;
  }
  HoldJoints();
}

/// Solves the joints with all other impulses fixed.
void ExactIsland::HoldJoints() {
  held_.clear();
  for (Row& row : rows_) {
    held_.push_back(row.state);
    if (row.bounded()) row.state = RowState::kOut;
  }
  Factor();
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    const Row& row = *by_place_[p];
    x_[p] = row.state == RowState::kFree ? row.target - Speed(row) - row.gamma * row.lambda : 0;
  }
  matrix_.Solve(&x_);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    if (row.state == RowState::kFree) {
      const double more = x_[static_cast<std::size_t>(place_[i])];
      row.lambda += more;
      Push(row, more);
    }
    row.state = held_[i];
  }
  held_.clear();
  if (!relaxed_) Factor();
}

}  // namespace seam
