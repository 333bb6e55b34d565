#pragma once
/// Files that are named by an operator: regular files only. A FIFO waits for ever, a device has no
/// end or takes everything, a folder and a socket are no files: each is refused in one line.

#include <cstddef>
#include <cstdio>
#include <string>

namespace seam {

/// What a file is opened for.
enum class FileUse {
  kRead,
  kReplace,  ///< made, or emptied if it is there
  kCreate,   ///< made; refused if it is there
  kAppend,   ///< made if it is not there
};

/// Throws OperatorError "PATH: is a FIFO, not a regular file" if there is something at `path` that
/// is no regular file. Does not open it. What is not there, or cannot be asked, passes.
void RequirePlainFile(const std::string& path);

/// Opens a regular file; never waits. nullptr, with errno set, when that is not possible; throws
/// OperatorError, as RequirePlainFile, for what is no regular file. The caller closes it.
std::FILE* OpenPlainFile(const std::string& path, FileUse use);

/// Most that is read of a table or page, normal 1 MB; what is longer comes out cut.
constexpr std::size_t kTableBytesMax = 1 << 30;

/// The first `bytes_max` bytes of a regular file. Throws OperatorError "PATH: cannot be read: ...",
/// with "`absent`" instead of the reason if there is no such file and `absent` is not null.
std::string ReadPlainFile(const std::string& path, std::size_t bytes_max,
                          const char* absent = nullptr);

}  // namespace seam
