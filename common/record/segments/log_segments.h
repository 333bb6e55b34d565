#pragma once
/// A long log as a series of files, its segments. The first has the log's name, ROOM.lcm; then come
/// ROOM.s0001.lcm and so on. Each is a log of its own (RoomLog writes them); LogReader reads the
/// series as the one log that it is.

#include <cstdint>
#include <string>
#include <vector>

namespace seam {

/// Ending of the names of logs.
constexpr const char* kLogEnding = ".lcm";

struct LogSegment {
  std::int32_t number = 0;
  std::string path;
};

/// Returns the path of a segment of a log.
std::string SegmentPath(const std::string& log, std::int32_t number);
/// Returns the log that a path of SegmentPath is of.
std::string LogOfSegment(const std::string& path);
/// Returns the segments of a log that there are from a number on, in their order.
std::vector<LogSegment> ListSegments(const std::string& log, std::int32_t from = 0);
/// Returns the log that an operator means: `path`, or the one in the folder `path`. Throws
/// OperatorError if a folder has none or several.
std::string LogNamed(const std::string& path);
/// Waits until the disk has the names in the folder of a file.
void SyncFolderOf(const std::string& path);

}  // namespace seam
