/// Reads [[script]], [[trigger]], and a part's health, score and permissions.

#include <algorithm>

#include "common/base/check.h"
#include "common/scene/charges/charge.h"
#include "common/scene/part_rules.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

constexpr std::size_t kScriptsMax = 8, kTriggersMax = 256;
constexpr Range kInstructions{1000, 2000000}, kMemoryKb{256, 65536};
constexpr Range kPoints{-1e6, 1e6};

/// Returns the line of the file on which code begins: the line of the opening quotes, or the next
/// one if the quotes end their line.
int FirstLine(const SceneReader& r, const char* key, const std::string& text) {
  const int line = r.LineOf(key);
  std::size_t at = 0;
  for (int n = 1; n < line && at != std::string::npos; ++n) {
    at = text.find('\n', at);
    if (at != std::string::npos) ++at;
  }
  if (at == std::string::npos) return line;
  std::string row = text.substr(at, text.find('\n', at) - at);
  if (!row.empty() && row.back() == '\r') row.pop_back();
  const bool opens = row.size() >= 3 && (row.compare(row.size() - 3, 3, "'''") == 0 ||
                                         row.compare(row.size() - 3, 3, "\"\"\"") == 0);
  return opens ? line + 1 : line;
}

void AddScript(const SceneReader& r, const char* key, ScriptSource script, SceneDraft* draft) {
  script.code = r.Code(key);
  script.line = FirstLine(r, key, draft->scene.text);
  for (const ScriptSource& other : draft->scene.scripts) {
    if (other.name == script.name) r.FailAt("name", "there is another script of this name");
  }
  if (draft->scene.scripts.size() == kScriptsMax) r.Fail("a scene may have at most 8 scripts");
  draft->scene.scripts.push_back(std::move(script));
}

/// Returns the players named at `key`; everyone if it is absent.
PlayerMask ReadMask(const SceneReader& r, const char* key, const SceneDraft& draft) {
  if (!r.Has(key)) return kEveryPlayer;
  PlayerMask mask;
  for (const int player : FindPlayers(r, key, draft)) mask.Add(player);
  return mask;
}

TriggerKind ReadTriggerKind(const SceneReader& r) {
  const std::string kind = r.Text("kind", "area");
  if (kind == "area") return TriggerKind::kArea;
  if (kind == "checkpoint") return TriggerKind::kCheckpoint;
  if (kind == "pickup") return TriggerKind::kPickup;
  if (kind == "hazard") return TriggerKind::kHazard;
  r.FailAt("kind", "kind must be area, checkpoint, pickup or hazard");
}

/// Returns the parts that a trigger reacts to by default: the players' vehicles; for a hazard, all
/// movable parts with health as well.
std::vector<PartId> DefaultParts(const Trigger& trigger, const SceneDraft& draft,
                                 const std::vector<PartId>& vehicles) {
  std::vector<PartId> parts = vehicles;
  for (const Part& part : draft.scene.parts) {
    const bool hurt = trigger.kind == TriggerKind::kHazard && part.rules->health > 0;
    if (hurt && !part.anchored && part.id != trigger.part) parts.push_back(part.id);
  }
  return parts;
}

void ReadTrigger(const TomlNode& node, const std::vector<PartId>& vehicles, SceneDraft* draft) {
  SceneReader r(node, draft->file, "trigger",
                {"name", "kind", "position", "box", "part", "for", "players", "once", "order",
                 "score", "health"});
  Trigger trigger;
  trigger.line = node.line;
  trigger.name = r.Name("name");
  r.Rename("trigger '" + trigger.name + "'");
  for (const Trigger& other : draft->scene.triggers) {
    if (other.name == trigger.name) r.FailAt("name", "there is another trigger of this name");
  }
  trigger.kind = ReadTriggerKind(r);
  const bool checkpoint = trigger.kind == TriggerKind::kCheckpoint;
  const bool gives = trigger.kind == TriggerKind::kPickup || trigger.kind == TriggerKind::kHazard;
  if (r.Has("order") && !checkpoint) r.FailAt("order", "only a checkpoint has an order");
  if (r.Has("health") && !gives) r.FailAt("health", "only a pickup or a hazard has health");
  if (checkpoint) trigger.order = r.Integer("order", {1, 1000});
  trigger.size = r.Vector("box", {kEdgeMin, 1000});
  if (r.Has("part"))
    trigger.part = FindPart(r, "part", *draft);
  else if (!r.Has("position"))
    r.Fail("needs a position or a part");
  trigger.position = r.Vector("position", kCoordinate, Vec2(0, 0));
  trigger.players = ReadMask(r, "players", *draft);
  if (trigger.kind == TriggerKind::kPickup && trigger.part >= 0) {
    trigger.players &= draft->scene.parts[static_cast<std::size_t>(trigger.part)].rules->take;
  }
  trigger.score = r.Number("score", kPoints, 0.0f);
  const Range amounts = trigger.kind == TriggerKind::kHazard ? Range{0, 1e6} : kPoints;
  trigger.health = gives ? r.Number("health", amounts, 0.0f) : 0;
  trigger.once = r.Flag("once", trigger.kind == TriggerKind::kPickup);
  if (trigger.kind == TriggerKind::kPickup && !trigger.once) {
    r.FailAt("once", "a pickup is taken once");
  }
  for (const std::string& name : r.Texts("for")) {
    for (const PartId part : FindParts(r, "for", name, *draft)) trigger.parts.push_back(part);
  }
  if (!r.Has("for")) trigger.parts = DefaultParts(trigger, *draft, vehicles);
  std::sort(trigger.parts.begin(), trigger.parts.end());
  trigger.parts.erase(std::unique(trigger.parts.begin(), trigger.parts.end()), trigger.parts.end());
  if (trigger.parts.empty()) r.Fail("nobody can enter: say 'for' which parts it is");
  if (std::count(trigger.parts.begin(), trigger.parts.end(), trigger.part) != 0) {
    r.FailAt("for", "a part cannot enter its own trigger");
  }
  if (draft->scene.triggers.size() == kTriggersMax) r.Fail("a scene may have at most 256 triggers");
  draft->scene.triggers.push_back(std::move(trigger));
}

}  // namespace

PartRules ReadPartRules(const SceneReader& r, const SceneDraft& draft) {
  PartRules rules;
  rules.health = r.Number("health", {0, 1e6}, 0.0f);
  rules.score = r.Number("score", kPoints, 0.0f);
  if (const TomlNode* node = r.Table("damage")) {
    if (rules.health <= 0) r.FailAt("damage", "damage needs health");
    const SceneReader d(*node, draft.file, r.what() + ": damage", {"above", "factor"});
    rules.hurt_above = d.Number("above", {0, 1000}, rules.hurt_above);
    rules.damage_factor = d.Number("factor", {0, 1e6}, rules.damage_factor);
  }
  if (const TomlNode* node = r.Table("permissions")) {
    const SceneReader p(*node, draft.file, r.what() + ": permissions", {"drive", "push", "take"});
    rules.drive = ReadMask(p, "drive", draft);
    rules.push = ReadMask(p, "push", draft);
    rules.take = ReadMask(p, "take", draft);
  }
  return rules;
}

void ReadTriggers(const SceneReader& root, SceneDraft* draft) {
  std::vector<PartId> vehicles;
  for (const Player& player : draft->scene.players) {
    if (player.vehicle >= 0) vehicles.push_back(player.vehicle);
  }
  for (const TomlNode* node : root.Tables("trigger")) ReadTrigger(*node, vehicles, draft);
}

void ReadScripts(const SceneReader& root, SceneDraft* draft) {
  if (!root.Has("script")) return;
  if (root.IsText("script")) return AddScript(root, "script", {"script", "", 1, {}}, draft);
  for (const TomlNode* node : root.Tables("script")) {
    SceneReader r(*node, draft->file, "script", {"name", "code", "instructions", "memory"});
    ScriptSource script;
    script.name = r.Name("name");
    r.Rename("script '" + script.name + "'");
    script.limits.instructions = r.Integer("instructions", kInstructions, 200000);
    script.limits.memory_bytes = std::int64_t{1024} * r.Integer("memory", kMemoryKb, 4096);
    AddScript(r, "code", std::move(script), draft);
  }
}

void CheckPermissions(const Scene& scene, const std::string& file) {
  const auto fail = [&](int line, const std::string& what) {
    throw OperatorError(file + ":" + std::to_string(line) + ": " + what);
  };
  const auto part = [&](PartId id) -> const Part& {
    return scene.parts[static_cast<std::size_t>(id)];
  };
  for (const Joint& joint : scene.joints) {
    const bool by_player =
        joint.motor_player >= 0 && joint.motor_player < static_cast<int>(scene.players.size());
    if (!by_player) continue;  // always on, or a seat's
    for (const PartId id : {joint.a, joint.b}) {
      if (Allows(part(id).rules->drive, joint.motor_player)) continue;
      fail(joint.line,
           "joint '" + joint.name + "': its player may not drive '" + part(id).name + "'");
    }
  }
  for (std::size_t p = 0; p < scene.players.size(); ++p) {
    for (const Action& action : scene.players[p].actions) {
      if (Allows(part(action.part).rules->push, static_cast<int>(p))) continue;
      fail(action.line,
           "player '" + scene.players[p].name + "': may not push '" + part(action.part).name + "'");
    }
  }
  for (const Part& owned : scene.parts) {
    if (owned.owner < 0 || Allows(owned.rules->push, owned.owner)) continue;
    fail(owned.line, "part '" + owned.name + "': its owner may not push it");
  }
}

bool NeedsRules(const Scene& scene) {
  return !scene.triggers.empty() || !scene.scripts.empty() || !scene.charges.empty() ||
         std::any_of(scene.parts.begin(), scene.parts.end(),
                     [](const Part& part) { return part.rules->health > 0; });
}

}  // namespace seam
