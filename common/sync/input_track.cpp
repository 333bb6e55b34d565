#include "common/sync/input_track.h"

namespace seam {

void InputTrack::Note(std::int64_t tick, const Input& input) {
  if (!known_.empty() && tick < known_.rbegin()->first - kKeepTicks) return;
  known_.emplace(tick, input);
  while (known_.begin()->first < known_.rbegin()->first - kKeepTicks) known_.erase(known_.begin());
}

void InputTrack::Note(const Inputs& inputs) {
  for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
    Note(inputs.first_tick + static_cast<std::int64_t>(i),
         Input{inputs.drive[i], inputs.lift[i], inputs.buttons[i]});
  }
}

Input InputTrack::At(std::int64_t tick) const {
  auto after = known_.upper_bound(tick);
  if (after == known_.begin()) return Input{};
  return std::prev(after)->second;
}

bool InputTrack::Surprises(std::int64_t from) const {
  for (auto it = known_.lower_bound(from); it != known_.end(); ++it) {
    const Input guess = it == known_.begin() ? Input{} : std::prev(it)->second;
    if (!(it->second == guess)) return true;
  }
  return false;
}

std::int16_t InputTrack::TakePresses(std::int64_t tick) {
  int pressed = 0;
  for (auto it = known_.upper_bound(presses_taken_until_); it != known_.end() && it->first <= tick;
       ++it) {
    const int before = it == known_.begin() ? 0 : std::prev(it)->second.buttons;
    pressed |= it->second.buttons & ~before;
    presses_taken_until_ = it->first;
  }
  return static_cast<std::int16_t>(pressed);
}

std::int16_t InputTrack::PressedAt(std::int64_t tick) const {
  const auto now = known_.find(tick);
  if (now == known_.end()) return 0;
  const int before = now == known_.begin() ? 0 : std::prev(now)->second.buttons;
  return static_cast<std::int16_t>(now->second.buttons & ~before);
}

Inputs InputTrack::Export(int player, int count) const {
  Inputs out;
  out.player = player;
  if (known_.empty()) return out;
  std::int64_t first = newest();
  while (newest() - first + 1 < count && knows(first - 1)) --first;
  out.first_tick = first;
  for (auto it = known_.find(first); it != known_.end(); ++it) {
    out.drive.push_back(it->second.drive);
    out.lift.push_back(it->second.lift);
    out.buttons.push_back(it->second.buttons);
  }
  return out;
}

}  // namespace seam
