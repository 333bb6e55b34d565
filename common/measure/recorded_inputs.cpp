#include "common/measure/recorded_inputs.h"

#include <iterator>

namespace seam {

void RecordedInputs::Add(const Recording& recording, const Scene& scene) {
  for (const auto& [player, pieces] : recording.inputs) {
    const bool known = player >= 0 && static_cast<std::size_t>(player) < scene.players.size();
    if (!known) continue;
    Ticks& ticks = by_player_[player];
    for (const auto& [first_tick, piece] : pieces) {
      for (std::size_t i = 0; i < piece.drive.size(); ++i) {
        ticks.try_emplace(first_tick + static_cast<std::int64_t>(i),
                          Input{piece.drive[i], piece.lift[i], piece.buttons[i]});
      }
    }
  }
}

void RecordedInputs::Forget(std::int64_t before_tick) {
  for (auto& [player, ticks] : by_player_) {
    const auto kept = ticks.lower_bound(before_tick);
    if (kept != ticks.begin()) ticks.erase(ticks.begin(), std::prev(kept));
  }
}

void RecordedInputs::Apply(World* world, int player, std::int64_t tick) const {
  const auto inputs = by_player_.find(player);
  if (inputs == by_player_.end()) return;
  const auto now = inputs->second.find(tick);
  if (now == inputs->second.end()) return;
  world->SetInput(player, now->second);
  const int before = now == inputs->second.begin() ? 0 : std::prev(now)->second.buttons;
  const int pressed = now->second.buttons & ~before;
  const auto& actions = world->scene().players[static_cast<std::size_t>(player)].actions;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if ((pressed >> actions[a].button) & 1) world->Act(player, static_cast<int>(a));
  }
}

void RecordedInputs::Hold(World* world, int player, std::int64_t tick) const {
  const auto inputs = by_player_.find(player);
  if (inputs == by_player_.end()) return;
  const auto after = inputs->second.upper_bound(tick);
  const bool none = after == inputs->second.begin();
  world->SetInput(player, none ? Input{} : std::prev(after)->second);
}

bool RecordedInputs::Holds(int player, std::int64_t known, std::int64_t tick) const {
  const auto inputs = by_player_.find(player);
  if (inputs == by_player_.end()) return true;
  auto next = inputs->second.upper_bound(known);
  const Input held = next == inputs->second.begin() ? Input{} : std::prev(next)->second;
  for (; next != inputs->second.end() && next->first <= tick; ++next) {
    if (!(next->second == held)) return false;
  }
  return true;
}

std::vector<int> RecordedInputs::players() const {
  std::vector<int> players;
  for (const auto& [player, ticks] : by_player_) players.push_back(player);
  return players;
}

}  // namespace seam
