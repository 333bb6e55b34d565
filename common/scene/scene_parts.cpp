
#include "common/scene/connectors.h"
#include "common/scene/forces.h"
#include "common/scene/mass.h"
#include "common/scene/motion/part_motion.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

void ReadMotion(const SceneReader& r, float speed_limit, Part* part) {
  part->bullet = r.Flag("bullet", false);
  part->velocity = r.Vector("velocity", {-speed_limit, speed_limit}, Vec2(0, 0));
  part->spin = r.Number("spin", {-kSpinMax, kSpinMax}, 0.0f);
  if (part->velocity.norm() > speed_limit) {
    r.FailAt("velocity", "velocity is above the speed_limit of " + Decimal(speed_limit) + " m/s");
  }
  if (part->anchored && (r.Has("velocity") || r.Has("spin"))) {
    r.Fail("an anchored part cannot have velocity or spin");
  }
}

/// Single precision holds a body's moment of inertia about its position, from which the engine
/// subtracts that of its mass at the centre: the rest has to be left.
void CheckCentre(const SceneReader& r, const Part& part) {
  if (part.anchored) return;
  const MassProperties own = PartProperties(part);
  if (own.inertia > kInertiaLeft * own.mass * own.centre.squaredNorm()) return;
  r.Fail("its shape lies too far from its position for its size");
}

/// Returns the owners of the copies, in turn; -1 for nobody.
std::vector<int> ReadOwners(const SceneReader& r, const SceneDraft& draft, bool anchored) {
  if (r.Has("owner") && r.Has("owners")) r.Fail("has both owner and owners");
  const char* key = r.Has("owners") ? "owners" : "owner";
  std::vector<int> owners = FindPlayers(r, key, draft);
  if (r.Has("owner") && owners.size() != 1) r.FailAt("owner", "owner must be one player's name");
  if (r.Has("owners") && owners.empty()) r.FailAt("owners", "owners is empty");
  if (anchored && !owners.empty()) r.FailAt(key, "an anchored part cannot have an owner");
  if (owners.empty()) owners.push_back(-1);
  return owners;
}

void Place(const SceneReader& r, Part part, const std::string& name, SceneDraft* draft) {
  Scene& scene = draft->scene;
  const bool inside = (part.position.array() >= scene.bounds_min.array()).all() &&
                      (part.position.array() <= scene.bounds_max.array()).all();
  if (!part.anchored && !inside) r.FailAt("position", "'" + name + "' lies outside the bounds");
  if (Full(scene.parts, kPartsMax)) {
    r.Fail("a scene may have at most " + std::to_string(kPartsMax) + " parts");
  }
  part.id = static_cast<PartId>(scene.parts.size());
  part.name = name;
  draft->part_of_name[name] = part.id;
  scene.parts.push_back(std::move(part));
}

/// Joins neighbouring copies: joint "name.h.2.0" joins copy (2, 0) with (3, 0), "name.v.2.0" with
/// (2, 1).
void JoinCopies(const SceneReader& r, const Repeat& repeat, const std::string& name,
                const std::vector<PartId>& group, SceneDraft* draft) {
  const auto part = [&](int column, int row) {
    return group[static_cast<std::size_t>(column * repeat.rows + row)];
  };
  const auto join = [&](const char* way, int column, int row, PartId to) {
    if (Full(draft->scene.joints, kJointsMax)) {
      r.FailAt("repeat", "a scene may have at most " + std::to_string(kJointsMax) + " joints");
    }
    Joint joint;
    joint.name = name + way + repeat.Suffix(column, row);
    joint.kind = repeat.kind;
    joint.strength = repeat.strength;
    joint.a = part(column, row);
    joint.b = to;
    const std::vector<Part>& parts = draft->scene.parts;
    joint.anchor_a = joint.anchor_b = (parts[static_cast<std::size_t>(joint.a)].position +
                                       parts[static_cast<std::size_t>(to)].position) /
                                      2;
    joint.line = r.line();
    draft->joint_names.insert(joint.name);
    draft->scene.joints.push_back(joint);
  };
  for (int column = 0; column < repeat.columns; ++column) {
    for (int row = 0; row < repeat.rows; ++row) {
      if (column + 1 < repeat.columns) join(".h", column, row, part(column + 1, row));
      if (row + 1 < repeat.rows) join(".v", column, row, part(column, row + 1));
    }
  }
}

/// Makes a copy's conveyor follow the corresponding copy of the first one's player.
void FollowCopy(const SceneReader& r, int followed, const Repeat& repeat, int column, int row,
                const SceneDraft& draft, Part* part) {
  if (followed < 0) return;
  Conveyor conveyor = *part->conveyor;
  conveyor.player = PlayerAfter(r, followed, column, row, repeat.grid, draft);
  part->conveyor.Set(conveyor);
}

void ReadPart(const TomlNode& node, SceneDraft* draft) {
  SceneReader r(
      node, draft->file, "part",
      {"name",          "box",           "circle",      "capsule",        "wedge",
       "polygon",       "chain",         "segment",     "position",       "angle",
       "density",       "friction",      "restitution", "anchored",       "bullet",
       "group",         "conveyor",      "velocity",    "spin",           "owner",
       "owners",        "repeat",        "health",      "damage",         "score",
       "permissions",   "inlets",        "outlets",     "join_strength",  "join_reach",
       "join_angle",    "category",      "mask",        "linear_damping", "angular_damping",
       "gravity_scale", "fixed_rotation"});
  const std::string name = r.Name("name");
  r.Rename("part '" + name + "'");
  if (draft->part_of_name.count(name) != 0 || draft->group_of_name.count(name) != 0) {
    r.FailAt("name", "there is another part of this name");
  }
  Part part;
  part.line = r.line();
  part.anchored = r.Flag("anchored", r.Has("chain") || r.Has("segment"));
  ReadShape(r, part.anchored ? kSizeMaxMax : draft->size_max, &part);
  part.position = r.Vector("position", kCoordinate, Vec2(0, 0));
  part.angle = r.Number("angle", {-100, 100, true}, 0.0f);
  part.material.density = r.Number("density", kDensity, part.material.density);
  part.material.friction = r.Number("friction", {0, 1}, part.material.friction);
  part.material.restitution = r.Number("restitution", {0, 1}, part.material.restitution);
  ReadConveyor(r, *draft, &part);
  ReadMotion(r, draft->scene.speed_limit, &part);
  ReadPartMotion(r, &part);
  CheckCentre(r, part);
  part.rules.Set(ReadPartRules(r, *draft));
  part.connectors.Set(ReadConnectors(r));
  const std::vector<int> owners = ReadOwners(r, *draft, part.anchored);
  const Repeat repeat = ReadRepeat(r, draft->file);

  if (!r.Has("repeat")) {
    if (owners.size() != 1) r.FailAt("owners", "several owners need repeat");
    part.owner = owners[0];
    Place(r, part, name, draft);
    return;
  }
  const Vec2 first = part.position;
  const int followed = part.conveyor->player;
  std::vector<PartId>& group = draft->group_of_name[name];
  for (int column = 0; column < repeat.columns; ++column) {
    for (int row = 0; row < repeat.rows; ++row) {
      part.position = first + repeat.Offset(column, row);
      part.owner = owners[group.size() % owners.size()];
      FollowCopy(r, followed, repeat, column, row, *draft, &part);
      group.push_back(static_cast<PartId>(draft->scene.parts.size()));
      Place(r, part, name + repeat.Suffix(column, row), draft);
    }
  }
  if (repeat.joined) JoinCopies(r, repeat, name, group, draft);
}

}  // namespace

void ReadParts(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("part")) ReadPart(*node, draft);
  if (draft->scene.parts.empty()) root.Fail("there is no [[part]]");
}

}  // namespace seam
