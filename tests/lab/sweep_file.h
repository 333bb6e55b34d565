#pragma once
/// The checked content of a sweep file: the list of values of each parameter.

#include <cstdint>
#include <string>
#include <vector>

namespace seam {

struct SweepFile {
  std::vector<std::string> scenes;  ///< paths
  /// Settings of the scenes, every combination: {"solver.substeps=2", "buffer=5"}. At least one
  /// entry, which may be empty.
  std::vector<std::vector<std::string>> settings;
  std::vector<std::string> methods;   ///< "strict", "buffer/fade", "central/own"
  std::vector<std::string> networks;  ///< every combination, as FindProfile reads them
  std::vector<std::int64_t> send_hz, seeds;
  std::vector<std::string> drive, smooth;
  double duration_s = 0;  ///< 0: each scene's own
  int show_age = -1;      ///< ticks, of others' bodies; -1: each scene's own
  bool floor = true;
  bool limit = false;
};

/// Throws OperatorError "file:line: ..." for mistakes in the file by itself; scenes are not read,
/// methods and networks not looked up.
SweepFile ReadSweepFile(const std::string& path);

}  // namespace seam
