#include "server/saved/old_segments.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "common/base/check.h"
#include "common/record/segments/log_segments.h"
#include "server/saved/resumed_room.h"
#include "server/saved/snapshot_file.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// Returns the number of the first segment from which a snapshot goes on; 0 if that is not certain.
std::int32_t FirstNeeded(const std::string& folder, const std::string& room, std::int32_t epoch,
                         std::int32_t last) {
  std::int32_t first = last;
  std::error_code error;
  const std::vector<SnapshotName> files = ListSnapshots(folder, room, &error);
  if (error) return 0;
  for (const SnapshotName& file : files) {
    if (file.epoch != epoch) continue;  // of another log
    RoomSnapshot snapshot;
    if (!ReadSnapshot(file.path, &snapshot).ok()) return 0;
    first = std::min(first, snapshot.log.segment);
  }
  return first;
}

}  // namespace

std::int64_t ParseKeep(const std::string& text) {
  constexpr double kMinuteS = 60, kHourS = 3600, kDayS = 86400, kLongestS = 1e5 * kDayS;
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const double unit_s = unit == "d" ? kDayS : unit == "h" ? kHourS : unit == "m" ? kMinuteS : 0;
  const double keep_s = number * unit_s;
  if (keep_s >= kMinuteS && keep_s <= kLongestS) return static_cast<std::int64_t>(keep_s);
  throw OperatorError("--keep takes days, hours or minutes, such as 7d, 12h or 30m");
}

std::string RemoveOldSegments(const std::string& folder, const std::string& room,
                              std::int32_t epoch, std::int64_t keep_s) {
  std::vector<LogSegment> old = ListSegments(StateLogOf(folder, room, epoch));
  if (old.empty()) return "";
  const std::int32_t last = old.back().number;
  const auto limit = fs::file_time_type::clock::now() - std::chrono::seconds(keep_s);
  std::error_code error;
  const auto young = std::find_if(old.begin(), old.end(), [&](const LogSegment& segment) {
    return fs::last_write_time(segment.path, error) >= limit || error;
  });
  old.erase(young, old.end());
  if (old.empty()) return "";
  const std::int32_t needed = FirstNeeded(folder, room, epoch, last);
  std::string removed;
  int count = 0;
  for (const LogSegment& segment : old) {
    if (segment.number >= needed || !fs::remove(segment.path, error)) break;
    removed = fs::path(segment.path).filename().string();
    ++count;
  }
  if (count == 0) return "";
  SyncFolderOf(old.front().path);
  return "removed " + std::to_string(count) + " segment(s) of its log, up to " + removed +
         " (--keep)";
}

}  // namespace seam
