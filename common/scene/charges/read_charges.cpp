/// Reads [[charges]].

#include <cstddef>
#include <string>
#include <vector>

#include "common/base/nearest.h"
#include "common/scene/charges/charge.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"
#include "common/scene/toml/scene_text.h"

namespace seam {
namespace {

int FindTrigger(const SceneReader& r, const SceneDraft& draft) {
  const std::string name = r.Text("trigger");
  for (std::size_t t = 0; t < draft.scene.triggers.size(); ++t) {
    if (draft.scene.triggers[t].name == name) return static_cast<int>(t);
  }
  std::vector<std::string> known;
  for (const Trigger& trigger : draft.scene.triggers) known.push_back(trigger.name);
  r.FailAt("trigger",
           "trigger: there is no trigger '" + Printable(name) + "'" + DidYouMean(name, known));
}

void ReadWhen(const SceneReader& r, const SceneDraft& draft, Charge* charge) {
  if (r.Has("at") == r.Has("trigger")) r.Fail("needs either 'at' or 'trigger'");
  if (r.Has("at")) {
    if (r.Has("delay")) r.FailAt("delay", "only a charge with a trigger has a delay");
    charge->at_s = r.Seconds("at", {0, 86400});
    return;
  }
  charge->trigger = FindTrigger(r, draft);
  charge->delay_s = r.Seconds("delay", {0, 86400}, 0.0);
}

void ReadCharge(const TomlNode& node, SceneDraft* draft) {
  SceneReader r(
      node, draft->file, "charge",
      {"name", "position", "part", "radius", "speed", "impulse", "at", "trigger", "delay"});
  Charge charge;
  charge.line = node.line;
  charge.name = r.Name("name");
  r.Rename("charge '" + charge.name + "'");
  for (const Charge& other : draft->scene.charges) {
    if (other.name == charge.name) r.FailAt("name", "there is another charge of this name");
  }
  if (r.Has("part")) {
    charge.part = FindPart(r, "part", *draft);
  } else if (!r.Has("position")) {
    r.Fail("needs a position or a part");
  }
  charge.position = r.Vector("position", kCoordinate, Vec2(0, 0));
  charge.radius = r.Number("radius", {0.1, static_cast<double>(kBlastRadiusMax)});
  charge.speed = r.Number("speed", {0, static_cast<double>(kSpeedMax)}, 0.0f);
  charge.impulse = r.Number("impulse", {0, static_cast<double>(kBlastImpulseMax)}, 0.0f);
  if (charge.speed <= 0 && charge.impulse <= 0) r.Fail("needs a speed or an impulse");
  if (charge.impulse <= 0 && draft->scene.bricks.empty()) {
    r.FailAt("speed", "there are no bricks, so it needs an impulse");
  }
  ReadWhen(r, *draft, &charge);
  if (draft->scene.charges.size() == kChargesMax) r.Fail("a scene may have at most 256 charges");
  draft->scene.charges.push_back(std::move(charge));
}

}  // namespace

void ReadCharges(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("charges")) ReadCharge(*node, draft);
}

}  // namespace seam
