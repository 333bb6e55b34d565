#pragma once
/// A single world with scripted players: the single-world run of a scene file. Edits proposed by
/// physics (breaks, bonds) are applied at once.

#include <string>
#include <vector>

#include "common/physics/world.h"

namespace seam {

class ScriptedWorld {
 public:
  explicit ScriptedWorld(const Scene& scene)
      : world(scene), before_(world.scene().players.size()) {}
  /// Loads scenes/`name`.toml; the tests run in the repository's root.
  explicit ScriptedWorld(const std::string& name)
      : ScriptedWorld(LoadScene("scenes/" + name + ".toml")) {}

  /// Sets the inputs of the next tick, applies the edits of newly pressed buttons, and steps.
  void Step() {
    const std::int64_t tick = world.tick() + 1;
    for (std::size_t p = 0; p < before_.size(); ++p) {
      const Player& player = world.scene().players[p];
      Input input;
      for (const InputSpan& span : player.script) {
        if (span.from_tick <= tick) input = span.input;
      }
      world.SetInput(static_cast<int>(p), input);
      const int pressed = input.buttons & ~before_[p].buttons;
      for (std::size_t a = 0; a < player.actions.size(); ++a) {
        if ((pressed >> player.actions[a].button) & 1) {
          world.Act(static_cast<int>(p), static_cast<int>(a));
        }
      }
      before_[p] = input;
    }
    world.Step();
    const std::vector<Edit> edits = world.ProposeEdits();
    if (!edits.empty()) world.Apply(edits);
  }
  void StepTo(std::int64_t tick) {
    while (world.tick() < tick) Step();
  }

  /// Returns the body of a named part; -1 if there is none or it does not move.
  int Body(const std::string& part) const {
    for (const Part& p : world.scene().parts) {
      if (p.name != part) continue;
      const Composition& c = world.composition();
      const int assembly = c.assembly_of_part[static_cast<std::size_t>(p.id)];
      return world.BodyOfId(c.assemblies[static_cast<std::size_t>(assembly)].id);
    }
    return -1;
  }
  BodyState Read(const std::string& part) const { return world.Read(Body(part)); }

  World world;

 private:
  std::vector<Input> before_;
};

}  // namespace seam
