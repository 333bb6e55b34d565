#pragma once
/// Plain types in saved state.

#include <cmath>
#include <cstddef>

#include "common/base/state_archive.h"
#include "common/scene/types.h"

namespace seam {

/// Limits of a saved body: m, m/s and rad/s, rad. Messages carry places up to 2^20 m and a little.
constexpr float kSavedPlaceMost = 1 << 21, kSavedSpeedMost = 1e5f, kSavedAngleMost = 1e8f;

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

/// States that lie one after another, many of them: quicker than one by one.
inline void PersistStates(StateArchive& a, BodyState* first, std::size_t count) {
  static_assert(sizeof(BodyState) == 6 * sizeof(float));
  a.Raw(first, count * sizeof(BodyState));
  for (std::size_t i = 0; a.reading() && i < count; ++i) {
    const BodyState& s = first[i];
    const float place = s.position.cwiseAbs().maxCoeff(), speed = s.velocity.cwiseAbs().maxCoeff();
    const bool good = s.position.allFinite() && s.velocity.allFinite() &&
                      place <= kSavedPlaceMost && speed <= kSavedSpeedMost &&
                      std::fabs(s.angle) <= kSavedAngleMost &&
                      std::fabs(s.spin) <= kSavedSpeedMost;  // false for NaN
    a.Require(good, "a state is out of range");
    if (!a.ok()) return;
  }
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
