#pragma once
/// Plain types shared by every layer above physics.

#include <Eigen/Core>
#include <cstdint>

namespace seam {

using Vec2 = Eigen::Vector2f;

/// A part's number: its index among the scene's parts, from 0.
using PartId = std::int32_t;

/// Pose and velocity of one assembly. `position` is the origin of the root part's shape frame.
struct BodyState {
  Vec2 position{0, 0};  ///< m
  float angle = 0;      ///< rad, not wrapped
  Vec2 velocity{0, 0};  ///< m/s, of the centre of mass
  float spin = 0;       ///< rad/s
};

/// Input of a player for one tick.
struct Input {
  std::int8_t drive = 0;     ///< -127..127, motors that follow the player
  std::int8_t lift = 0;      ///< -127..127, a second axis
  std::int16_t buttons = 0;  ///< bit b: action b is pressed; acts on the tick of the press
  bool operator==(const Input& o) const {
    return drive == o.drive && lift == o.lift && buttons == o.buttons;
  }
};

/// The axis of a player that a motor or thrust follows.
enum class InputAxis { kDrive, kLift };

/// Returns the deflection of an axis, -1..1.
inline float ShareOf(const Input& input, InputAxis axis) {
  const int value = axis == InputAxis::kDrive ? input.drive : input.lift;
  return static_cast<float>(value < -127 ? -127 : value) / 127.0f;
}

}  // namespace seam
