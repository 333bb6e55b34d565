#pragma once
/// Buffers the states received before a client's first step, so that a late joiner starts from the
/// room's current world and not from the scene's beginning.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "common/sync/replica.h"

namespace seam {

class JoinBuffer {
 public:
  /// Adds states. When there are many, drops those with newer states for all of their bodies: of
  /// the messages of a slow join, the newest stay. At most kHeldMax.
  void Add(const States& states);
  void Add(const Rest& rest);
  /// Keeps a settled world (Replica::SettledWorld), the newest.
  void AddWorld(Bytes settled) { world_ = std::move(settled); }
  void Clear();
  std::size_t size() const { return held_.size(); }

  /// True if there are states of each of the world's bodies in its current composition: in motion
  /// (states_t), not before tick `from`, or at rest (rest_t).
  bool Covers(const World& world, std::int64_t from) const;

  /// Returns the latest tick, `oldest` to `now`, at which the states of all moving bodies are
  /// known; or the tick from which on all bodies are known, if that is later.
  std::int64_t TickOf(const World& world, std::int64_t oldest, std::int64_t now) const;

  /// Passes everything to the replica. Each body starts at its newest state up to the replica's
  /// tick, extrapolated to that tick, or at its later rest pose. States of later ticks follow as
  /// received.
  void GiveTo(Replica& replica) const;
  /// Call when the replica has stepped on to the present. Returns an error as of
  /// Replica::TakeWorld.
  Status GiveWorldTo(Replica& replica) const {
    return world_.empty() ? Status::Ok() : replica.TakeWorld(world_);
  }

  /// Twice the number of messages of a room with the most parts that a scene can have.
  static constexpr std::size_t kHeldMax = 8192;

 private:
  using Message = std::variant<States, Rest>;
  static std::int64_t TickOf(const Message& message);
  void Add(Message message);
  void LetGo();

  std::vector<Message> held_;  // in order of arrival
  Bytes world_;                // empty: none has come
  std::size_t room_ = kRoomMin;
  static constexpr std::size_t kRoomMin = 256;
};

}  // namespace seam
