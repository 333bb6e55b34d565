#pragma once
/// Game rules of a scene that only the server evaluates: scripts, triggers, health, score,
/// permissions. They are no part of the physics.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/scene/player_mask.h"
#include "common/scene/types.h"

namespace seam {

struct Scene;

/// True if the server has rules to evaluate: triggers, scripts, charges or health.
bool NeedsRules(const Scene& scene);

/// Resource limits of one script.
struct ScriptLimits {
  std::int64_t instructions = 200000;  ///< in a tick; other work is converted to instructions
  std::int64_t memory_bytes = 4 << 20;
};

/// A Lua 5.4 program, run by the server. docs/scripts.md is its reference.
struct ScriptSource {
  std::string name;  ///< unique
  std::string code;
  int line = 1;  ///< line of the scene file on which the code begins
  ScriptLimits limits;
};

/// A part's score, health and permissions.
struct PartRules {
  float health = 0;                 ///< at the start; 0: invulnerable
  float hurt_above = 5;             ///< m/s: an impact that changes its velocity by more hurts
  float damage_factor = 10;         ///< health lost for each m/s above that
  float score = 0;                  ///< points for the driver of the vehicle that destroys it
  PlayerMask drive = kEveryPlayer;  ///< players with axes that may turn motors on it
  PlayerMask push = kEveryPlayer;   ///< players that may push it by actions, and may own it
  PlayerMask take = kEveryPlayer;   ///< players that may take it, if it is a pickup
};

enum class TriggerKind { kArea, kCheckpoint, kPickup, kHazard };

/// A box that reacts to parts. A part is inside when its position is.
struct Trigger {
  std::string name;  ///< unique
  TriggerKind kind = TriggerKind::kArea;
  Vec2 position{0, 0};                ///< m, of its centre; relative to `part`, if given
  Vec2 size{1, 1};                    ///< m, full width and height, along the world's axes
  PartId part = -1;                   ///< moves with it (without turning), ends with it; -1: fixed
  std::vector<PartId> parts;          ///< parts that it reacts to
  PlayerMask players = kEveryPlayer;  ///< owners of the parts; all: parts without owner too
  bool once = false;                  ///< ends with the first part that enters (always for pickups)
  int order = 0;                      ///< kCheckpoint: from 1
  float score = 0;                    ///< points for the player of the entering part
  float health = 0;                   ///< kPickup: gained at once; kHazard: lost per second
  int line = 0;                       ///< line in the scene file
};

}  // namespace seam
