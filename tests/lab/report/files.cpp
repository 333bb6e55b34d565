#include "tests/lab/report/files.h"

#include <algorithm>

namespace seam {

namespace fs = std::filesystem;

std::vector<fs::path> FilesIn(const fs::path& folder, const std::string& extension,
                              std::error_code* error) {
  std::vector<fs::path> files;
  for (fs::directory_iterator i(folder, *error), end; !*error && i != end; i.increment(*error)) {
    if (i->path().extension() == extension) files.push_back(i->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace seam
