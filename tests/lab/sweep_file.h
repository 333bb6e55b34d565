#pragma once
/// What a sweep file says, checked: the list of each thing that varies.

#include <cstdint>
#include <string>
#include <vector>

namespace seam {

struct SweepFile {
  std::vector<std::string> scenes;  ///< paths
  /// What is set in the scenes, every combination: {"solver.substeps=2", "buffer=5"}. At least one,
  /// which may be empty.
  std::vector<std::vector<std::string>> settings;
  std::vector<std::string> methods;   ///< "strict", "buffer/fade", "central/own"
  std::vector<std::string> networks;  ///< every combination, as FindProfile reads them
  std::vector<std::int64_t> send_hz, seeds;
  std::vector<std::string> drive, smooth;
  double duration_s = 0;  ///< 0: each scene's own
  bool floor = true;
  bool limit = false;
};

/// Throws OperatorError "file:line: ..." for what is wrong with the file by itself; scenes are not
/// read, methods and networks not looked up.
SweepFile ReadSweepFile(const std::string& path);

}  // namespace seam
