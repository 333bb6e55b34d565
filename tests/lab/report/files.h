#pragma once
/// The files of a folder.

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace seam {

/// Files of the folder with this extension (".csv"), by name. `error` says what was wrong with the
/// folder, if anything: then there may be less than all.
std::vector<std::filesystem::path> FilesIn(const std::filesystem::path& folder,
                                           const std::string& extension, std::error_code* error);

}  // namespace seam
