#pragma once
/// Files named by an operator: regular files only. A FIFO blocks for ever, a device has no end or
/// swallows everything, folders and sockets are no files. Each is refused with one line.

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace seam {

/// The purpose for which a file is opened.
enum class FileUse {
  kRead,
  kReplace,  ///< created, or emptied if it exists
  kCreate,   ///< created; refused if it exists
  kAppend,   ///< created if it does not exist
  kGoOn,     ///< to be written from a place on; created if it does not exist
};

/// Throws OperatorError "PATH: is a FIFO, not a regular file" if `path` exists but is no regular
/// file. Does not open it. A path that does not exist or cannot be queried passes.
void RequirePlainFile(const std::string& path);

/// Checks the name of an output before anything is computed. Throws OperatorError "PATH: is read,
/// it cannot be written" if `path` names one of the files `read`, "PATH: exists (--force replaces
/// it)" if it exists and `force` is false, or like RequirePlainFile.
void RequireOutput(const std::string& path, bool force, const std::vector<std::string>& read);

/// Opens a regular file without ever blocking; the caller closes it. Returns nullptr with errno set
/// on failure. Throws OperatorError like RequirePlainFile if it is no regular file.
std::FILE* OpenPlainFile(const std::string& path, FileUse use);

/// Most bytes read of a table or page, normal 1 MB; a longer one is cut off.
constexpr std::size_t kTableBytesMax = 1 << 30;

/// Returns the first `bytes_max` bytes of a regular file. Throws OperatorError "PATH: cannot be
/// read: ...", or "PATH: `absent`" if there is no such file and `absent` is not null.
std::string ReadPlainFile(const std::string& path, std::size_t bytes_max,
                          const char* absent = nullptr);

}  // namespace seam
