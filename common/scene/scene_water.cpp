#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"
#include "common/scene/water.h"

namespace seam {
namespace {

void ReadMethod(const SceneReader& r, Water* water) {
  const std::string method = r.Text("method", "exact");
  if (method == "voxel") {
    water->method = Buoyancy::kVoxel;
    water->cells = r.Integer("n", {2, 32});
    return;
  }
  if (r.Has("n")) r.FailAt("n", "only method 'voxel' has n");
  if (method == "exact") return;
  if (method != "voxel4") r.FailAt("method", "method must be exact, voxel4 or voxel");
  water->method = Buoyancy::kVoxel;
}

Water ReadWater(const TomlNode& node, const SceneDraft& draft) {
  SceneReader r(node, draft.file, "water",
                {"name", "box", "position", "density", "flow", "viscosity", "drag_normal",
                 "drag_tangent", "method", "n"});
  Water water;
  water.name = r.Name("name");
  r.Rename("water '" + water.name + "'");
  for (const Water& other : draft.scene.waters) {
    if (other.name == water.name) r.FailAt("name", "there is another water of this name");
  }
  const Vec2 size = r.Vector("box", {kSizeMin, kWaterSizeMax});
  const Vec2 centre = r.Vector("position", kCoordinate, Vec2(0, 0));
  water.min = centre - size / 2;
  water.max = centre + size / 2;
  water.density = r.Number("density", kDensity, water.density);
  water.flow = r.Vector("flow", {-kFlowMax, kFlowMax}, water.flow);
  water.viscosity = r.Number("viscosity", {0, 1000}, water.viscosity);
  water.drag_normal = r.Number("drag_normal", {0, 100}, water.drag_normal);
  water.drag_tangent = r.Number("drag_tangent", {0, 100}, water.drag_tangent);
  ReadMethod(r, &water);
  return water;
}

}  // namespace

void ReadWaters(const SceneReader& root, SceneDraft* draft) {
  const Vec2& gravity = draft->scene.gravity;
  for (const TomlNode* node : root.Tables("water")) {
    if (gravity.x() != 0 || gravity.y() > 0) {
      root.FailAt("gravity", "water is level: gravity must be [0, y], y not above 0");
    }
    if (draft->scene.waters.size() == kWatersMax) root.Fail("there are more than 64 [[water]]");
    draft->scene.waters.push_back(ReadWater(*node, *draft));
  }
}

}  // namespace seam
