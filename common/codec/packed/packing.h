#pragma once
/// State and prediction shared by both ends of packed states: docs/protocol.md, "Packed states".

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/codec/packed/range_coder.h"
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

/// What is expected of the decisions and numbers of a message; learned anew in each.
struct PackedModels {
  /// Differences, where the body's velocity went as guessed, and where it did not; and whole
  /// states.
  std::array<NumberModel, kPackedFields> steady, hit, fresh;
  NumberModel first_id, id_gap, back, epoch, peer, ticks, revision, base;
  BitModel body, group, same_gap, same_back, same_rest, based;
  std::array<BitModel, 2> falls;  ///< after a body that fell or did not
  static const PackedModels& Initial();

 private:
  PackedModels();  // slow: copies of Initial are used
};

/// State of the coding of one message; reset for each.
struct PackedContext {
  PackedModels models = PackedModels::Initial();
  WireBody last;            // state of the previous entry
  std::int32_t id_gap = 0;  // id distance of the previous entry in the group; 0: none
  std::int32_t id = -1;     // id of the previous entry in the group
  std::uint32_t back = 0;   // messages back to the previous entry's reference state; 0: none
  std::int64_t tick = 0;    // tick of the previous group
  bool fell = false;        // the previous entry that was a difference
  bool was_hit = false;     // its velocity did not go as guessed
};

/// Newest messages whose headers a receiver keeps; a sender refers to none that is older than half
/// of it.
constexpr std::int64_t kPackedHeaders = 128;

/// Codes the six differences of a body by `coded(field, model)`, which codes one and returns
/// whether it was 0.
template <class Coded>
void CodeDifferences(bool known, PackedContext* context, const Coded& coded) {
  PackedModels& models = context->models;
  bool was_hit = context->was_hit, is_hit = false;
  for (std::size_t field = 0; field < kPackedFields; ++field) {
    if (field > 0) was_hit = is_hit;
    NumberModel& model = !known    ? models.fresh[field]
                         : was_hit ? models.hit[field]
                                   : models.steady[field];
    const bool zero = coded(static_cast<PackedField>(field), &model);
    if (field <= kPackedSpin) is_hit = is_hit || !zero;
  }
  if (known) context->was_hit = is_hit;
}

}  // namespace seam
