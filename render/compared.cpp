#include "render/compared.h"

#include <algorithm>
#include <filesystem>

#include "common/base/check.h"
#include "render/scene_recording.h"

namespace seam {
namespace {

bool SameParts(const Scene& a, const Scene& b) {
  return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                    [](const Part& x, const Part& y) { return x.name == y.name; });
}

}  // namespace

void RequireOneScene(const std::vector<std::string>& paths,
                     const std::vector<const Playback*>& runs) {
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (IsSceneFile(paths[0]) || IsSceneFile(paths[i])) continue;
    if (SameParts(runs[0]->scene(), runs[i]->scene())) continue;
    throw OperatorError(paths[i] + ": its scene (" + runs[i]->recording().room.scene_name +
                        ") has other parts than that of " + paths[0] + " (" +
                        runs[0]->recording().room.scene_name +
                        "): only runs of one scene are compared");
  }
}

std::vector<std::string> ApartOf(const std::vector<std::string>& paths,
                                 const std::vector<const Playback*>& runs) {
  std::vector<std::string> words;
  for (const Playback* run : runs) {
    std::vector<const Room*> like;
    std::string text;
    for (const Playback* other : runs) {
      if (other->Method() == run->Method()) like.push_back(&other->recording().room);
    }
    const Room& room = run->recording().room;
    const auto differs = [&](auto field) {
      return std::any_of(like.begin(), like.end(),
                         [&](const Room* other) { return other->*field != room.*field; });
    };
    if (differs(&Room::impair)) text = room.impair;
    if (differs(&Room::seed))
      text += (text.empty() ? "" : ", ") + ("seed " + std::to_string(room.seed));
    words.push_back(text);
  }
  const std::vector<std::string> found = words;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (i == k || runs[i]->Method() != runs[k]->Method() || found[i] != found[k]) continue;
      words[i] = std::filesystem::path(paths[i]).stem().string();
    }
  }
  return words;
}

}  // namespace seam
