#pragma once
/// A scene as a recording of one tick, so that it can be drawn without a session.

#include <string>

#include "common/record/recording.h"

namespace seam {

/// True if a file is a scene and not a log: its name ends in ".toml".
bool IsSceneFile(const std::string& path);

/// Makes a recording with the server's view of tick 0. Gives authority over each mechanism to the
/// player that owns it or has the region in which it begins, so that colours show the first
/// authority. Throws OperatorError for an invalid scene.
Recording RecordingOfScene(const std::string& path);

}  // namespace seam
