#pragma once
/// Abilities of characters. Each is a trial from one of many starts: a world with one character,
/// its player's inputs, and a score.

#include <string>
#include <vector>

#include "common/stages/character/character_gains.h"

namespace seam {

struct GaitTrial {
  double cost = 0;    ///< 0 is perfect, 1 about a fall: what a search makes small
  bool good = false;  ///< by the bar of the ability (docs/lab.md)
  double figure = 0;  ///< in the ability's unit
  std::string group;  ///< row of a table
};

struct GaitSetup {
  std::string solver;     ///< lines of [solver]
  std::string character;  ///< more lines of [[character]]
};

struct Ability {
  std::string name;
  std::string figure;  ///< "m/s"
  /// Deterministic: by its arguments alone. Starts are numbered from 1.
  GaitTrial (*run)(const GaitSetup& setup, const CharacterGains& gains, int start);
};

const std::vector<Ability>& Abilities();
/// nullptr if there is none of this name.
const Ability* FindAbility(const std::string& name);

// One file each.
GaitTrial TryJump(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TrySwim(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryFloat(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryPlunge(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryRise(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryStairs(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryDescent(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TrySlope(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryShove(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryWalk(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryLimp(const GaitSetup& setup, const CharacterGains& gains, int start);
GaitTrial TryClimb(const GaitSetup& setup, const CharacterGains& gains, int start);

}  // namespace seam
