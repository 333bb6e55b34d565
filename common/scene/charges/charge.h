#pragma once
/// Charges: blasts that go off by themselves, at a time or by a trigger.

#include <cstddef>
#include <string>

#include "common/scene/types.h"

namespace seam {

/// Limits of one blast: m, and N s for each metre of silhouette.
constexpr float kBlastRadiusMax = 10, kBlastImpulseMax = 1e5f;
constexpr std::size_t kChargesMax = 256;

/// A blast at a given time, or once a part enters a trigger. A charge goes off once.
struct Charge {
  std::string name;     ///< unique
  Vec2 position{0, 0};  ///< m, of its centre; relative to `part`, if given
  PartId part = -1;     ///< moves with this part (without turning), ends with it; -1: fixed
  float radius = 1;     ///< m
  float speed = 0;      ///< m/s of bricks in the centre
  float impulse = 0;    ///< N s for each metre of silhouette in the centre
  double at_s = -1;     ///< time of the blast; below 0: by the trigger
  int trigger = -1;     ///< index into Scene::triggers; -1: at a time
  double delay_s = 0;   ///< after the first part enters the trigger
  int line = 0;         ///< line in the scene file
};

}  // namespace seam
