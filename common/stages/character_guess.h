#pragma once
/// Guesses at a character's controller by whoever knows its poses alone. A controller changes its
/// mode where a value passes a bound, and gets up by a clock that begins there; poses that are
/// rounded by the wire may pass that bound in another tick.

#include <cstddef>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// The numbers of one controller among those of all stages (WorldSnapshot::stages).
struct CharacterNumbers {
  std::size_t first = 0, count = 0;  ///< count 0: the character has no controller
};
/// `all`: how many numbers the stages have together.
CharacterNumbers NumbersOf(const Scene& scene, int character, std::size_t all);

struct CharacterGuess {
  std::vector<float> memory;  ///< numbers of its controller
  bool sides = false;         ///< its left limbs are where those on its right are told to be
};

/// Returns states that a character may be in at the poses of this one, the likeliest first: it uses
/// the other foot; or if it lies it does as supposed, only by another tick; lies on, begins to get
/// up, is at the next stage of that or at the beginning of this one, or is up. Empty for numbers of
/// no controller.
std::vector<CharacterGuess> OtherStates(const std::vector<float>& memory);
/// Returns the numbers after a time in the same mode, s.
std::vector<float> LaterInMode(const std::vector<float>& memory, float seconds);

}  // namespace seam
