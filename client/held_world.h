#pragma once
/// What is heard of the room's bodies before a client begins to step: who joins late is to begin
/// with the world as it is, not with the scene's beginning.

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "common/sync/replica.h"

namespace seam {

class HeldWorld {
 public:
  /// States of which all bodies have been heard of since are let go when they grow many: of what
  /// comes in the many seconds that a bad link can take, the newest stays. At most kHeldMax.
  void Add(const States& states);
  void Add(const Rest& rest);
  void Clear();
  std::size_t size() const { return held_.size(); }

  /// Whether each of the world's bodies has been heard of since the world is composed as it is: in
  /// motion (states_t), not before tick `from`, or at rest (rest_t).
  bool Covers(const World& world, std::int64_t from) const;

  /// The latest tick of which everything that moves is known, `oldest` to `now`; that from which on
  /// everything is known, if it is later.
  std::int64_t TickOf(const World& world, std::int64_t oldest, std::int64_t now) const;

  /// Gives the replica all that was heard: each body begins where its newest state up to the
  /// replica's tick takes it by then, or lies where it has come to rest since. What is told of
  /// later ticks waits for them.
  void GiveTo(Replica& replica) const;

  /// Messages of a room of the most parts that a scene can have, twice over.
  static constexpr std::size_t kHeldMax = 8192;

 private:
  using Message = std::variant<States, Rest>;
  static std::int64_t TickOf(const Message& message);
  void Add(Message message);
  void LetGo();

  std::vector<Message> held_;  // in the order in which they came
  std::size_t room_ = kRoomMin;
  static constexpr std::size_t kRoomMin = 256;
};

}  // namespace seam
