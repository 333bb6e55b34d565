#include "common/stages/character_guess.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/physics/stage.h"
#include "common/stages/character/character_control.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

/// Longer than any stage of a mode, s: the next one begins.
constexpr float kLong = 60;

CharacterMemory Read(const std::vector<float>& memory) {
  CharacterMemory read;
  StageMemory numbers(memory);
  read.Load(&numbers);
  return read;
}

CharacterMemory In(CharacterMemory memory, CharacterMode mode) {
  memory.mode = mode;
  memory.time = memory.phase_time = 0;
  memory.phase = 0;
  return memory;
}

/// In other modes, at the same poses.
std::vector<CharacterMemory> OtherModes(const CharacterMemory& now) {
  CharacterMemory rises = In(now, CharacterMode::kFall);
  rises.time = kLong;  // its controller chooses the way up by how it lies
  CharacterMemory next = now, again = now, up = now;
  next.phase_time = kLong;
  again.phase_time = up.phase_time = 0;
  up.phase = kPhaseMost;
  switch (now.mode) {
    case CharacterMode::kFall: return {rises, In(now, CharacterMode::kStand)};
    case CharacterMode::kRise:
      if (now.phase == kPhaseMost) {
        return {In(now, CharacterMode::kFall), In(now, CharacterMode::kStand)};
      }
      return {In(now, CharacterMode::kFall), next, again, up};
    default: return {};
  }
}

/// Who lies does the same with both sides.
bool Lies(CharacterMode mode) {
  return mode == CharacterMode::kFall || mode == CharacterMode::kRise;
}

}  // namespace

/// Only the stages of seats come after those of characters (MakeStages).
CharacterNumbers NumbersOf(const Scene& scene, int character, std::size_t all) {
  CharacterNumbers numbers;
  if (!scene.characters[static_cast<std::size_t>(character)].active) return numbers;
  std::vector<float> of_one;
  CharacterMemory().Save(&of_one);
  numbers.count = of_one.size();
  const auto from = scene.characters.begin() + character;
  const auto on =
      std::count_if(from, scene.characters.end(), [](const Character& one) { return one.active; });
  const std::size_t behind =
      numbers.count * static_cast<std::size_t>(on) + kNumbersOfSeat * scene.seats.size();
  SEAM_ASSERT(all >= behind);
  numbers.first = all - behind;
  return numbers;
}

std::vector<CharacterGuess> OtherStates(const std::vector<float>& memory) {
  std::vector<CharacterGuess> all;
  if (memory.empty()) return all;
  const CharacterMemory now = Read(memory);
  // At a change of modes a tick more or less makes a difference, for that tick.
  all.push_back({memory, !Lies(now.mode)});
  for (const CharacterMemory& other : OtherModes(now)) other.Save(&all.emplace_back().memory);
  return all;
}

std::vector<float> LaterInMode(const std::vector<float>& memory, float seconds) {
  CharacterMemory later = Read(memory);
  later.time += seconds;
  if (later.mode == CharacterMode::kStep) later.step += seconds;
  if (later.mode == CharacterMode::kRise) later.phase_time += seconds;
  std::vector<float> numbers;
  later.Save(&numbers);
  return numbers;
}

}  // namespace seam
