#pragma once
/// The last second or two of each body as its authorities told it: accepted states, and the
/// server's own of what it simulates itself.

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/scene/types.h"
#include "common/topology/body_remap.h"

namespace seam {

class StateTrail {
 public:
  struct Seen {
    std::int64_t tick = 0;
    BodyState state;
  };

  explicit StateTrail(int body_count)
      : trails_(static_cast<std::size_t>(body_count)),
        looked_(static_cast<std::size_t>(body_count), -1) {}

  /// Keeps a state that is newer than the body's newest.
  void Add(int body, std::int64_t tick, const BodyState& state);
  /// The newest; nullptr when there is none.
  const Seen* Newest(int body) const;
  /// What is known of a body around a tick: the last state before `from`, and all from then to
  /// `to`. Empty when all that is known is later.
  std::vector<Seen> Between(int body, std::int64_t from, std::int64_t to) const;
  /// Ticks that became known of any body since NoteLooked, each once, ascending: those of states
  /// that came, and those between a state and the one before it.
  std::vector<std::int64_t> NewTicks() const;
  /// Where a body was at a tick, on the straight way between the states around it; the newest
  /// state when all are older. Never earlier than what was looked at: what is known of one body
  /// is later than what is known of another, and none may go back. nullopt when all that is known
  /// is later.
  std::optional<BodyState> At(int body, std::int64_t tick) const;
  /// The tick that this is of; -1 when all that is known is later.
  std::int64_t TickOf(int body, std::int64_t tick) const;
  /// All that is here was looked at.
  void NoteLooked();
  /// The bodies have changed: one that is no longer the same has no past.
  void Remap(const std::vector<BodyOrigin>& bodies);

  static constexpr std::size_t kKept = 128;  ///< states: two seconds of every tick
  /// A way between two states is looked at up to this long, ticks; after a longer silence a body
  /// is only where it is told to be.
  static constexpr std::int64_t kWayMost = 60;
  /// What moves further than this in a tick was put there, m: 120 m/s, twice what is thrown fast.
  static constexpr float kPutThere = 2;

 private:
  using Trail = std::deque<Seen>;
  /// The first tick that a state makes known of a body, given the one before it.
  std::int64_t FirstOf(const Trail& trail, std::size_t i) const;

  std::vector<Trail> trails_;         // by body, ascending
  std::vector<std::int64_t> looked_;  // by body: tick of the last state looked at, -1 none
};

}  // namespace seam
