#pragma once
/// What the server alone decides in a room, as a scene says it: scripts, triggers, health, score,
/// permissions. Physics knows nothing of it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/physics/types.h"

namespace seam {

/// What one script may use up.
struct ScriptLimits {
  std::int64_t instructions = 200000;  ///< in a tick; other work is charged as instructions
  std::int64_t memory_bytes = 4 << 20;
};

/// A program in Lua 5.4, run by the server. docs/scripts.md is its reference.
struct ScriptSource {
  std::string name;                 ///< unique
  std::string code;
  int line = 1;                     ///< of the scene file, on which the code begins
  ScriptLimits limits;
};

}  // namespace seam
