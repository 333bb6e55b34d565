#pragma once
/// One value for each body of a replica, by body.

#include <algorithm>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/sync/table/body_table.h"

namespace seam {

/// Chooses the values that bodies have after an edit.
enum class BodyRule {
  kScratch,  ///< any: the owner writes each value before it reads it
  kFresh,    ///< the fresh value for all bodies
  kSame,     ///< its own for an unchanged body, the fresh value for any other
  kOrigin,   ///< that of the body it comes from, the fresh value for a new body
};

template <class T>
class BodyColumn final : public TableEntry {
  static_assert(!std::is_same_v<T, bool>, "use char: std::vector<bool> has no references");

 public:
  /// Computes the value of a body after an edit. `before`: the value of the body that it comes
  /// from, which may be moved away if the origin is the same body; nullptr for a new body.
  using Merge = std::function<T(int body, const BodyOrigin& origin, T* before)>;

  /// All values are `fresh` at first.
  BodyColumn(const BodyTable& table, BodyRule rule, const T& fresh = T())
      : TableEntry(table),
        rule_(rule),
        fresh_(fresh),
        values_(static_cast<std::size_t>(table.bodies()), fresh) {}
  BodyColumn(const BodyTable& table, Merge merge, const T& fresh = T())
      : BodyColumn(table, BodyRule::kOrigin, fresh) {
    merge_ = std::move(merge);
  }

  int size() const { return static_cast<int>(values_.size()); }
  T& operator[](int body) { return values_[static_cast<std::size_t>(body)]; }
  const T& operator[](int body) const { return values_[static_cast<std::size_t>(body)]; }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  /// Sets all values to the fresh one.
  void Reset() { std::fill(values_.begin(), values_.end(), fresh_); }
  /// The values for functions that take a vector by body. Its size must stay.
  std::vector<T>& values() { return values_; }
  const std::vector<T>& values() const { return values_; }

 private:
  void Renumber(const BodyRemap& change) override {
    if (!merge_ && rule_ == BodyRule::kScratch) return values_.resize(change.bodies.size(), fresh_);
    if (!merge_ && rule_ == BodyRule::kFresh) return values_.assign(change.bodies.size(), fresh_);
    std::vector<T> values;
    values.reserve(change.bodies.size());
    for (const BodyOrigin& origin : change.bodies) {
      T* const before = origin.body < 0 ? nullptr : &(*this)[origin.body];
      if (merge_) {
        values.push_back(merge_(static_cast<int>(values.size()), origin, before));
      } else if (before == nullptr || (rule_ == BodyRule::kSame && !origin.same)) {
        values.push_back(fresh_);
      } else if (origin.same) {  // no other body comes from it
        values.push_back(std::move(*before));
      } else {
        values.push_back(*before);
      }
    }
    values_ = std::move(values);
  }

  const BodyRule rule_;
  Merge merge_;
  const T fresh_;
  std::vector<T> values_;
};

}  // namespace seam
