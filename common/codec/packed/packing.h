#pragma once
/// State and prediction shared by both ends of packed states: docs/protocol.md, "Packed states".

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/codec/packed/bits.h"
#include "common/codec/wire_body.h"

namespace seam {

/// Newest states per body that the receiver keeps; the sender refers to no older ones.
constexpr std::int32_t kPackedKept = 32;

/// Parameters of the prediction: gravity and tick rate.
struct PackedMotion {
  std::int64_t gravity_x = 0, gravity_y = 0;  ///< 2^-24 m/s per tick
  std::int64_t tick_hz = 60;

  PackedMotion() = default;
  /// Gravity in m/s^2.
  PackedMotion(float x, float y, int hz);
};

/// Fields of a WireBody that are coded as differences, in this order.
enum PackedField { kPackedVx, kPackedVy, kPackedSpin, kPackedX, kPackedY, kPackedAngle };
constexpr std::size_t kPackedFields = 6;

/// Predicts the velocities of `from` at `tick`: under gravity if it `falls`, else unchanged. Id,
/// epoch and flags are those of `from`.
WireBody PredictVelocity(const PackedMotion& motion, const WireBody& from, std::int64_t tick,
                         bool falls);
/// Predicts the pose of `to` at to->tick from the pose of `from` and the mean of both velocities.
void PredictPose(const PackedMotion& motion, const WireBody& from, WireBody* to);

/// Adaptive state of the coding of one message; reset for each message.
struct PackedContext {
  std::array<AdaptiveGolomb, kPackedFields> known{AdaptiveGolomb(2), AdaptiveGolomb(2),
                                                  AdaptiveGolomb(1), AdaptiveGolomb(2),
                                                  AdaptiveGolomb(2), AdaptiveGolomb(3)};
  std::array<AdaptiveGolomb, kPackedFields> fresh{AdaptiveGolomb(9),  AdaptiveGolomb(9),
                                                  AdaptiveGolomb(8),  AdaptiveGolomb(10),
                                                  AdaptiveGolomb(10), AdaptiveGolomb(13)};
  WireBody last;            // state of the previous entry
  std::int32_t id_gap = 0;  // id distance of the previous entry in the group; 0: none
  std::int32_t id = -1;     // id of the previous entry in the group
  std::uint32_t back = 0;   // messages back to the previous entry's reference state; 0: none
  std::int64_t tick = 0;    // tick of the previous group
};

}  // namespace seam
