#include "server/rules/state_trail.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "common/base/geometry.h"
#include "common/scene/saved/persist_state.h"
#include "common/sync/state_arithmetic.h"

namespace seam {

StateTrail::Trail StateTrail::CarriedOn(int, const BodyOrigin& origin, Trail* before) {
  if (before == nullptr) return {};
  if (origin.same) return std::move(*before);
  Trail carried = *before;
  for (Seen& seen : carried) seen.state = Carried(origin, seen.state);
  return carried;
}

void StateTrail::Add(int body, std::int64_t tick, const BodyState& state) {
  Trail& trail = trails_[body];
  if (!trail.empty() && tick <= trail.back().tick) return;
  trail.push_back({tick, state});
  if (trail.size() > kKept) trail.pop_front();
}

void StateTrail::Add(int body, std::int64_t tick, const BodyState& state, const Way& way) {
  const Trail& trail = trails_[body];
  if (!trail.empty()) {
    const Seen& from = trail.back();
    const std::int64_t ticks = tick - from.tick;
    if (ticks > 1 && ticks <= kMaxGapTicks) {
      const Trail between = Between(from, {tick, state}, way);
      Trail& ways = ways_[body];
      ways.insert(ways.end(), between.begin(), between.end());
      while (ways.size() > kKept) ways.pop_front();
    }
  }
  Add(body, tick, state);
}

StateTrail::Trail StateTrail::Between(const Seen& from, const Seen& to, const Way& way) {
  Trail between;
  const BodyState *const first = way(from.tick), *const last = way(to.tick);
  if (first == nullptr || last == nullptr) return between;
  const BodyState off = Minus(from.state, *first), end = Minus(to.state, *last);
  const Vec2 begins = first->position, line = last->position - begins;
  const float turn = std::remainder(end.angle - off.angle, 2 * kPiFloat);
  const float off_most = std::max(off.position.norm(), end.position.norm());
  float bend = 0;
  for (std::int64_t tick = from.tick + 1; tick < to.tick; ++tick) {
    const BodyState* const then = way(tick);
    if (then == nullptr) return {};
    const float share =
        static_cast<float>(tick - from.tick) / static_cast<float>(to.tick - from.tick);
    bend = std::max(bend, (then->position - begins - share * line).norm());
    BodyState state = *then;
    state.position += off.position + share * (end.position - off.position);
    state.angle += off.angle + share * turn;
    between.push_back({tick, state});
  }
  if (bend <= off_most) return {};
  return between;
}

const StateTrail::Seen* StateTrail::Newest(int body) const {
  const Trail& trail = trails_[body];
  return trail.empty() ? nullptr : &trail.back();
}

std::vector<StateTrail::Seen> StateTrail::Around(int body, std::int64_t from,
                                                 std::int64_t to) const {
  const Trail& trail = trails_[body];
  const auto earlier = [](const Seen& seen, std::int64_t tick) { return seen.tick < tick; };
  auto first = std::lower_bound(trail.begin(), trail.end(), from, earlier);
  auto last = std::lower_bound(first, trail.end(), to + 1, earlier);
  if (first != trail.begin()) --first;
  if (last != trail.end()) ++last;
  return {first, last};
}

std::int64_t StateTrail::FirstOf(const Trail& trail, std::size_t i) const {
  if (i == 0) return trail[i].tick;
  const Seen &before = trail[i - 1], &state = trail[i];
  const std::int64_t ticks = state.tick - before.tick;
  const float way = (state.state.position - before.state.position).norm();
  const bool moved = ticks <= kMaxGapTicks && way <= kMaxStep * static_cast<float>(ticks);
  return moved ? before.tick + 1 : state.tick;
}

std::vector<std::int64_t> StateTrail::NewTicks() const {
  std::set<std::int64_t> ticks;
  for (int b = 0; b < trails_.size(); ++b) {
    const Trail& trail = trails_[b];
    for (std::size_t i = trail.size(); i-- > 0 && trail[i].tick > looked_[b];) {
      const std::int64_t first = std::max(FirstOf(trail, i), looked_[b] + 1);
      for (std::int64_t tick = first; tick <= trail[i].tick; ++tick) ticks.insert(tick);
    }
  }
  return {ticks.begin(), ticks.end()};
}

std::optional<BodyState> StateTrail::At(int body, std::int64_t tick) const {
  const Trail& trail = trails_[body];
  const std::int64_t at = std::max(tick, looked_[body]);
  std::size_t next = trail.size();  // the first state after `at`
  while (next > 0 && trail[next - 1].tick > at) --next;
  if (next == 0) return std::nullopt;
  const Trail& way = ways_[body];
  const auto known = std::lower_bound(
      way.begin(), way.end(), at, [](const Seen& seen, std::int64_t of) { return seen.tick < of; });
  if (known != way.end() && known->tick == at) return known->state;
  BodyState state = trail[next - 1].state;
  if (next == trail.size() || FirstOf(trail, next) > at) return state;
  const Seen &from = trail[next - 1], &to = trail[next];
  const float share = static_cast<float>(at - from.tick) / static_cast<float>(to.tick - from.tick);
  state.position += share * (to.state.position - from.state.position);
  state.angle += share * (to.state.angle - from.state.angle);
  return state;
}

std::int64_t StateTrail::TickOf(int body, std::int64_t tick) const {
  const Trail& trail = trails_[body];
  const std::int64_t at = std::max(tick, looked_[body]);
  if (trail.empty() || trail.front().tick > at) return -1;
  return std::min(at, trail.back().tick);
}

void StateTrail::MarkProcessed() {
  for (int b = 0; b < trails_.size(); ++b) {
    if (!trails_[b].empty()) looked_[b] = trails_[b].back().tick;
    ways_[b].clear();
  }
}

/// Returns the states of a trail; those of a resting body are one run.
std::vector<StateTrail::Run> StateTrail::RunsOf(const Trail& trail) {
  std::vector<Run> runs;
  for (const Seen& seen : trail) {
    const bool on = !runs.empty() && seen.tick == runs.back().first.tick + runs.back().ticks &&
                    std::memcmp(&seen.state, &runs.back().first.state, sizeof seen.state) == 0;
    if (!on) runs.push_back({seen, 0});
    ++runs.back().ticks;
  }
  return runs;
}

void StateTrail::PersistTrail(StateArchive& a, Trail* trail) {
  std::vector<Run> runs;
  if (!a.reading()) runs = RunsOf(*trail);
  std::int64_t after = -StateArchive::kTickMost;
  a.List(&runs, kKept, [&](Run* run) {
    a.Int(&run->first.tick, after, StateArchive::kTickMost);
    a.Int(&run->ticks, 1, static_cast<std::int64_t>(kKept));
    PersistStates(a, &run->first.state, 1);
    after = run->first.tick + run->ticks;
  });
  if (!a.ok() || !a.reading()) return;
  trail->clear();
  for (const Run& run : runs) {
    for (int t = 0; t < run.ticks && trail->size() < kKept; ++t) {
      trail->push_back({run.first.tick + t, run.first.state});
    }
  }
}

void StateTrail::Persist(StateArchive& a) {
  a.Section("trails");
  a.Exactly(&looked_, [&](std::int64_t* tick) { a.Tick(tick); });
  for (BodyColumn<Trail>* const trails : {&trails_, &ways_}) {
    for (Trail& trail : *trails) {
      PersistTrail(a, &trail);
      if (!a.ok()) return;
    }
  }
}

}  // namespace seam
