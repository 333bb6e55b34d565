#pragma once
/// States of each body over the last one or two seconds: accepted states of its authority, and the
/// server's own for bodies it simulates.

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "common/scene/types.h"
#include "common/sync/table/body_column.h"

namespace seam {

class StateArchive;

/// After an edit each body has the past of the body that it came from, moved rigidly: an impact may
/// break what it hurts.
///
/// Between two accepted states, above all over a hand-over, in which nobody tells the body's states
/// for a round trip, the pose is that of the way that somebody knows (Add), else on a line.
class StateTrail {
 public:
  struct Seen {
    std::int64_t tick = 0;
    BodyState state;
  };

  /// Saves or loads all states.
  void Persist(StateArchive& a);

  explicit StateTrail(const BodyTable& table)
      : trails_(table, CarriedOn), ways_(table, CarriedOn), looked_(table, BodyRule::kOrigin, -1) {}

  /// Adds a state if it is newer than the body's newest.
  void Add(int body, std::int64_t tick, const BodyState& state);
  /// Like Add, with the way there: `way(t)` returns the body's state in somebody's world at a tick
  /// from the newest one to `tick`, or nullptr. That world's way, moved so that it begins and ends
  /// at the accepted states, counts for At if it bends more than it is off at its ends: a bounce or
  /// an arc. It counts until the tick is processed.
  using Way = std::function<const BodyState*(std::int64_t tick)>;
  void Add(int body, std::int64_t tick, const BodyState& state, const Way& way);
  /// Returns the newest state; nullptr if there is none.
  const Seen* Newest(int body) const;
  /// Returns the states of a body around a range of ticks: the last one before `from`, all from
  /// `from` to `to`, and the first one after `to`.
  std::vector<Seen> Around(int body, std::int64_t from, std::int64_t to) const;
  /// Returns the ticks that became known for any body since MarkProcessed, each once, ascending:
  /// the ticks of new states, and those between a new state and the one before it.
  std::vector<std::int64_t> NewTicks() const;
  /// Returns the pose at a tick, on the way between the states around it or interpolated linearly;
  /// the newest state if all are older. Never earlier than the last processed tick of that body:
  /// bodies are known up to different ticks, and none may go back. nullopt if all known states are
  /// later.
  std::optional<BodyState> At(int body, std::int64_t tick) const;
  /// Returns the tick of the state that At returns; -1 if all known states are later.
  std::int64_t TickOf(int body, std::int64_t tick) const;
  /// Marks all states as processed.
  void MarkProcessed();

  static constexpr std::size_t kKept = 128;  ///< states: two seconds of every tick
  /// Longest gap between two states that is interpolated, ticks; after a longer silence only the
  /// reported states count.
  static constexpr std::int64_t kMaxGapTicks = 60;
  /// A body that moves further than this per tick was teleported, m: 120 m/s, twice the speed of
  /// fast throws.
  static constexpr float kMaxStep = 2;

 private:
  using Trail = std::deque<Seen>;
  /// Successive ticks with one state.
  struct Run {
    Seen first;
    int ticks = 0;
  };
  static std::vector<Run> RunsOf(const Trail& trail);
  static Trail CarriedOn(int body, const BodyOrigin& origin, Trail* before);
  /// Returns the states of the way between two states; empty if a line is as good.
  static Trail Between(const Seen& from, const Seen& to, const Way& way);
  /// Returns the first tick that state `i` makes known, given the state before it.
  std::int64_t FirstOf(const Trail& trail, std::size_t i) const;

  static void PersistTrail(StateArchive& a, Trail* trail);

  BodyColumn<Trail> trails_;         // ascending by tick
  BodyColumn<Trail> ways_;           // ascending by tick, between states not yet processed
  BodyColumn<std::int64_t> looked_;  // last processed tick, -1: none
};

}  // namespace seam
