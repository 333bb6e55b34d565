#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {

Vec2 Repeat::Offset(int column, int row) const {
  const float across = static_cast<float>(column);
  const float up = static_cast<float>(grid ? row : column);
  return Vec2(across * step.x(), up * step.y());
}

std::string Repeat::Suffix(int column, int row) const {
  return "." + std::to_string(column) + (grid ? "." + std::to_string(row) : "");
}

Repeat ReadRepeat(const SceneReader& owner, const std::string& file) {
  Repeat repeat;
  const TomlNode* table = owner.Table("repeat");
  if (table == nullptr) return repeat;
  const SceneReader r(*table, file, owner.what() + ": repeat", {"count", "step", "weld", "glue"});
  const Range count{1, static_cast<double>(kPartsMax)};
  const TomlNode* node = table->Find("count");
  if (node != nullptr && node->kind == TomlNode::Kind::kArray) {
    repeat.grid = true;
    const Vec2 pair = r.Vector("count", count);
    repeat.columns = static_cast<int>(pair.x());
    repeat.rows = static_cast<int>(pair.y());
    if (pair != Vec2(static_cast<float>(repeat.columns), static_cast<float>(repeat.rows))) {
      r.FailAt("count", "count must be integers");
    }
  } else {
    repeat.columns = r.Integer("count", count);
  }
  repeat.step = r.Vector("step", {-1000, 1000});
  if (r.Has("weld") && r.Has("glue")) r.FailAt("glue", "has both weld and glue");
  repeat.joined = r.Has("glue") || r.Flag("weld", false);
  if (r.Has("glue")) {
    repeat.kind = JointKind::kGlue;
    repeat.strength = r.Number("glue", {0, 1e9});
  }
  return repeat;
}

}  // namespace seam
