#pragma once
/// Values of parts and players: health, score, checkpoints. The server decides and announces them;
/// clients keep the announced values.

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "common/codec/messages.h"

namespace seam {

class StateArchive;

/// Name of one value.
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
  /// Returns 0 for a value never set.
  float Get(const MetaKey& key) const;
  /// Requires a finite value (asserted). The next TakeChanges announces the change.
  void Set(const MetaKey& key, float value);
  void Add(const MetaKey& key, float more) { Set(key, Get(key) + more); }

  /// Applies the server's message. Messages come in order, so the last value stands.
  void Apply(const Meta& meta);
  /// The same at the server: they count as announced.
  void Announce(const Meta& meta);
  /// Returns the values changed since the last call, in messages of at most kMetaMax.
  std::vector<Meta> TakeChanges(std::int64_t utime, std::int64_t tick);
  /// Returns all values, for a client that joins late.
  std::vector<Meta> Export(std::int64_t utime, std::int64_t tick) const;

  /// Saves the values. Reading: all count as announced.
  void Persist(StateArchive& a);

  const std::map<MetaKey, float>& values() const { return values_; }

 private:
  std::map<MetaKey, float> values_;
  std::map<MetaKey, float> told_;  // as of the last TakeChanges
};

}  // namespace seam
