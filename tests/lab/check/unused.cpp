#include <fmt/format.h>

#include <algorithm>

#include "common/scene/assembly.h"
#include "common/scene/character.h"
#include "common/scene/charges/charge.h"
#include "common/scene/forces.h"
#include "common/scene/part_rules.h"
#include "tests/lab/check/scene_check.h"

namespace seam {
namespace {

/// Whether anything follows the inputs of a player or seat.
bool DrivesSomething(const Scene& scene, int player) {
  const auto any = [player](const auto& list, const auto& follows) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& item) { return follows(item) == player; });
  };
  return any(scene.joints, [](const Joint& joint) { return joint.motor_player; }) ||
         any(scene.thrusts, [](const Thrust& thrust) { return thrust.player; }) ||
         any(scene.characters, [](const Character& character) { return character.player; }) ||
         any(scene.parts, [](const Part& part) { return part.conveyor->player; });
}

void FindIdlePlayers(const Scene& scene, std::vector<Finding>* findings) {
  for (std::size_t p = 0; p < scene.players.size(); ++p) {
    const Player& player = scene.players[p];
    const int index = static_cast<int>(p);
    const bool owns = std::any_of(scene.parts.begin(), scene.parts.end(),
                                  [index](const Part& part) { return part.owner == index; });
    if (player.vehicle >= 0 || owns || !player.actions.empty()) continue;
    if (DrivesSomething(scene, index)) continue;
    // A region is a reason to be there: what is in it is simulated by this player's peer.
    if (player.has_region && player.script.empty()) continue;
    findings->push_back({player.line, fmt::format("player '{}' has no vehicle, owns nothing and "
                                                  "drives nothing",
                                                  player.name)});
  }
}

void FindIdleSeats(const Scene& scene, std::vector<Finding>* findings) {
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    if (DrivesSomething(scene, static_cast<int>(scene.players.size() + s))) continue;
    findings->push_back({scene.seats[s].line, fmt::format("seat '{}': no motor and no thrust "
                                                          "follows who sits there",
                                                          scene.seats[s].name)});
  }
}

/// Whether what happens in the trigger is of use to anybody.
bool DoesSomething(const Scene& scene, std::size_t index) {
  const Trigger& trigger = scene.triggers[index];
  const auto fires = [index](const Charge& charge) {
    return charge.trigger == static_cast<int>(index);
  };
  return trigger.score != 0 || trigger.health != 0 || trigger.kind == TriggerKind::kCheckpoint ||
         !scene.scripts.empty() || std::any_of(scene.charges.begin(), scene.charges.end(), fires);
}

/// Whether all that a trigger looks for never moves, and is outside of it.
bool NothingComes(const Scene& scene, const Composition& composition, const Trigger& trigger) {
  return std::all_of(trigger.parts.begin(), trigger.parts.end(), [&](PartId id) {
    const int index = composition.assembly_of_part[static_cast<std::size_t>(id)];
    const Assembly& assembly = composition.assemblies[static_cast<std::size_t>(index)];
    const Vec2 away =
        (scene.parts[static_cast<std::size_t>(id)].position - trigger.position).cwiseAbs();
    const bool inside = (away - trigger.size / 2).maxCoeff() <= 0;
    return assembly.anchored && assembly.kinematic < 0 && !inside;
  });
}

void FindIdleTriggers(const Scene& scene, std::vector<Finding>* findings) {
  const Composition composition = Compose(scene);
  for (std::size_t i = 0; i < scene.triggers.size(); ++i) {
    const Trigger& trigger = scene.triggers[i];
    const auto found = [&](const std::string& what) {
      findings->push_back({trigger.line, fmt::format("trigger '{}' {}", trigger.name, what)});
    };
    const Vec2 low = trigger.position - trigger.size / 2,
               high = trigger.position + trigger.size / 2;
    const bool out =
        (scene.bounds_min - high).maxCoeff() > 0 || (low - scene.bounds_max).maxCoeff() > 0;
    if (trigger.part < 0 && out) {
      found("lies out of the scene's bounds: nothing can enter it");
    } else if (trigger.part < 0 && !trigger.parts.empty() &&
               NothingComes(scene, composition, trigger)) {
      found("looks for what never moves and is outside of it: nothing can enter it");
    }
    if (!DoesSomething(scene, i)) {
      found(
          "is never used: it has no score and no health, and no charge and no script hears of it");
    }
  }
}

}  // namespace

void FindUnused(const Scene& scene, std::vector<Finding>* findings) {
  FindIdlePlayers(scene, findings);
  FindIdleSeats(scene, findings);
  FindIdleTriggers(scene, findings);
}

}  // namespace seam
