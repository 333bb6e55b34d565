#pragma once
/// Plain types in saved state.

#include "common/base/state_archive.h"
#include "common/scene/types.h"

namespace seam {

/// Limits of a saved body: m, m/s and rad/s, rad. The engine does not reach them in a room's life.
constexpr float kSavedPlaceMost = 1e6f, kSavedSpeedMost = 1e5f, kSavedAngleMost = 1e8f;

inline void Persist(StateArchive& a, Vec2* v, float most) {
  a.Real(&(*v)[0], most);
  a.Real(&(*v)[1], most);
}

inline void Persist(StateArchive& a, BodyState* state) {
  Persist(a, &state->position, kSavedPlaceMost);
  a.Real(&state->angle, kSavedAngleMost);
  Persist(a, &state->velocity, kSavedSpeedMost);
  a.Real(&state->spin, kSavedSpeedMost);
}

inline void Persist(StateArchive& a, Input* input) {
  a.Int(&input->drive, -128, 127);
  a.Int(&input->lift, -128, 127);
  a.Int(&input->buttons, -32768, 32767);
}

/// A part's number; -1: none. `parts`: how many parts there have been.
inline void PersistPart(StateArchive& a, PartId* part, std::size_t parts) {
  a.Int(part, -1, static_cast<std::int64_t>(parts) - 1);
}

}  // namespace seam
