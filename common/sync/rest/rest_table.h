#pragma once
/// Table of committed rest poses, with hashes by which two peers compare their tables.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/table/body_column.h"

namespace seam {

struct RestRecord {
  bool committed = false;
  std::int32_t epoch = 0;  ///< the mechanism's, at the commitment
  std::int64_t tick = -1;  ///< the body rests from this tick on
  BodyState pose;          ///< velocity is zero
};

/// One record per body, by index. After an edit only those of unchanged bodies are left.
class RestTable {
 public:
  explicit RestTable(const BodyTable& table);

  const RestRecord& at(int body) const { return records_[body]; }
  /// Records a commitment. `id`: the body's id. The velocity of `pose` is dropped.
  void Commit(int body, PartId id, std::int32_t epoch, std::int64_t tick, const BodyState& pose);
  /// Moves the commitment to a later tick: the body still rests there.
  void Prolong(int body, std::int64_t tick) { records_[body].tick = tick; }
  void End(int body);
  void Clear();

  void Persist(StateArchive& a, const World& world);

  /// Sum of the hashes of all bodies; 0 if none is committed.
  std::uint64_t Hash() const { return sum_; }
  /// Hash of a committed body's id, epoch and pose bits; 0 if it is not committed.
  std::uint64_t HashOf(int body) const { return hashes_[body]; }
  /// Packs the commitments of these bodies (ascending, all committed), sorted by tick, into as few
  /// messages as fit datagrams. Ticks below `least_tick` are raised to it. `utime` and `number` are
  /// left 0.
  std::vector<Rest> Pack(const World& world, int peer, std::vector<int> bodies,
                         std::int64_t least_tick = -1) const;

 private:
  void SetHash(int body, std::uint64_t hash);

  BodyColumn<RestRecord> records_;
  BodyColumn<std::uint64_t> hashes_;
  std::uint64_t sum_ = 0;  // of hashes_
  EditHook edited_;
};

}  // namespace seam
