#include "common/scene/player_colours.h"

#include "common/scene/toml/toml_tree.h"

namespace seam {
namespace {

/// Returns the number of players that a [[player]] makes. Requires a valid scene.
std::size_t CopiesOf(const TomlNode& player) {
  const TomlNode* repeat = player.Find("repeat");
  const TomlNode* count = repeat == nullptr ? nullptr : repeat->Find("count");
  if (count == nullptr) return 1;
  double copies = count->number;
  if (count->kind == TomlNode::Kind::kArray)
    copies = count->items[0].number * count->items[1].number;
  return static_cast<std::size_t>(copies);
}

}  // namespace

std::vector<std::string> PlayerColours(const Scene& scene) {
  std::vector<std::string> colours;
  if (scene.text.empty()) return colours;
  const TomlNode tree = ParseToml(scene.text, scene.name + ".toml");
  const TomlNode* players = tree.Find("player");
  if (players == nullptr) return colours;
  for (const TomlNode& player : players->items) {
    const TomlNode* colour = player.Find("colour");  // checked when the scene was read
    std::string text;
    if (colour != nullptr) {
      text = colour->kind == TomlNode::Kind::kText
                 ? colour->text
                 : std::to_string(static_cast<int>(colour->number));
    }
    colours.insert(colours.end(), CopiesOf(player), text);
  }
  return colours;
}

}  // namespace seam
