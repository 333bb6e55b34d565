#pragma once
/// Values of parts and players: health, score, checkpoints. The server decides and
/// announces; clients keep what they are told.

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "common/codec/messages.h"

namespace seam {

/// One value's name.
struct MetaKey {
  std::int8_t kind = kMetaPart;  ///< kMetaPart | kMetaPlayer
  std::int32_t id = 0;           ///< part id, or the player's index in the scene
  std::int8_t key = kMetaHealth;

  bool operator<(const MetaKey& o) const {
    return std::tie(kind, id, key) < std::tie(o.kind, o.id, o.key);
  }
  bool operator==(const MetaKey& o) const {
    return std::tie(kind, id, key) == std::tie(o.kind, o.id, o.key);
  }
};

class MetaTable {
 public:
  /// 0 for what was never set.
  float Get(const MetaKey& key) const;
  /// Requires a finite value (asserted). What is changed is announced by the next TakeChanges.
  void Set(const MetaKey& key, float value);
  void Add(const MetaKey& key, float more) { Set(key, Get(key) + more); }

  /// The server's word. Messages come in order, so the last one stands.
  void Apply(const Meta& meta);
  /// The values that changed since the last call, in messages of at most kMetaMax.
  std::vector<Meta> TakeChanges(std::int64_t utime, std::int64_t tick);
  /// All values, for one who joins late.
  std::vector<Meta> Export(std::int64_t utime, std::int64_t tick) const;

  const std::map<MetaKey, float>& values() const { return values_; }

 private:
  std::map<MetaKey, float> values_;
  std::map<MetaKey, float> told_;  // as of the last TakeChanges
};

}  // namespace seam
