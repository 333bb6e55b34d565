#include "common/base/nearest.h"
#include "common/scene/scene_draft.h"
#include "common/scene/toml/scene_text.h"

namespace seam {
namespace {

/// Returns "there is no part 'chasis' (did you mean 'chassis'?)".
std::string NoPart(const std::string& name, const SceneDraft& draft) {
  std::vector<std::string> known;
  for (const auto& [group, parts] : draft.group_of_name) known.push_back(group);
  for (const auto& [part, id] : draft.part_of_name) known.push_back(part);
  return "there is no part '" + Printable(name) + "'" + DidYouMean(name, known);
}

std::string NoPlayer(const std::string& name, const SceneDraft& draft) {
  std::vector<std::string> known;
  for (const Player& player : draft.scene.players) known.push_back(player.name);
  return "there is no player '" + Printable(name) + "'" + DidYouMean(name, known);
}

}  // namespace

std::vector<PartId> FindParts(const SceneReader& reader, const char* key, const std::string& name,
                              const SceneDraft& draft) {
  const auto part = draft.part_of_name.find(name);
  if (part != draft.part_of_name.end()) return {part->second};
  const bool all = name.size() > 2 && name.compare(name.size() - 2, 2, ".*") == 0;
  const auto group = draft.group_of_name.find(all ? name.substr(0, name.size() - 2) : name);
  if (group == draft.group_of_name.end()) {
    reader.FailAt(key, std::string(key) + ": " + NoPart(name, draft));
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
  const auto group = draft.players_of_name.find(name);
  if (group != draft.players_of_name.end() && group->second.repeat.copies) {
    reader.FailAt(key, std::string(key) + ": player '" + name + "' is repeated: say '" +
                           draft.scene.players[static_cast<std::size_t>(group->second.first)].name +
                           "' for one of them");
  }
  reader.FailAt(key, std::string(key) + ": " + NoPlayer(name, draft));
}

std::vector<int> FindPlayers(const SceneReader& reader, const char* key, const SceneDraft& draft) {
  std::vector<int> players;
  for (const std::string& name : reader.Texts(key)) {
    const bool all = name.size() > 2 && name.compare(name.size() - 2, 2, "-*") == 0;
    if (!all) {
      players.push_back(FindPlayer(reader, key, name, draft));
      continue;
    }
    const auto group = draft.players_of_name.find(name.substr(0, name.size() - 2));
    if (group == draft.players_of_name.end() || !group->second.repeat.copies) {
      reader.FailAt(key, std::string(key) + ": no player is repeated as '" + Printable(name) + "'");
    }
    const Repeat& repeat = group->second.repeat;
    for (int i = 0; i < repeat.columns * repeat.rows; ++i) {
      players.push_back(group->second.first + i);
    }
  }
  return players;
}

}  // namespace seam
