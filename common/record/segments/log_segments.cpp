#include "common/record/segments/log_segments.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "common/base/check.h"
#include "common/base/files/list_folder.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// Stands in a file's name before the segment's number, of at least four digits.
constexpr const char* kSegmentMark = ".s";

bool EndsAsLog(const std::string& path) {
  const std::string ending = kLogEnding;
  return path.size() > ending.size() &&
         path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

/// Returns the path without the ending of logs.
std::string StemOfLog(const std::string& path) {
  return EndsAsLog(path) ? path.substr(0, path.size() - std::string(kLogEnding).size()) : path;
}

/// Returns the number at the end of a segment's path; 0: it is of no later segment.
std::int32_t NumberOf(const std::string& path) {
  const std::string stem = StemOfLog(path), mark = kSegmentMark;
  const std::size_t at = stem.rfind(mark);
  if (at == std::string::npos || !EndsAsLog(path)) return 0;
  const std::string digits = stem.substr(at + mark.size());
  const bool number = digits.size() >= 4 && digits.size() <= 9 &&
                      digits.find_first_not_of("0123456789") == std::string::npos;
  return number ? std::atoi(digits.c_str()) : 0;
}

fs::path FolderOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

}  // namespace

std::string SegmentPath(const std::string& log, std::int32_t number) {
  if (number == 0) return log;
  char digits[16];
  std::snprintf(digits, sizeof digits, "%04d", number);
  return StemOfLog(log) + kSegmentMark + digits + kLogEnding;
}

std::string LogOfSegment(const std::string& path) {
  if (NumberOf(path) == 0) return path;
  const std::string stem = StemOfLog(path);
  return stem.substr(0, stem.rfind(kSegmentMark)) + kLogEnding;
}

std::vector<LogSegment> ListSegments(const std::string& log, std::int32_t from) {
  std::vector<LogSegment> all;
  std::error_code error;
  if (from == 0 && fs::exists(log, error)) all.push_back({0, log});
  for (const fs::path& entry : ListFolder(FolderOf(log), error)) {
    const std::int32_t number = NumberOf(entry.filename().string());
    const std::string path = SegmentPath(log, number);
    const bool ours = number > 0 && fs::path(path).filename() == entry.filename();
    if (ours && number >= from && fs::is_regular_file(entry, error)) all.push_back({number, path});
  }
  std::sort(all.begin(), all.end(),
            [](const LogSegment& a, const LogSegment& b) { return a.number < b.number; });
  return all;
}

std::string LogNamed(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  std::set<std::string> logs;
  for (const fs::path& entry : ListFolder(path, error)) {
    if (EndsAsLog(entry.string())) logs.insert(LogOfSegment(entry.string()));
  }
  if (error) throw OperatorError(path + ": cannot be read: " + error.message());
  if (logs.empty()) throw OperatorError(path + ": no log in this folder");
  if (logs.size() == 1) return *logs.begin();
  std::string names;
  for (const std::string& log : logs) {
    names += (names.empty() ? "" : ", ") + fs::path(log).filename().string();
  }
  throw OperatorError(path + ": has several logs, name one: " + names);
}

void SyncFolderOf(const std::string& path) {
  const int fd = open(FolderOf(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  fsync(fd);
  close(fd);
}

}  // namespace seam
