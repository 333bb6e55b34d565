#pragma once
/// Memory that several stages save in the same format, as the numbers of Stage::Save and Load.

#include <map>
#include <vector>

#include "common/physics/stage.h"
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

inline void LoadTicks(StageMemory* memory, std::map<PartId, int>* ticks) {
  ticks->clear();
  for (std::size_t left = memory->NextCount(2); left > 0; --left) {
    const PartId part = memory->NextInt(0, kStageNumberMax);
    (*ticks)[part] = memory->NextInt(0, kStageNumberMax);
  }
}

}  // namespace seam
