#include "server/trust/told_states.h"

#include <algorithm>

namespace seam {
namespace {

bool IsBefore(const ToldStates::Told& told, std::int64_t tick) { return told.tick < tick; }

/// Without forces, which move it by millimetres in a few ticks.
BodyState MovedOn(BodyState state, float seconds) {
  state.position += seconds * state.velocity;
  state.angle += seconds * state.spin;
  return state;
}

}  // namespace

void ToldStates::Add(std::int64_t tick, std::size_t place, std::size_t size,
                     const BodyState& state) {
  if (newest_.size() != size) Forget();
  newest_.resize(size);
  auto told = std::lower_bound(told_.begin(), told_.end(), tick, IsBefore);
  if (told == told_.end() || told->tick != tick) {
    told = told_.insert(told, Told{tick, std::vector<std::optional<BodyState>>(size)});
  }
  told->states[place] = state;
}

void ToldStates::DropBefore(std::int64_t tick) {
  told_.erase(told_.begin(), std::lower_bound(told_.begin(), told_.end(), tick, IsBefore));
}

const ToldStates::Told* ToldStates::GoTo(std::int64_t tick, std::int64_t longest) {
  DropBefore(tick);
  if (told_.empty() || told_.front().tick != tick) return nullptr;
  const Told& now = told_.front();
  if (newest_tick_ < 0 || tick - newest_tick_ > longest) {
    first_ = tick;
    std::fill(newest_.begin(), newest_.end(), Newest{});
  }
  newest_tick_ = tick;
  for (std::size_t place = 0; place < newest_.size(); ++place) {
    if (now.states[place]) newest_[place] = {tick, *now.states[place]};
  }
  return &now;
}

std::optional<std::vector<BodyState>> ToldStates::Whole(std::int64_t longest, float dt) const {
  const std::int64_t tick = told_.front().tick;
  std::vector<BodyState> whole;
  for (const Newest& newest : newest_) {
    const std::int64_t ago = tick - newest.tick;
    if (newest.tick < 0 || ago > longest) return std::nullopt;
    whole.push_back(MovedOn(newest.state, static_cast<float>(ago) * dt));
  }
  return whole;
}

bool ToldStates::LeavesOut(std::int64_t longest) const {
  if (newest_tick_ - first_ <= longest) return false;
  return std::any_of(newest_.begin(), newest_.end(),
                     [&](const Newest& newest) { return newest_tick_ - newest.tick > longest; });
}

}  // namespace seam
