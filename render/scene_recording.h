#pragma once
/// A scene as a recording of one tick, so that it can be drawn without a session.

#include <string>

#include "common/record/recording.h"

namespace seam {

/// Whether a file that is to be drawn is a scene and no log: its name ends in ".toml".
bool IsSceneFile(const std::string& path);

/// The server's view of tick 0. Each mechanism is in the hands of the player who owns it or in
/// whose region it begins, so that colours say whose it will be. Throws OperatorError for a scene
/// that is none.
Recording RecordingOfScene(const std::string& path);

}  // namespace seam
