#pragma once
/// Plays the scripts of a scene's players into a world that is stepped alone.

#include <vector>

#include "common/sync/inputs/input_source.h"

namespace seam {

class ScriptPlayer {
 public:
  explicit ScriptPlayer(const Scene& scene) : before_(scene.players.size()) {}

  /// Gives `world` the inputs of `tick`; call it before the step that leads there. `AnyWorld` has
  /// World's SetInput and Act.
  template <typename AnyWorld>
  void Play(const Scene& scene, std::int64_t tick, AnyWorld* world) {
    for (std::size_t i = 0; i < scene.players.size(); ++i) {
      if (scene.players[i].script.empty()) continue;
      const int player = static_cast<int>(i);
      const Input now = ScriptedInput(scene, player, tick);
      if (!(now == before_[i])) world->SetInput(player, now);
      const int pressed = now.buttons & ~before_[i].buttons;
      for (std::size_t a = 0; a < scene.players[i].actions.size(); ++a) {
        if ((pressed >> scene.players[i].actions[a].button) & 1) {
          world->Act(player, static_cast<int>(a));
        }
      }
      before_[i] = now;
    }
  }

 private:
  std::vector<Input> before_;  // by player: of the last tick
};

}  // namespace seam
