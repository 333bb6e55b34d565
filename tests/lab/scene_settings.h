#pragma once
/// Numbers of a scene set from outside, in its text: so that a recording carries what was really
/// simulated, and its oracle is computed from that.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// "solver.substeps=2; buffer=5" as {"solver.substeps=2", "buffer=5"}. Throws OperatorError for
/// what is not KEY=VALUE, where KEY is one of the scene's own or one of a table of it, and VALUE a
/// TOML value; and for a key that is set twice.
std::vector<std::string> SplitSettings(const std::string& text);

/// The inverse: with ';' between them.
std::string JoinSettings(const std::vector<std::string>& settings);

/// The scene file's text with those settings: the line of each key is replaced, or one is added.
/// Throws OperatorError when the text has the key in a revision that cannot be replaced.
std::string WithSettings(const std::string& text, const std::vector<std::string>& settings,
                         const std::string& file);

/// Reads the scene with those settings. Throws OperatorError.
Scene LoadSceneWith(const std::string& path, const std::vector<std::string>& settings);

}  // namespace seam
