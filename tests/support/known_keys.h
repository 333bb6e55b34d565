#pragma once
/// The keys that the scene loader knows, taken from its error messages.

#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// Returns the known keys of the last table in `scene`, from the loader's error about an unknown
/// key. Empty if the loader reports another error first.
inline std::vector<std::string> KnownKeys(const std::string& scene) {
  std::vector<std::string> keys;
  try {
    ParseScene(scene + "\nzzzzzzzzzzzzzzzz = 1\n", "s.toml");
  } catch (const std::exception& e) {
    const std::string what = e.what(), begin = "known are ";
    const auto at = what.find(begin);
    if (at == std::string::npos) return keys;
    std::istringstream in(what.substr(at + begin.size(), what.size() - at - begin.size() - 1));
    for (std::string key; in >> key;) keys.push_back(key);
  }
  return keys;
}

}  // namespace seam
