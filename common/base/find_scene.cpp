#include "common/base/find_scene.h"

#include <filesystem>
#include <set>

#include "common/base/check.h"
#include "common/base/files/list_folder.h"
#include "common/base/nearest.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".toml";

bool IsFile(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_directory(status);
}

/// Returns the sorted names of the scenes in SceneFolders(); `all` includes `hard` and `exact`.
std::vector<std::string> Names(bool all) {
  std::set<std::string> names;
  for (const std::string& folder : SceneFolders()) {
    const fs::path name = fs::path(folder).filename();
    if (!all && (name == "hard" || name == "exact")) continue;
    std::error_code error;
    for (const fs::path& path : ListFolder(folder, error)) {
      if (path.extension() == kEnding) names.insert(path.stem().string());
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace

std::vector<std::string> SceneFolders() {
  std::vector<std::string> folders = {"scenes", "scenes/hard", "scenes/exact"};
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return folders;
  const fs::path installed = program.parent_path().parent_path() / "share/seam2d/scenes";
  folders.push_back(installed.string());
  folders.push_back((installed / "hard").string());
  folders.push_back((installed / "exact").string());
  return folders;
}

std::string FindScene(const std::string& word) {
  const bool is_path = word.find('/') != std::string::npos || fs::path(word).extension() == kEnding;
  if (word.empty() || is_path || IsFile(word)) return word;
  std::string looked;
  for (const std::string& folder : SceneFolders()) {
    const std::string path = (fs::path(folder) / (word + kEnding)).string();
    if (IsFile(path)) return path;
    looked += ", " + path;
  }
  throw OperatorError("no scene \"" + word + "\"" + DidYouMean(word, Names(true)) +
                      ": there is no file " + word + looked);
}

std::vector<std::string> SceneNames() { return Names(false); }

}  // namespace seam
