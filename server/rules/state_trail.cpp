#include "server/rules/state_trail.h"

#include <utility>

namespace seam {

void StateTrail::Add(int body, std::int64_t tick, const BodyState& state) {
  std::deque<Seen>& trail = trails_[static_cast<std::size_t>(body)];
  if (!trail.empty() && tick <= trail.back().tick) return;
  trail.push_back({tick, state});
  if (trail.size() > kKept) trail.pop_front();
}

const StateTrail::Seen* StateTrail::Newest(int body) const {
  const std::deque<Seen>& trail = trails_[static_cast<std::size_t>(body)];
  return trail.empty() ? nullptr : &trail.back();
}

std::vector<StateTrail::Seen> StateTrail::Between(int body, std::int64_t from,
                                                  std::int64_t to) const {
  std::vector<Seen> found;
  for (const Seen& seen : trails_[static_cast<std::size_t>(body)]) {
    if (seen.tick > to) break;
    if (seen.tick < from) found.clear();
    found.push_back(seen);
  }
  return found;
}

void StateTrail::Remap(const std::vector<BodyOrigin>& bodies) {
  std::vector<std::deque<Seen>> trails;
  for (const BodyOrigin& origin : bodies) {
    trails.emplace_back();
    if (origin.same) trails.back() = std::move(trails_[static_cast<std::size_t>(origin.body)]);
  }
  trails_ = std::move(trails);
}

}  // namespace seam
