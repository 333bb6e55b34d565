/// ExactIsland: piles, which have too many contacts for one system. The joints of each mechanism
/// are solved exactly as ever. Contacts, friction, limits and motors are solved by projected
/// Gauss-Seidel sweeps on the Schur complement of the joints' rows: each impulse acts on its bodies
/// and on all bodies that joints pass it on to, so that joints hold after every single impulse.

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Sweeps of the first solve, and of the second, which has little left to do.
constexpr int kSweepsAhead = 8, kSweepsAtEnd = 4;
/// Response of a row, per impulse, below which it is immovable.
constexpr double kNothing = 1e-12;
/// Least response of a row, as a share of its bodies' response without joints: where joints jam it,
/// the rest is rounding.
constexpr double kYields = 1e-4;
/// Rotation up to which the responses remain valid, rad.
constexpr double kTurnsFew = 0.01;

}  // namespace

void ExactIsland::ShapeGroups() {
  groups_.clear();
  std::vector<int> group_of(bodies.size(), -1);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const ExactBody& q = bodies[b];
    if (!q.moves()) continue;
    if (q.group < 0 || groups_.empty() || groups_.back().group != q.group) {
      groups_.push_back({q.group, static_cast<int>(b), 0, 0, 0});
    }
    ++groups_.back().bodies;
    group_of[b] = static_cast<int>(groups_.size()) - 1;
  }
  for (int p = 0; p < matrix_.size(); ++p) {
    const Row& row = At(row_at_[static_cast<std::size_t>(p)]);
    Group& group =
        groups_[static_cast<std::size_t>(group_of[static_cast<std::size_t>(row.end[0].body)])];
    if (group.rows == 0) group.first_row = p;
    group.rows = p + 1 - group.first_row;
  }
  joined_.assign(bodies.size(), {});
  for (int p = 0; p < matrix_.size(); ++p) {
    const Row& row = At(row_at_[static_cast<std::size_t>(p)]);
    for (int e = 0; e < row.ends; ++e) {
      joined_[static_cast<std::size_t>(row.end[e].body)].push_back({p, e});
    }
  }
  std::size_t next = 0;
  reaches_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (!row.bounded()) continue;
    Reach reach;
    reach.row = static_cast<int>(i);
    for (int e = 0; e < row.ends; ++e) {
      const int g = group_of[static_cast<std::size_t>(row.end[e].body)];
      if (reach.groups > 0 && reach.group[0] == g) continue;
      if (reach.groups == 2) continue;  // a gear over three mechanisms: these are one
      reach.group[reach.groups] = g;
      reach.at[reach.groups++] = next;
      next += 3 * static_cast<std::size_t>(groups_[static_cast<std::size_t>(g)].bodies);
    }
    reaches_.push_back(reach);
  }
  answer_.assign(next, 0.0);
  velocity_.assign(3 * bodies.size(), 0.0);
}

/// Computes the effect of an impulse of 1 on the row on all bodies of its mechanisms, with joints
/// holding.
void ExactIsland::FindAnswer(Reach* reach) {
  const Row& row = At(reach->row);
  reach->own = 0;
  for (int e = 0; e < row.ends; ++e) {
    const RowEnd& end = row.end[e];
    for (int i = 0; i < 3; ++i) reach->own += kYields * end.j[i] * end.mj[i];
  }
  for (int r = 0; r < reach->groups; ++r) {
    const Group& group = groups_[static_cast<std::size_t>(reach->group[r])];
    double* answer = answer_.data() + reach->at[r];
    std::fill(answer, answer + 3 * group.bodies, 0.0);
    bool joined = false;
    for (int e = 0; e < row.ends; ++e) {
      const RowEnd& end = row.end[e];
      const int at = end.body - group.first_body;
      if (at < 0 || at >= group.bodies) continue;
      for (int i = 0; i < 3; ++i) answer[3 * at + i] += end.mj[i];
      for (const auto& [place, other_end] : joined_[static_cast<std::size_t>(end.body)]) {
        const Row& joint = At(row_at_[static_cast<std::size_t>(place)]);
        const double* j = joint.end[other_end].j;
        x_[static_cast<std::size_t>(place)] +=
            end.mj[0] * j[0] + end.mj[1] * j[1] + end.mj[2] * j[2];
        joined = true;
      }
    }
    if (joined) {
      matrix_.SolvePart(&x_, group.first_row, group.first_row + group.rows);
      for (int p = group.first_row; p < group.first_row + group.rows; ++p) {
        double& held = x_[static_cast<std::size_t>(p)];
        const Row& joint = At(row_at_[static_cast<std::size_t>(p)]);
        for (int e = 0; e < joint.ends && held != 0; ++e) {
          const RowEnd& end = joint.end[e];
          double* at = answer + 3 * (end.body - group.first_body);
          for (int i = 0; i < 3; ++i) at[i] -= held * end.mj[i];
        }
        held = 0;
      }
    }
    for (int e = 0; e < row.ends; ++e) {
      const RowEnd& end = row.end[e];
      const int at = end.body - group.first_body;
      if (at < 0 || at >= group.bodies) continue;
      for (int i = 0; i < 3; ++i) reach->own += end.j[i] * answer[3 * at + i];
    }
  }
}

void ExactIsland::Respond(const Reach& reach, double impulse) {
  for (int r = 0; r < reach.groups; ++r) {
    const Group& group = groups_[static_cast<std::size_t>(reach.group[r])];
    const double* answer = answer_.data() + reach.at[r];
    double* v = velocity_.data() + 3 * group.first_body;
    const int n = 3 * group.bodies;
    for (int i = 0; i < n; ++i) v[i] += impulse * answer[i];
  }
}

void ExactIsland::Sweep(bool friction) {
  for (const Reach& reach : reaches_) {
    Row& row = At(reach.row);
    if (row.state == RowState::kOut || (row.kind == RowKind::kFriction) != friction) continue;
    if (friction) {
      const Row& normal = At(reach.row - 1);
      row.most = row.friction * std::max(0.0, normal.base + normal.lambda);
      row.lo = -row.most - row.base;
      row.hi = row.most - row.base;
    }
    double speed = row.fixed_speed;
    for (int e = 0; e < row.ends; ++e) {
      const RowEnd& end = row.end[e];
      const double* v = velocity_.data() + 3 * end.body;
      speed += end.j[0] * v[0] + end.j[1] * v[1] + end.j[2] * v[2];
    }
    if (reach.own <= kNothing) continue;
    const double to = std::clamp(row.lambda - (speed - row.target) / reach.own, row.lo, row.hi);
    if (to == row.lambda) continue;
    Respond(reach, to - row.lambda);
    row.lambda = to;
  }
}

/// `ahead`: the first of the two solves, which starts from the last step's impulses.
void ExactIsland::Relax(bool ahead) {
  for (Row& row : rows_) row.lambda = 0;
  Save(&before_);
  HoldJoints();
  if (ahead || turned_ > kTurnsFew) {
    std::fill(x_.begin(), x_.end(), 0.0);
    for (Reach& reach : reaches_) FindAnswer(&reach);
  }
  Save(&velocity_);
  for (const Reach& reach : reaches_) {
    Row& row = At(reach.row);
    row.lambda = 0;
    if (!ahead || row.state == RowState::kOut) continue;
    if (row.kind == RowKind::kFriction) {
      row.lo = -row.most;
      row.hi = row.most;
    }
    row.lambda = std::clamp(row.warm, row.lo, row.hi);
    if (row.lambda != 0) Respond(reach, row.lambda);
  }
  const int sweeps = ahead ? kSweepsAhead : kSweepsAtEnd;
  for (int i = 0; i < sweeps; ++i) {
    Sweep(true);
    Sweep(false);
  }
  Restore(before_);
  for (const Reach& reach : reaches_) {
    Row& row = At(reach.row);
    Push(row, row.lambda);
    if (row.state == RowState::kOut) continue;
    row.state = row.lambda <= row.lo   ? RowState::kLow
                : row.lambda >= row.hi ? RowState::kHigh
                                       : RowState::kFree;
  }
  for (Row& row : rows_) {
    if (!row.bounded()) row.lambda = 0;
  }
  HoldJoints();
}

}  // namespace seam
