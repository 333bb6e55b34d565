
#include "common/scene/assembly.h"
#include "common/scene/character.h"
#include "common/scene/character_body.h"
#include "common/scene/part_rules.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

/// Group of the first character's parts; each further character's is one less. Below the range that
/// parts may state.
constexpr int kFirstGroup = -2000;

/// Reads `torque = {hip = 2.5}`, which applies to both sides' joints of that kind.
void ReadTorque(const SceneReader& r, const std::string& file, CharacterDraft* draft) {
  const TomlNode* table = r.Table("torque");
  if (table == nullptr) return;
  const SceneReader t(*table, file, r.what() + ": torque",
                      {"neck", "shoulder", "elbow", "hip", "knee", "ankle"});
  for (int j = 0; j < kCharacterJoints; ++j) {
    const std::string full = NameOf(static_cast<CharacterJoint>(j));
    const std::string kind = full.substr(0, full.find('-'));
    if (!t.Has(kind.c_str())) continue;
    draft->torque[static_cast<std::size_t>(j)] = t.Number(kind.c_str(), {1e-3, 1e6});
  }
}

bool ReadChoice(const SceneReader& r, const char* key, const char* yes, const char* no) {
  const std::string said = r.Text(key, yes);
  if (said != yes && said != no) {
    r.FailAt(key, std::string(key) + " must be '" + yes + "' or '" + no + "'");
  }
  return said == yes;
}

CharacterDraft ReadDraft(const SceneReader& r, const std::string& name, const SceneDraft& scene) {
  CharacterDraft draft;
  Character& c = draft.character;
  c.name = name;
  c.line = r.line();
  c.active = ReadChoice(r, "kind", "active", "passive");
  c.facing = ReadChoice(r, "facing", "right", "left") ? 1.0f : -1.0f;
  c.height = r.Number("height", kCharacterHeight, c.height);
  draft.position = r.Vector("position", kCoordinate);
  draft.angle = r.Number("angle", {-100, 100, true}, 0.0f);
  draft.density = r.Number("density", kDensity, draft.density);
  draft.friction = r.Number("friction", {0, 1}, draft.friction);
  draft.strength = r.Number("strength", {0.01, 100}, draft.strength);
  ReadTorque(r, scene.file, &draft);
  const float limit = scene.scene.speed_limit;
  draft.velocity = r.Vector("velocity", {-limit, limit}, Vec2(0, 0));
  if (draft.velocity.norm() > limit) {
    r.FailAt("velocity", "velocity is above the speed_limit of " + Decimal(limit) + " m/s");
  }
  c.tears_above = r.Number("tears_above", {0, 1e6}, c.tears_above);
  if (r.Has("tears_above") && !c.active) {
    r.FailAt("tears_above", "all joints of a passive character break when it dies");
  }
  c.grip = r.Flag("grip", false);
  if (c.grip && !c.active) r.FailAt("grip", "a passive character holds nothing");
  if (r.Has("player")) c.player = FindPlayer(r, "player", r.Text("player"), scene);
  if (c.player >= 0 && !c.active) r.FailAt("player", "a passive character has no player");
  draft.owner = c.player;
  if (r.Has("owner")) draft.owner = FindPlayer(r, "owner", r.Text("owner"), scene);
  return draft;
}

void AddParts(const SceneReader& r, CharacterDraft* draft, SceneDraft* out) {
  Scene& scene = out->scene;
  std::vector<PartId>& group = out->group_of_name[draft->character.name];
  for (Part& part : CharacterParts(*draft)) {
    const bool inside = (part.position.array() >= scene.bounds_min.array()).all() &&
                        (part.position.array() <= scene.bounds_max.array()).all();
    if (!inside) r.FailAt("position", "'" + part.name + "' lies outside the bounds");
    if (Full(scene.parts, kPartsMax)) {
      r.Fail("a scene may have at most " + std::to_string(kPartsMax) + " parts");
    }
    part.id = static_cast<PartId>(scene.parts.size());
    draft->character.parts[group.size()] = part.id;
    out->part_of_name[part.name] = part.id;
    group.push_back(part.id);
    scene.parts.push_back(part);
  }
}

void AddHinges(const SceneReader& r, CharacterDraft* draft, SceneDraft* out) {
  Scene& scene = out->scene;
  Character& c = draft->character;
  float mass = 0;
  for (const PartId id : c.parts) mass += PartMass(scene.parts[static_cast<std::size_t>(id)]);
  std::size_t j = 0;
  for (Joint& joint : CharacterHinges(*draft, mass)) {
    if (scene.joints.size() == kJointsMax) {
      r.Fail("a scene may have at most " + std::to_string(kJointsMax) + " joints");
    }
    c.joints[j] = static_cast<int>(scene.joints.size());
    c.slack[j] = joint.motor_torque * (c.active ? kCharacterSlack : 1.0f);
    out->joint_names.insert(joint.name);
    scene.joints.push_back(joint);
    ++j;
  }
}

void ReadCharacter(const TomlNode& node, SceneDraft* draft) {
  SceneReader r(
      node, draft->file, "character",
      {"name", "kind", "player", "owner", "position", "angle", "facing", "height", "density",
       "friction", "strength", "torque", "velocity", "health", "grip", "group", "tears_above"});
  const std::string name = r.Name("name");
  r.Rename("character '" + name + "'");
  if (draft->part_of_name.count(name) != 0 || draft->group_of_name.count(name) != 0) {
    r.FailAt("name", "there is a part or character of this name");
  }
  if (draft->scene.characters.size() == kCharactersMax) {
    r.Fail("a scene may have at most " + std::to_string(kCharactersMax) + " characters");
  }
  CharacterDraft character = ReadDraft(r, name, *draft);
  character.group = kFirstGroup - static_cast<int>(draft->scene.characters.size());
  if (r.Has("group")) character.group = r.Integer("group", {-1000, -1});
  AddParts(r, &character, draft);
  const float health = r.Number("health", {0, 1e6}, 0.0f);
  for (const char* vital : {".head", ".torso"}) {
    const PartId id = draft->part_of_name.at(name + vital);
    Feature<PartRules>& of_part = draft->scene.parts[static_cast<std::size_t>(id)].rules;
    PartRules rules = *of_part;
    rules.health = health;
    of_part.Set(rules);
  }
  AddHinges(r, &character, draft);
  draft->scene.characters.push_back(character.character);
}

}  // namespace

void ReadCharacters(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("character")) ReadCharacter(*node, draft);
}

}  // namespace seam
