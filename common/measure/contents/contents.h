#pragma once
/// What is in a recording, for people who want to know before they draw or measure it.

#include <string>

#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// A line that begins with `name`, and below it, indented: method and network, players, views,
/// bodies, messages, damage, and the events, of many the first 20. Texts of the recording are shown
/// without what a terminal obeys. Ends with a line end.
std::string FormatContents(const std::string& name, const Recording& recording);

/// "server", the name of the player whose place it is, or "peer 7" for a spectator.
std::string ViewNameOf(const Scene& scene, int peer);

}  // namespace seam
