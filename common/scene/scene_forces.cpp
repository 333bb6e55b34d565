#include "common/scene/forces.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

constexpr Range kForce{-1e6, 1e6};  // N
constexpr Range kBelt{-100, 100};   // m/s

void ReadThrustName(SceneReader* r, const std::string& what, const SceneDraft& draft,
                    Thrust* thrust) {
  thrust->name = r->Name("name");
  r->Rename(what + " '" + thrust->name + "'");
  for (const Thrust& other : draft.scene.thrusts) {
    if (other.name == thrust->name) {
      r->FailAt("name", "there is another " + what + " of this name");
    }
  }
}

Thrust ReadThrust(const TomlNode& node, const SceneDraft& draft) {
  Thrust thrust;
  thrust.line = node.line;
  SceneReader r(node, draft.file, "thrust",
                {"name", "part", "at", "force", "player", "axis", "button"});
  ReadThrustName(&r, "thrust", draft, &thrust);
  thrust.part = FindPart(r, "part", draft);
  thrust.at = r.Vector("at", {-kSizeMaxMax, kSizeMaxMax}, Vec2(0, 0));
  thrust.force = r.Vector("force", kForce);
  thrust.player = ReadAxisDriver(r, draft, &thrust.axis);
  if (!r.Has("button")) return thrust;
  if (thrust.player < 0) r.FailAt("button", "a button needs a player");
  if (r.Has("axis")) r.FailAt("button", "has both axis and button");
  thrust.button = r.Integer("button", {0, 14});
  return thrust;
}

Thrust ReadPropeller(const TomlNode& node, const SceneDraft& draft) {
  Thrust thrust;
  thrust.line = node.line;
  SceneReader r(node, draft.file, "propeller",
                {"name", "part", "at", "along", "diameter", "pitch", "turns", "solidity", "torque",
                 "player", "axis"});
  ReadThrustName(&r, "propeller", draft, &thrust);
  thrust.part = FindPart(r, "part", draft);
  thrust.at = r.Vector("at", {-kSizeMaxMax, kSizeMaxMax}, Vec2(0, 0));
  thrust.force = r.Vector("along", {-1000, 1000}, Vec2(1, 0));
  if (thrust.force.norm() < 1e-3f) r.FailAt("along", "along must be a direction");
  thrust.force.normalize();
  Screw& screw = thrust.screw;
  screw.diameter = r.Number("diameter", {0.02, kSizeMaxMax});
  screw.pitch = r.Number("pitch", {0.001, 1000});
  screw.turns = r.Number("turns", {-1000, 1000});
  screw.solidity = r.Number("solidity", {0.001, 1}, screw.solidity);
  screw.torque = r.Number("torque", {0, 1e6}, 0.0f);
  thrust.player = ReadAxisDriver(r, draft, &thrust.axis);
  return thrust;
}

}  // namespace

void ReadConveyor(const SceneReader& r, const SceneDraft& draft, Part* part) {
  if (!r.IsTable("conveyor")) {
    Conveyor conveyor;
    conveyor.speed = r.Number("conveyor", kBelt, 0.0f);
    part->conveyor.Set(conveyor);
    return;
  }
  const SceneReader c(*r.Table("conveyor"), draft.file, r.what() + ": conveyor",
                      {"player", "axis", "speed"});
  Conveyor conveyor;
  conveyor.speed = c.Number("speed", kBelt);
  conveyor.player = ReadAxisDriver(c, draft, &conveyor.axis);
  part->conveyor.Set(conveyor);
}

void ReadThrusts(const SceneReader& root, SceneDraft* draft) {
  for (const char* table : {"thrust", "propeller"}) {
    const bool screw = table[0] == 'p';
    for (const TomlNode* node : root.Tables(table)) {
      if (draft->scene.thrusts.size() == kThrustsMax) {
        root.Fail("a scene may have at most " + std::to_string(kThrustsMax) +
                  " [[thrust]] and [[propeller]]");
      }
      draft->scene.thrusts.push_back(screw ? ReadPropeller(*node, *draft)
                                           : ReadThrust(*node, *draft));
    }
  }
}

}  // namespace seam
