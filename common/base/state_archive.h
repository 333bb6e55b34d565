#pragma once
/// Writes the state of objects as plain bytes and reads it back. A class lists its state once, in
/// `void Persist(StateArchive& a)`, which serves both directions, so that they cannot differ.
/// Values are little-endian and of fixed width.
///
/// Reading trusts nothing: a value outside its range, a list that cannot fit, or an early end is an
/// error. After the first error every read returns zero or an empty list; the caller looks at
/// status() when it is through, and throws the objects away if it is not ok.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "common/base/status.h"

namespace seam {

class StateArchive;

/// Bytes of which some are not written yet.
class StateDraft {
 public:
  /// Writes the rest and returns all. Any thread may do so.
  Bytes Finish();
  /// Number of bytes that are written.
  std::size_t size() const { return bytes_.size(); }

 private:
  friend class StateArchive;
  struct Gap {
    std::size_t at = 0;  // in bytes_
    std::function<void(StateArchive&)> write;
  };
  Bytes bytes_;
  std::vector<Gap> gaps_;  // ascending
};

class StateArchive {
 public:
  /// Begins to write.
  StateArchive() = default;
  /// Begins to read. `bytes` must outlive this.
  explicit StateArchive(ByteView bytes) : from_(bytes), reading_(true) {}

  bool reading() const { return reading_; }
  bool ok() const { return status_.ok(); }
  /// Returns the first error, one line.
  const Status& status() const { return status_; }
  /// Expects so many bytes to be written.
  void Reserve(std::size_t bytes) { to_.resize(std::max(to_.size(), bytes)); }
  /// Returns the bytes written so far and begins anew.
  Bytes Take() { return TakeDraft().Finish(); }
  /// The same, but what Later has left out is still to be written.
  StateDraft TakeDraft();
  /// Returns how many bytes have not been read.
  std::size_t left() const { return from_.size - at_; }

  /// Begins the state of an object. The name is in the bytes, and in errors about them.
  void Section(const char* name);
  /// Reading: records an error unless the condition holds. Writing: asserts it.
  void Require(bool condition, const char* what);
  /// Reading: records an error that another part has found.
  void Fail(const std::string& what);

  /// A whole number from `least` to `most`.
  template <class Number>
  void Int(Number* value, std::int64_t least, std::int64_t most) {
    if (!reading_) {
      const auto number = static_cast<std::int64_t>(*value);
      SEAM_ASSERT(number >= least && number <= most);
      return Put(value, sizeof *value);
    }
    Number read{};
    if (!Get(&read, sizeof read)) return Zero(value);
    const auto number = static_cast<std::int64_t>(read);
    Require(number >= least && number <= most, "a number is out of range");
    *value = ok() ? read : Number{};
  }
  /// A tick, or a time that is far in the past (kLongAgo).
  void Tick(std::int64_t* tick) { Int(tick, -kTickMost, kTickMost); }
  void Flag(bool* value);
  /// Writing only: leaves the bytes of `write` to StateDraft::Finish, which may be called by
  /// another thread. So `write` must own all that it uses, and nobody may change that any more.
  void Later(std::function<void(StateArchive&)> write);
  /// Bytes as they lie in memory. Reading: the caller has to check them.
  void Raw(void* data, std::size_t size) {
    if (!reading_) return Put(data, size);
    if (!Get(data, size)) std::memset(data, 0, size);
  }
  /// Any bits.
  void Word(std::uint64_t* value);
  /// A finite number of at most this magnitude.
  void Real(float* value, float most = kRealMost);
  void Real(double* value, double most);
  /// Any bytes, at most `most`.
  void Text(std::string* text, std::size_t most);

  /// Writes the length of a list, or reads it: at most `most`, and no more than there are bytes.
  std::size_t Count(std::size_t count, std::size_t most);

  /// Calls `each(T*)` for each item.
  template <class T, class Each>
  void List(std::vector<T>* list, std::size_t most, const Each& each) {
    const std::size_t count = Count(list->size(), most);
    if (!reading_) {
      for (T& item : *list) each(&item);
      return;
    }
    list->clear();
    for (std::size_t i = 0; ok() && i < count; ++i) {  // allocates no more than is there
      list->emplace_back();
      each(&list->back());
    }
  }
  /// The same for a list of a length that both sides know.
  template <class List, class Each>
  void Exactly(List* list, const Each& each) {
    const auto size = static_cast<std::size_t>(list->size());
    Require(Count(size, size) == size, "a list has another length");
    for (auto& item : *list) {
      if (!ok()) return;
      each(&item);
    }
  }
  /// A map: calls `key(K*)` and `value(V*)` for each entry.
  template <class Map, class Key, class Value>
  void Entries(Map* map, std::size_t most, const Key& key, const Value& value) {
    using K = typename Map::key_type;
    const std::size_t count = Count(map->size(), most);
    if (!reading_) {
      for (auto& [k, v] : *map) {
        K copy = k;
        key(&copy);
        value(&v);
      }
      return;
    }
    map->clear();
    for (std::size_t i = 0; ok() && i < count; ++i) {
      K k{};
      key(&k);
      value(&(*map)[k]);
    }
  }
  /// A set: calls `each(T*)` for each member.
  template <class Set, class Each>
  void Members(Set* set, std::size_t most, const Each& each) {
    using T = typename Set::value_type;
    const std::size_t count = Count(set->size(), most);
    if (!reading_) {
      for (T member : *set) each(&member);
      return;
    }
    set->clear();
    for (std::size_t i = 0; ok() && i < count; ++i) {
      T member{};
      each(&member);
      set->insert(std::move(member));
    }
  }

  /// Ticks are at most this far from 0: at 10 Hz, 100 years. Messages hold their times too, us.
  static constexpr std::int64_t kTickMost = std::int64_t{1} << 35;
  /// Items of a list that has no limit of its own.
  static constexpr std::size_t kListMost = std::size_t{1} << 24;
  /// Larger numbers, in SI units, are no state of a room: whole numbers up to here fit an int.
  static constexpr float kRealMost = 2e9f;
  /// Largest count that is saved, far below an overflow.
  static constexpr int kCountMost = 1 << 28;

 private:
  void Put(const void* data, std::size_t size) {
    if (to_.size() - used_ < size) Grow(size);
    std::memcpy(to_.data() + used_, data, size);
    used_ += size;
  }
  void Grow(std::size_t size);
  /// Returns false, with an error, if there are too few bytes.
  bool Get(void* data, std::size_t size);
  template <class Number>
  static void Zero(Number* value) {
    *value = Number{};
  }

  ByteView from_;
  std::size_t at_ = 0;  // of from_
  Bytes to_;
  std::size_t used_ = 0;  // of to_, which grows by doubling
  std::vector<StateDraft::Gap> gaps_;
  bool reading_ = false;
  const char* section_ = "";
  Status status_;
};

}  // namespace seam
