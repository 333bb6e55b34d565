#pragma once
/// Sets numbers of a scene from outside, in its text: so a recording carries the scene as it was
/// simulated, and its oracle is computed from that.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// "solver.substeps=2; buffer=5" as {"solver.substeps=2", "buffer=5"}. Throws OperatorError for
/// what is not KEY=VALUE, where KEY is one of the scene's own or one of a table of it, and VALUE a
/// TOML value; and for a key that is set twice.
std::vector<std::string> SplitSettings(const std::string& text);

/// Joins the settings with ';' between them: the inverse.
std::string JoinSettings(const std::vector<std::string>& settings);

/// Returns the scene's text with those settings: replaces the line of each key, or adds one.
/// Throws OperatorError when the text has the key in a revision that cannot be replaced.
std::string WithSettings(const std::string& text, const std::vector<std::string>& settings,
                         const std::string& file);

/// Reads the scene with those settings. Throws OperatorError.
Scene LoadSceneWith(const std::string& path, const std::vector<std::string>& settings);

}  // namespace seam
