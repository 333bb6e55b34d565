#pragma once
/// Quanta of the states on the wire: States, packed states and Rest (docs/protocol.md).

#include <cstdint>

#include "common/base/geometry.h"

namespace seam {

constexpr std::int32_t kQuantaPerMetre = 512;
constexpr std::int32_t kQuantaPerSpeed = 256;   ///< per m/s and rad/s
constexpr std::int32_t kQuantaPerTurn = 65536;  ///< of angles

constexpr float kPositionQuantum = 1.0f / kQuantaPerMetre;  ///< m
constexpr float kVelocityQuantum = 1.0f / kQuantaPerSpeed;  ///< m/s and rad/s
constexpr double kAngleQuantum = 2 * kPi / kQuantaPerTurn;  ///< rad

/// Largest distance of a body from the origin of its message, m: int16 reaches 64 m.
constexpr std::int32_t kOriginReach = 60;

}  // namespace seam
