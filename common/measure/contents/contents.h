#pragma once
/// Summary of a recording's contents, to be read before drawing or measuring it.

#include <string>

#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// Formats a line that begins with `name`, and below it, indented: method and network, players,
/// views, bodies, messages, damage, and the first 20 events. Characters of the recording's texts
/// that a terminal might obey are replaced. Ends with a line end.
std::string FormatContents(const std::string& name, const Recording& recording);

/// Returns "server", the name of the peer's player, or "peer 7" for a spectator.
std::string ViewNameOf(const Scene& scene, int peer);

}  // namespace seam
