#include "common/base/files/list_folder.h"

namespace seam {

std::vector<std::filesystem::path> ListFolder(const std::filesystem::path& folder,
                                              std::error_code& error) {
  std::vector<std::filesystem::path> paths;
  std::filesystem::directory_iterator entry(folder, error);
  while (!error && entry != std::filesystem::directory_iterator()) {
    paths.push_back(entry->path());
    entry.increment(error);
  }
  return paths;
}

}  // namespace seam
