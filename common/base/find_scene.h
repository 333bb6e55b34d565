#pragma once
/// Scenes by name: `seam-server crossing` from any folder, installed or in the source tree.

#include <string>
#include <vector>

namespace seam {

/// The file that a command line's word means. A path (with '/' or ending in ".toml"), the name of
/// an existing file and "" come back as they are; any other word NAME means the first file
/// NAME.toml in SceneFolders(). Throws OperatorError, one line that says where it looked, when
/// there is none.
std::string FindScene(const std::string& word);

/// Where scenes are looked for by name, in this order: scenes, scenes/hard and scenes/exact of the
/// current folder, then those installed beside the running program, in ../share/seam2d.
std::vector<std::string> SceneFolders();

/// The names that FindScene would find, in order, without those in a folder `hard` or `exact`.
std::vector<std::string> SceneNames();

}  // namespace seam
