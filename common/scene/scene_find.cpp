#include "common/scene/scene_draft.h"
#include "common/scene/toml/scene_text.h"

namespace seam {

std::vector<PartId> FindParts(const SceneReader& reader, const char* key, const std::string& name,
                              const SceneDraft& draft) {
  const auto part = draft.part_of_name.find(name);
  if (part != draft.part_of_name.end()) return {part->second};
  const bool all = name.size() > 2 && name.compare(name.size() - 2, 2, ".*") == 0;
  const auto group = draft.group_of_name.find(all ? name.substr(0, name.size() - 2) : name);
  if (group == draft.group_of_name.end()) {
    reader.FailAt(key, std::string(key) + ": there is no part '" + Printable(name) + "'");
  }
  if (!all) {
    const std::string first = draft.scene.parts[static_cast<std::size_t>(group->second[0])].name;
    reader.FailAt(key, std::string(key) + ": '" + name + "' is repeated: say '" + first +
                           "' for one of them or '" + name + ".*' for all");
  }
  return group->second;
}

PartId FindPart(const SceneReader& reader, const char* key, const SceneDraft& draft) {
  const std::vector<PartId> found = FindParts(reader, key, reader.Text(key), draft);
  if (found.size() != 1) reader.FailAt(key, std::string(key) + " must be one part");
  return found[0];
}

int FindPlayer(const SceneReader& reader, const char* key, const std::string& name,
               const SceneDraft& draft) {
  for (std::size_t p = 0; p < draft.scene.players.size(); ++p) {
    if (draft.scene.players[p].name == name) return static_cast<int>(p);
  }
  reader.FailAt(key, std::string(key) + ": there is no player '" + Printable(name) + "'");
}

}  // namespace seam
