#include "common/base/files_read.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>

namespace seam {
namespace {

/// Most names; a service may read files for ever.
constexpr std::size_t kFilesReadMax = 4096;

struct FilesRead {
  std::mutex mutex;
  std::set<std::string> names;
};

FilesRead& Noted() {
  static FilesRead noted;
  return noted;
}

}  // namespace

void NoteFileRead(const std::string& path) {
  FilesRead& noted = Noted();
  const std::lock_guard<std::mutex> lock(noted.mutex);
  if (noted.names.size() < kFilesReadMax) noted.names.insert(path);
}

bool WasFileRead(const std::string& path) {
  FilesRead& noted = Noted();
  const std::lock_guard<std::mutex> lock(noted.mutex);
  return std::any_of(noted.names.begin(), noted.names.end(), [&](const std::string& name) {
    std::error_code unknown;  // a file that is not there is not the same
    return std::filesystem::equivalent(path, name, unknown);
  });
}

}  // namespace seam
