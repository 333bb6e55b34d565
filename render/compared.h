#pragma once
/// Runs that are compared in one picture or page.

#include <string>
#include <vector>

#include "render/playback/playback.h"

namespace seam {

/// Requires that the logs are of one scene: bodies are compared by their numbers. Pictures of scene
/// files may be of several. Throws OperatorError.
void RequireOneScene(const std::vector<std::string>& paths,
                     const std::vector<const Playback*>& runs);
/// Returns the words that tell runs of one method apart, for each run: its network and seed if
/// they differ, else its file; "" for a run of another method.
std::vector<std::string> ApartOf(const std::vector<std::string>& paths,
                                 const std::vector<const Playback*>& runs);

}  // namespace seam
