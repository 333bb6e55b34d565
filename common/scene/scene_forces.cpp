#include <algorithm>

#include "common/scene/forces.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

constexpr Range kForce{-1e6, 1e6};  // N
constexpr Range kBelt{-100, 100};   // m/s

Thrust ReadThrust(const TomlNode& node, const SceneDraft& draft) {
  Thrust thrust;
  thrust.line = node.line;
  SceneReader r(node, draft.file, "thrust",
                {"name", "part", "at", "force", "player", "axis", "button"});
  thrust.name = r.Name("name");
  r.Rename("thrust '" + thrust.name + "'");
  const FeatureList<Thrust>& all = draft.scene.thrusts;
  const auto same = [&](const Thrust& other) { return other.name == thrust.name; };
  if (std::any_of(all.begin(), all.end(), same)) {
    r.FailAt("name", "there is another thrust of this name");
  }
  thrust.part = FindPart(r, "part", draft);
  thrust.at = r.Vector("at", {-kSizeMaxMax, kSizeMaxMax}, Vec2(0, 0));
  thrust.force = r.Vector("force", kForce);
  thrust.player = ReadFollowed(r, draft, &thrust.axis);
  if (!r.Has("button")) return thrust;
  if (thrust.player < 0) r.FailAt("button", "a button needs a player");
  if (r.Has("axis")) r.FailAt("button", "has both axis and button");
  thrust.button = r.Integer("button", {0, 14});
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
  conveyor.player = ReadFollowed(c, draft, &conveyor.axis);
  part->conveyor.Set(conveyor);
}

void ReadThrusts(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("thrust")) {
    if (draft->scene.thrusts.size() == kThrustsMax) {
      root.Fail("a scene may have at most " + std::to_string(kThrustsMax) + " [[thrust]]");
    }
    draft->scene.thrusts.push_back(ReadThrust(*node, *draft));
  }
}

}  // namespace seam
