#pragma once
/// Reads a folder without ever throwing: a range-for over a directory_iterator throws when a
/// network file system fails while it is read.

#include <filesystem>
#include <system_error>
#include <vector>

namespace seam {

/// Returns the paths in a folder, in no order. After a failure, `error` is set and they are those
/// that were read before; without a failure it is cleared.
std::vector<std::filesystem::path> ListFolder(const std::filesystem::path& folder,
                                              std::error_code& error);

}  // namespace seam
