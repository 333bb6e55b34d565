#pragma once
/// States that a client has told of the bodies of one mechanism, for an audit. A tick's may lack
/// bodies: messages are lost, and a client that lies may leave some out.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/scene/types.h"

namespace seam {

class ToldStates {
 public:
  struct Told {
    std::int64_t tick = 0;
    std::vector<std::optional<BodyState>> states;  ///< by place; nullopt: left out
  };

  /// Adds a state. `place`: the body's in its mechanism, of `size` bodies.
  void Add(std::int64_t tick, std::size_t place, std::size_t size, const BodyState& state);
  void Forget() { *this = ToldStates(); }
  /// Drops the ticks before this one.
  void DropBefore(std::int64_t tick);
  bool empty() const { return told_.empty(); }
  /// Newest tick that is not dropped; -1: none.
  std::int64_t newest() const { return told_.empty() ? -1 : told_.back().tick; }
  /// Goes on to a tick, later than the last one; returns what was told for it, until the next call.
  /// nullptr: nothing. After a pause of more than `longest` ticks it begins anew.
  const Told* GoTo(std::int64_t tick, std::int64_t longest);
  /// All bodies at the tick of the last GoTo, which must have returned something. A body that was
  /// left out moves on from where it was told to be, for `longest` ticks at most. nullopt: one was
  /// not told of for longer.
  std::optional<std::vector<BodyState>> Whole(std::int64_t longest, float dt) const;
  /// True if for `longest` ticks to the last GoTo others were told of, but not this or that body.
  bool LeavesOut(std::int64_t longest) const;

 private:
  struct Newest {
    std::int64_t tick = -1;
    BodyState state;
  };
  std::vector<Told> told_;                      // ascending ticks
  std::vector<Newest> newest_;                  // by place: up to the last GoTo
  std::int64_t first_ = -1, newest_tick_ = -1;  // of those GoTo that returned something
};

}  // namespace seam
