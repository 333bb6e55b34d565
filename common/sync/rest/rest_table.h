#pragma once
/// Which bodies their authorities have committed to rest, where exactly they lie, and the hashes by
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
  explicit RestTable(int body_count)
      : records_(static_cast<std::size_t>(body_count)),
        hashes_(static_cast<std::size_t>(body_count), 0) {}

  const RestRecord& at(int body) const { return records_[static_cast<std::size_t>(body)]; }
  /// `id`: the body's. The velocity of `pose` is dropped.
  void Commit(int body, PartId id, std::int32_t epoch, std::int64_t tick, const BodyState& pose);
  /// It still lies so at a later tick.
  void Prolong(int body, std::int64_t tick) {
    records_[static_cast<std::size_t>(body)].tick = tick;
  }
  void End(int body);
  void Clear();
  /// The bodies have changed: what was committed of those that are the same holds on.
  void Remap(const std::vector<BodyOrigin>& origins);

  /// The sum of the hashes of all bodies; 0 if none is committed.
  std::uint64_t Hash() const { return sum_; }
  /// Over id, epoch and the bits of the pose of a committed body; 0 of one that is not.
  std::uint64_t HashOf(int body) const { return hashes_[static_cast<std::size_t>(body)]; }
  /// These bodies (ascending, all committed), by tick, in as few messages as fit a datagram; what
  /// lies so since before `least_tick` lies so after it. `utime` and `number` are left 0.
  std::vector<Rest> Pack(const World& world, int peer, std::vector<int> bodies,
                         std::int64_t least_tick = -1) const;

 private:
  void SetHash(int body, std::uint64_t hash);

  std::vector<RestRecord> records_;
  std::vector<std::uint64_t> hashes_;  // by body
  std::uint64_t sum_ = 0;              // of them
};

}  // namespace seam
