#pragma once
/// What explodes by itself: where, how hard, and when.

#include <cstddef>
#include <string>

#include "common/scene/types.h"

namespace seam {

/// Of one blast: m, and N s for each metre of silhouette.
constexpr float kBlastRadiusMax = 10, kBlastImpulseMax = 1e5f;
constexpr std::size_t kChargesMax = 256;

/// A blast at a time, or when something enters a trigger. It goes off once.
struct Charge {
  std::string name;     ///< unique
  Vec2 position{0, 0};  ///< m, of its centre; from `part`, if there is one
  PartId part = -1;     ///< moves with it (without turning), ends with it; -1: stays
  float radius = 1;     ///< m
  float speed = 0;      ///< m/s of bricks in the centre
  float impulse = 0;    ///< N s for each metre of silhouette in the centre
  double at_s = -1;     ///< below 0: by the trigger
  int trigger = -1;     ///< index into Scene::triggers; -1: at a time
  double delay_s = 0;   ///< from the first that enters the trigger
  int line = 0;         ///< in the scene file
};

}  // namespace seam
