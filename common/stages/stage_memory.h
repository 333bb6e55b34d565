#pragma once
/// Memory that several stages save in the same format, as the numbers of Stage::Save and Load.

#include <map>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// Saves ticks by part: their number, then part and ticks of each.
inline void SaveTicks(const std::map<PartId, int>& ticks, std::vector<float>* memory) {
  memory->push_back(static_cast<float>(ticks.size()));
  for (const auto& [part, count] : ticks) {
    memory->push_back(static_cast<float>(part));
    memory->push_back(static_cast<float>(count));
  }
}

/// Returns the number of values read.
inline std::size_t LoadTicks(const float* memory, std::map<PartId, int>* ticks) {
  const auto size = static_cast<std::size_t>(memory[0]);
  ticks->clear();
  for (std::size_t i = 0; i < size; ++i) {
    (*ticks)[static_cast<PartId>(memory[1 + 2 * i])] = static_cast<int>(memory[2 + 2 * i]);
  }
  return 1 + 2 * size;
}

}  // namespace seam
