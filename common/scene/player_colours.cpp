#include "common/scene/player_colours.h"

#include "common/scene/toml/toml_tree.h"

namespace seam {

std::vector<std::string> PlayerColours(const Scene& scene) {
  std::vector<std::string> colours;
  if (scene.text.empty()) return colours;
  const TomlNode tree = ParseToml(scene.text, scene.name + ".toml");
  const TomlNode* players = tree.Find("player");
  if (players == nullptr) return colours;
  for (const TomlNode& player : players->items) {
    const TomlNode* colour = player.Find("colour");  // it was checked when the scene was read
    if (colour == nullptr) {
      colours.emplace_back();
    } else if (colour->kind == TomlNode::Kind::kText) {
      colours.push_back(colour->text);
    } else {
      colours.push_back(std::to_string(static_cast<int>(colour->number)));
    }
  }
  return colours;
}

}  // namespace seam
