#pragma once
/// One value for each mechanism of a replica, by mechanism.

#include <algorithm>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/sync/table/body_table.h"

namespace seam {

/// Chooses the values that mechanisms have after an edit.
enum class MechanismRule {
  kScratch,  ///< any: the owner writes each value before it reads it
  kFresh,    ///< the fresh value for all mechanisms
};

template <class T>
class MechanismColumn final : public TableEntry {
  static_assert(!std::is_same_v<T, bool>, "use char: std::vector<bool> has no references");

 public:
  /// Computes the value of a mechanism after an edit. `before`: the values of the mechanisms that
  /// its parts were in, as in BodyRemap::mechanisms; empty for a new mechanism. Several mechanisms
  /// can come from one.
  using Merge = std::function<T(int mechanism, const std::vector<const T*>& before)>;
  /// Adds the value of one mechanism of those to the result, which begins as the fresh value.
  using Fold = std::function<void(const T& before, T* into)>;

  /// All values are `fresh` at first.
  MechanismColumn(const BodyTable& table, MechanismRule rule, const T& fresh = T())
      : TableEntry(table),
        rule_(rule),
        fresh_(fresh),
        values_(static_cast<std::size_t>(table.mechanisms()), fresh) {}
  MechanismColumn(const BodyTable& table, Merge merge, const T& fresh = T())
      : MechanismColumn(table, MechanismRule::kFresh, fresh) {
    merge_ = std::move(merge);
  }
  MechanismColumn(const BodyTable& table, Fold fold, const T& fresh = T())
      : MechanismColumn(table, MechanismRule::kFresh, fresh) {
    merge_ = [this, fold = std::move(fold)](int, const std::vector<const T*>& before) {
      T value = fresh_;
      for (const T* const each : before) fold(*each, &value);
      return value;
    };
  }

  int size() const { return static_cast<int>(values_.size()); }
  T& operator[](int mechanism) { return values_[static_cast<std::size_t>(mechanism)]; }
  const T& operator[](int mechanism) const { return values_[static_cast<std::size_t>(mechanism)]; }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  /// Sets all values to the fresh one.
  void Reset() { std::fill(values_.begin(), values_.end(), fresh_); }
  /// The values for functions that take a vector by mechanism. Its size must stay.
  std::vector<T>& values() { return values_; }
  const std::vector<T>& values() const { return values_; }

 private:
  void Renumber(const BodyRemap& change) override {
    const std::size_t count = change.mechanisms.size();
    if (!merge_ && rule_ == MechanismRule::kScratch) return values_.resize(count, fresh_);
    if (!merge_) return values_.assign(count, fresh_);
    std::vector<T> values;
    values.reserve(count);
    std::vector<const T*> before;
    for (const std::vector<int>& from : change.mechanisms) {
      before.clear();
      for (const int mechanism : from) before.push_back(&(*this)[mechanism]);
      values.push_back(merge_(static_cast<int>(values.size()), before));
    }
    values_ = std::move(values);
  }

  const MechanismRule rule_;
  Merge merge_;
  const T fresh_;
  std::vector<T> values_;
};

}  // namespace seam
