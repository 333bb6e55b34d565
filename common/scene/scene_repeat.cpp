#include <algorithm>
#include <cctype>

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

Repeat ReadRepeat(const SceneReader& owner, const std::string& file, bool of_players) {
  Repeat repeat;
  const TomlNode* table = owner.Table("repeat");
  if (table == nullptr) return repeat;
  repeat.copies = true;
  const SceneReader r(*table, file, owner.what() + ": repeat", {"count", "step", "weld", "glue"});
  for (const char* key : {"weld", "glue"}) {
    if (of_players && r.Has(key)) r.FailAt(key, "only parts are welded or glued");
  }
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
  if (!of_players || r.Has("step")) repeat.step = r.Vector("step", {-1000, 1000});
  if (r.Has("weld") && r.Has("glue")) r.FailAt("glue", "has both weld and glue");
  repeat.joined = r.Has("glue") || r.Flag("weld", false);
  if (r.Has("glue")) {
    repeat.kind = JointKind::kGlue;
    repeat.strength = r.Number("glue", {0, 1e9});
  }
  return repeat;
}

PartId PartAfter(const SceneReader& r, PartId part, int column, int row, bool grid,
                 const SceneDraft& draft) {
  const std::string& name = draft.scene.parts[static_cast<std::size_t>(part)].name;
  const std::size_t first = name.find('.');
  if (first == std::string::npos) return part;
  if (std::isdigit(static_cast<unsigned char>(name[first + 1])) == 0) return part;  // a character's
  const std::size_t second = name.find('.', first + 1);
  const bool two = second != std::string::npos;
  if (two != grid) r.FailAt("repeat", "repeat: '" + name + "' is not repeated the same way");
  std::string copy =
      name.substr(0, first + 1) + std::to_string(std::stoi(name.substr(first + 1)) + column);
  if (two) copy += "." + std::to_string(std::stoi(name.substr(second + 1)) + row);
  const auto found = draft.part_of_name.find(copy);
  if (found == draft.part_of_name.end()) {
    r.FailAt("repeat", "repeat: there is no part '" + copy + "'");
  }
  return found->second;
}

int PlayerAfter(const SceneReader& r, int player, int column, int row, bool grid,
                const SceneDraft& draft) {
  for (const auto& [name, group] : draft.players_of_name) {
    const Repeat& repeat = group.repeat;
    const int number = player - group.first;
    if (!repeat.copies || player < group.first || number >= repeat.columns * repeat.rows) continue;
    if (repeat.grid != grid) {
      r.FailAt("repeat", "repeat: player '" + name + "' is not repeated the same way");
    }
    const int to_column = number / repeat.rows + column, to_row = number % repeat.rows + row;
    if (to_column >= repeat.columns || to_row >= repeat.rows) {
      r.FailAt("repeat", "repeat: there is no player '" +
                             PlayerCopyName(name, repeat, to_column, to_row) + "'");
    }
    return group.first + to_column * repeat.rows + to_row;
  }
  return player;
}

std::string PlayerCopyName(const std::string& name, const Repeat& repeat, int column, int row) {
  std::string suffix = repeat.Suffix(column, row);
  std::replace(suffix.begin(), suffix.end(), '.', '-');
  return name + suffix;
}

}  // namespace seam
