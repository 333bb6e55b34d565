#pragma once
/// What the server alone decides in a room, as a scene says it: scripts, triggers, health, score,
/// permissions. Physics knows nothing of it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/scene/player_mask.h"
#include "common/scene/types.h"

namespace seam {

/// What one script may use up.
struct ScriptLimits {
  std::int64_t instructions = 200000;  ///< in a tick; other work is charged as instructions
  std::int64_t memory_bytes = 4 << 20;
};

/// A program in Lua 5.4, run by the server. docs/scripts.md is its reference.
struct ScriptSource {
  std::string name;  ///< unique
  std::string code;
  int line = 1;  ///< of the scene file, on which the code begins
  ScriptLimits limits;
};

/// A part's score, health and permissions.
struct PartRules {
  float health = 0;                 ///< at the start; 0: nothing hurts it
  float hurt_above = 5;             ///< m/s: a blow that changes its velocity by more hurts
  float hurt_factor = 10;           ///< health lost for each m/s above
  float score = 0;                  ///< points for the player whose vehicle destroys it
  PlayerMask drive = kEveryPlayer;  ///< whose axes may turn motors on it
  PlayerMask push = kEveryPlayer;   ///< whose actions may push it, and who may have its authority
  PlayerMask take = kEveryPlayer;   ///< who may take it, if it is a pickup
};

enum class TriggerKind { kArea, kCheckpoint, kPickup, kHazard };

/// A box in which something happens to parts. A part is in it when its position is.
struct Trigger {
  std::string name;  ///< unique
  TriggerKind kind = TriggerKind::kArea;
  Vec2 position{0, 0};                ///< m, of its centre; from `part`, if there is one
  Vec2 size{1, 1};                    ///< m, full width and height, along the world's axes
  PartId part = -1;                   ///< moves with it (without turning), ends with it; -1: stays
  std::vector<PartId> parts;          ///< the parts that it looks for
  PlayerMask players = kEveryPlayer;  ///< whose parts; all: nobody's too
  bool once = false;                  ///< ends with the first part that enters (a pickup always)
  int order = 0;                      ///< kCheckpoint: from 1
  float score = 0;                    ///< points for the player of who enters
  float health = 0;                   ///< kPickup: given at once; kHazard: taken in a second
  int line = 0;                       ///< in the scene file
};

}  // namespace seam
