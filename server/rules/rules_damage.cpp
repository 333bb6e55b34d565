/// Rules: damage by impacts, health, and destruction.

#include <algorithm>
#include <limits>

#include "common/scene/character.h"
#include "common/scene/part_rules.h"
#include "common/topology/edit.h"
#include "server/rules/part_owner.h"
#include "server/rules/rules.h"
#include "server/rules/tearing.h"
#include "server/script/script_host.h"

namespace seam {
namespace {

/// Returns nullptr if the part is of none.
const Character* ActiveCharacterOf(const Scene& scene, PartId id) {
  const auto found =
      std::find_if(scene.characters.begin(), scene.characters.end(), [id](const Character& c) {
        return c.active && std::find(c.parts.begin(), c.parts.end(), id) != c.parts.end();
      });
  return found == scene.characters.end() ? nullptr : &*found;
}

}  // namespace

void Rules::RunDamage() {
  violence_.blows = source_.TakeImpacts();
  for (const Blow& blow : violence_.blows) Strike(blow);
}

void Rules::Strike(const Blow& blow) {
  const Composition& c = world_.composition();
  const int index = c.assembly_of_part[static_cast<std::size_t>(world_.id(blow.body))];
  // Hurts the part nearest to the impact among those with health.
  PartId hurt = -1;
  float nearest = std::numeric_limits<float>::max();
  for (const PartId id : c.assemblies[static_cast<std::size_t>(index)].parts) {
    if (scene().parts[static_cast<std::size_t>(id)].rules->health <= 0) continue;
    BodyState state;
    ReadPart(
        world_, id, [this](int body) { return source_.Read(body); }, &state);
    const float distance = (state.position - blow.point).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    hurt = id;
  }
  if (hurt < 0) return;
  const PartRules& rules = *scene().parts[static_cast<std::size_t>(hurt)].rules;
  if (blow.dv <= rules.hurt_above) return;
  const int player = blow.by >= 0 ? PlayerOf(world_, world_.mechanism(blow.by)) : -1;
  Hurt(hurt, (blow.dv - rules.hurt_above) * rules.damage_factor, player);
}

void Rules::Hurt(PartId part, float amount, int by_player) {
  const Part& hurt = scene().parts[static_cast<std::size_t>(part)];
  if (hurt.rules->health <= 0 || amount <= 0 || dead_.count(part) != 0) return;
  const float left = std::max(Health(part) - amount, 0.0f);
  table_.Set({kMetaPart, part, kMetaHealth}, left);
  if (by_player >= 0) struck_by_[part] = by_player;
}

void Rules::RunDeaths() {
  for (const Part& part : scene().parts) {
    const bool dies = part.rules->health > 0 && Health(part.id) <= 0 && dead_.count(part.id) == 0;
    if (dies && Exists(part.id)) Die(part.id);
  }
}

/// Destroys a part, which stays in the room: an active character goes limp for good, and what
/// struck it in this tick tears the joints that it overloads; any other mechanism breaks at its
/// joints or, if it has none, at its welds.
void Rules::Die(PartId id) {
  const Character* const person = ActiveCharacterOf(scene(), id);
  if (person != nullptr) {
    try {
      commands_.Limp(id, kLimpUntilReleased);
    } catch (const ScriptRefusal&) {
      return;  // too many edits are pending: retried in the next tick
    }
  }
  dead_.insert(id);
  const Part& part = scene().parts[static_cast<std::size_t>(id)];
  const auto by = struck_by_.find(id);
  const std::string by_whom = by != struck_by_.end() ? " by " + PlayerName(by->second) : "";
  Event event = MakeEvent(EventKind::kDestroyed, part.name + " is destroyed" + by_whom,
                          by != struck_by_.end() ? by->second : -1);
  event.body = id;
  commands_.Say(event);
  if (by != struck_by_.end() && part.rules->score != 0) {
    table_.Add({kMetaPlayer, by->second, kMetaScore}, part.rules->score);
  }
  if (person != nullptr) {
    const auto read = [this](int body) { return source_.Read(body); };
    return BreakJoints(OverloadedJoints(world_, *person, violence_, read));
  }
  const int mechanism = MechanismOf(world_, id);
  if (mechanism < 0) return;
  const std::vector<Joint>& joints = scene().joints;
  std::vector<int> moving, welds;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const bool own = MechanismOf(world_, joints[j].a) == mechanism ||
                     MechanismOf(world_, joints[j].b) == mechanism;
    if (own) (joints[j].kind == JointKind::kWeld ? welds : moving).push_back(static_cast<int>(j));
  }
  BreakJoints(moving.empty() ? welds : moving);
}

void Rules::BreakJoints(const std::vector<int>& joints) {
  for (const int joint : joints) {
    try {
      commands_.BreakJoint(joint);
    } catch (const ScriptRefusal&) {
      continue;  // it is broken already, or about to be
    }
  }
}

}  // namespace seam
