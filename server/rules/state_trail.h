#pragma once
/// The last second or two of each body as its authorities told it: accepted states, and the
/// server's own of what it simulates itself.

#include <cstdint>
#include <deque>
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

  explicit StateTrail(int body_count) : trails_(static_cast<std::size_t>(body_count)) {}

  /// Keeps a state that is newer than the body's newest.
  void Add(int body, std::int64_t tick, const BodyState& state);
  /// The newest; nullptr when there is none.
  const Seen* Newest(int body) const;
  /// What is known of a body around a tick: the last state before `from`, and all from then to
  /// `to`. Empty when all that is known is later.
  std::vector<Seen> Between(int body, std::int64_t from, std::int64_t to) const;
  /// The bodies have changed: one that is no longer the same has no past.
  void Remap(const std::vector<BodyOrigin>& bodies);

  static constexpr std::size_t kKept = 128;  ///< states: two seconds of every tick

 private:
  std::vector<std::deque<Seen>> trails_;  // by body, ascending
};

}  // namespace seam
