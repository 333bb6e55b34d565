/// ExactIsland: its rows, and the shape of its matrix.

#include "common/physics/exact/island.h"

#include <algorithm>
#include <utility>

#include "common/physics/joint_directions.h"

namespace seam {

long ExactIsland::Shape(bool relaxed, long most) {
  relaxed_ = relaxed;
  int rows = 0;
  std::size_t ends = 0;
  ends_of_.clear();
  for (Held& held : joints) {
    held.row = rows;
    held.rows = RowCount(*held.joint);
    rows += held.rows;
    ends_of_.insert(ends_of_.end(), static_cast<std::size_t>(held.rows), EndsOf(*held.joint));
  }
  contact_row_.clear();
  for (const ExactContact& contact : contacts) {
    contact_row_.push_back(rows);
    rows += 2 * contact.count;
    ends_of_.insert(ends_of_.end(), static_cast<std::size_t>(2 * contact.count), 2);
  }
  for (const int count : ends_of_) ends += static_cast<std::size_t>(count);
  rows_.assign(static_cast<std::size_t>(rows), Row());
  ends_.assign(ends, RowEnd());
  RowEnd* next = ends_.data();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].end = next;
    next += ends_of_[i];
  }
  now_.assign(kJointRowsMost, Row());
  now_ends_.assign(kJointRowsMost * kRowEndsMost, RowEnd());
  for (std::size_t i = 0; i < now_.size(); ++i) now_[i].end = &now_ends_[i * kRowEndsMost];
  Fill({1, 1});
  const long cost = ShapeMatrix(most);
  if (relaxed_) ShapeGroups();
  ShapeFlights();
  return cost;
}

long ExactIsland::ShapeMatrix(long most) {
  // Order rows by their last body, then by their first: coupled rows stay together.
  const std::size_t n = rows_.size();
  std::vector<std::pair<int, int>>& key = key_;
  key.resize(n);
  bounded_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Row& row = rows_[i];
    key[i] = {-1, static_cast<int>(bodies.size())};
    for (int e = 0; e < row.ends; ++e) {
      key[i].first = std::max(key[i].first, row.end[e].body);
      key[i].second = std::min(key[i].second, row.end[e].body);
    }
    bounded_ += row.bounded() ? 1 : 0;
  }
  row_at_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    if (!relaxed_ || !rows_[i].bounded()) row_at_.push_back(static_cast<int>(i));
  }
  std::sort(row_at_.begin(), row_at_.end(), [&](int x, int y) {
    const auto& a = key[static_cast<std::size_t>(x)];
    const auto& b = key[static_cast<std::size_t>(y)];
    return a != b ? a < b : x < y;
  });
  by_place_.clear();
  for (const int row : row_at_) by_place_.push_back(&At(row));
  place_.assign(n, -1);
  bounded_places_.clear();
  std::vector<int>& first = first_;
  first.resize(row_at_.size());
  lead_.assign(bodies.size(), -1);
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    const Row& row = At(row_at_[p]);
    place_[static_cast<std::size_t>(row_at_[p])] = static_cast<int>(p);
    if (row.bounded()) bounded_places_.push_back(static_cast<int>(p));
    first[p] = static_cast<int>(p);
    for (int e = 0; e < row.ends; ++e) {
      int& led_by = lead_[static_cast<std::size_t>(row.end[e].body)];
      if (led_by < 0) led_by = static_cast<int>(p);
      first[p] = std::min(first[p], led_by);
    }
  }
  const long cost = Skyline::Cost(first);
  if (!relaxed_ && cost > most) return cost;
  matrix_.SetShape(first);
  pairs_.clear();
  assembled_.assign(row_at_.size(), {});
  if (met_.size() < bodies.size()) met_.resize(bodies.size());
  for (std::vector<std::pair<int, int>>& there : met_) there.clear();
  for (std::size_t p = 0; p < row_at_.size(); ++p) {
    const int row = row_at_[p];
    assembled_[p].end = static_cast<int>(At(row).end - ends_.data());
    assembled_[p].ends = At(row).ends;
    assembled_[p].pair = static_cast<int>(pairs_.size());
    for (int e = 0; e < At(row).ends; ++e) {
      auto& there = met_[static_cast<std::size_t>(At(row).end[e].body)];
      there.push_back({row, e});
      for (const auto& [other, other_end] : there) {
        const int column = place_[static_cast<std::size_t>(other)];
        pairs_.push_back({&matrix_.At(matrix_.Place(static_cast<int>(p), column)),
                          At(row).end[e].mj, At(other).end[other_end].j});
      }
    }
  }
  acts_.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (const auto& [row, end] : met_[b]) {
      const auto place = static_cast<std::size_t>(place_[static_cast<std::size_t>(row)]);
      acts_.push_back({place, At(row).end[end].mj});
    }
    bodies[b].acts = static_cast<int>(met_[b].size());
  }
  in_matrix_.assign(ends_.size(), InMatrix());
  changed_ = dirty_ = 0;
  in_.assign(row_at_.size(), 1);
  x_.assign(row_at_.size(), 0.0);
  last_ = shift_ = x_;
  errors_.assign(n, 0.0);
  return cost;
}

void ExactIsland::Fill(const Pace& pace) {
  rewritten_ = true;
  filled_h_ = pace.h;
  for (const Held& held : joints)
    FillJoint(*held.joint, held.ends, bodies, pace, rows_.data() + held.row);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].count > 0) FillContact(contacts[c], bodies, pace, &At(contact_row_[c]));
  }
}

/// Like Fill, for bodies that have not moved since: restores the values that a solve has changed.
void ExactIsland::FillAgain(const Pace& pace) {
  for (Row& row : rows_) {
    switch (row.kind) {
      case RowKind::kHard: row.target = HardTarget(row.error, pace.h); break;
      case RowKind::kSoft:
      case RowKind::kFriction: break;
      case RowKind::kMotor:
        row.lo = -row.most;
        row.hi = row.most;
        break;
      case RowKind::kLimit:
        row.lo = 0;
        row.target = LimitTarget(row.error, pace.h);
        break;
      case RowKind::kNormal:
        row.lo = 0;
        row.target = NormalTarget(row.error, pace);
        break;
    }
  }
}

/// Fill at the beginning of a step: if the bodies are unchanged since the last one, only contacts
/// and motors are filled.
void ExactIsland::FillFirst(const Pace& pace) {
  if (!still || filled_h_ != pace.h) {
    Fill(pace);
    return;
  }
  FillAgain(pace);
  for (const Held& held : joints) {
    if (!held.joint->drives && held.joint->type != e_motorJoint) continue;
    FillJoint(*held.joint, held.ends, bodies, pace, rows_.data() + held.row);
    rewritten_ = true;
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].count > 0) FillContact(contacts[c], bodies, pace, &At(contact_row_[c]));
    rewritten_ = true;
  }
}

void ExactIsland::Store() const {
  for (const Held& held : joints) {
    StoreImpulses(*held.joint, rows_.data() + held.row);
    SetDirections(held.joint->made);
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].count > 0) StoreImpulses(contacts[c], rows_.data() + contact_row_[c]);
  }
}

}  // namespace seam
