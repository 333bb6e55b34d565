#pragma once
/// `seam edit`: checks a scene, its Lua too, each time it is saved, and plays it anew if asked.

#include <string>

#include "client/front/play.h"

namespace seam {

struct EditOptions {
  std::string scene;  ///< file, or name of a scene
  bool play = false;  ///< plays the scene from the start after each save that loads
  PlayOptions room;   ///< of that; its scene is not used
};

/// Runs until Ctrl-C. Returns the exit status: 1 if the script of the last room was stopped. Throws
/// OperatorError when there is no such scene, or its folder cannot be watched.
int EditScene(const EditOptions& options);

}  // namespace seam
