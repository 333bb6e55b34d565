#pragma once
/// Which bodies their authorities have committed to rest, where exactly they lie, and the hash by
/// which two peers find out whether they know the same of it.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"

namespace seam {

struct RestRecord {
  bool committed = false;
  std::int32_t epoch = 0;  ///< of the mechanism, when its authority said so
  std::int64_t tick = -1;  ///< after which it lies so
  BodyState pose;          ///< without velocity
};

/// One record per body, by index.
class RestTable {
 public:
  explicit RestTable(int body_count) : records_(static_cast<std::size_t>(body_count)) {}

  const RestRecord& at(int body) const { return records_[static_cast<std::size_t>(body)]; }
  /// The velocity of `pose` is dropped.
  void Commit(int body, std::int32_t epoch, std::int64_t tick, const BodyState& pose);
  /// It still lies so at a later tick.
  void Prolong(int body, std::int64_t tick) {
    records_[static_cast<std::size_t>(body)].tick = tick;
  }
  void End(int body);
  void Clear();
  /// The bodies have changed: what was committed of those that are the same holds on.
  void Remap(const std::vector<BodyOrigin>& origins);

  /// Over id, epoch and the bits of the pose of every committed body; 0 for none.
  std::uint64_t Hash(const World& world) const;
  /// These bodies (all committed), by tick, in as few messages as fit a datagram. `utime` and
  /// `number` are left 0.
  std::vector<Rest> Pack(const World& world, int peer, std::vector<int> bodies) const;

 private:
  void NoteChanged(int body);

  std::vector<RestRecord> records_;
  int committed_ = 0;  // how many
  // A hash goes on from one body to the next: of each kBlock of them it is kept how it begins, so
  // that it is made anew only from the first that has changed.
  static constexpr int kBlock = 32;
  mutable std::vector<std::uint64_t> begins_;
  mutable int known_ = 0;  // how many of these are as they should be
};

}  // namespace seam
