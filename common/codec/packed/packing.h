#pragma once
/// State and prediction shared by both ends of packed states: docs/protocol.md, "Packed states".

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/codec/packed/bits.h"
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

/// The header of a message: what its States have in common. A message names an earlier one with the
/// same revision and composition, if the receiver has one, instead of both.
struct PackedHeader {
  std::int64_t number = -1;  ///< of the message; -1: there is none
  std::int32_t revision = 0;
  std::int64_t composition = 0;
  std::int64_t tick = 0;
};
/// Messages back to which a header may refer.
constexpr std::int64_t kPackedHeadersKept = 256;

/// What writer and reader have learned of one message; new for each, so that a lost message hides
/// nothing of the next. The probabilities at first are those of common rooms.
struct PackedContext {
  using Fields = std::array<NumberModel, kPackedFields>;

  PackedContext();

  /// Differences from the prediction, of a body that has been as predicted so far or has not, and
  /// from the body before it in the message.
  Fields calm, stirred, fresh;
  BitModel another_group{Percent(70)}, another_body{Percent(15)}, other_gap{Percent(50)},
      other_back{Percent(70)}, other_owner{Percent(90)}, falls{Percent(60)};
  NumberModel header_back{10, 3}, header_ticks{2, 3}, revision{60, 3}, peer{40, 1}, ticks{90, 1},
      first_id{5, 4}, gap{50, 2}, back_by{2, 3}, epoch{30, 3};

  WireBody last;              // state of the previous entry
  bool was_stirred = false;   // of the previous entry
  std::int32_t id_gap = 0;    // id distance of the previous entry in the group; 0: none
  std::int32_t id = -1;       // id of the previous entry in the group
  std::uint32_t back = 0;     // messages back to the previous entry's reference state; 0: none
  std::int64_t tick = 0;      // tick of the previous group
  std::uint32_t entries = 0;  // so far
};

/// Returns the models of a new message.
const PackedContext& FreshContext();

/// Bits of the number of entries at the end of a message, by which one that was cut is known; and
/// of the flags of a state.
constexpr int kEntriesBits = 8, kFlagBits = 3;

/// Writes or reads a header, except its number, which is set. `known`: of an earlier message that
/// the receiver has, for the writer; the reader finds it with `find` by its number.
template <class Coder, class Find>
bool CodeHeader(const PackedHeader& known, const Find& find, PackedContext* context, Coder* coder,
                PackedHeader* header) {
  const bool same = known.number >= 0 && header->number - known.number < kPackedHeadersKept &&
                    known.revision == header->revision && known.composition == header->composition;
  const auto back = coder->Code(
      same ? static_cast<std::uint32_t>(header->number - known.number) : 0, &context->header_back);
  if (back == 0) {
    header->revision = static_cast<std::int32_t>(
        coder->Code(static_cast<std::uint32_t>(header->revision), &context->revision));
    header->composition =
        static_cast<std::int64_t>(coder->Raw(static_cast<std::uint64_t>(header->composition), 64));
    header->tick =
        static_cast<std::int64_t>(coder->Raw(static_cast<std::uint64_t>(header->tick), 40));
    return true;
  }
  const PackedHeader* const from = find(header->number - back);
  if (from == nullptr) return false;
  header->revision = from->revision;
  header->composition = from->composition;
  header->tick = from->tick +
                 UnZigZag(coder->Code(ZigZag(static_cast<std::int32_t>(header->tick - from->tick)),
                                      &context->header_ticks));
  return true;
}

/// Writes or reads the pose and the velocities of a state, as differences from what follows from
/// `from`, if it is known, and else from the entry before. `falls`: the velocity is predicted under
/// gravity.
template <class Coder>
void CodeFields(const PackedMotion& motion, const WireBody* from, bool falls,
                PackedContext* context, Coder* coder, WireBody* state) {
  bool stirred = context->was_stirred;
  const auto code = [&](PackedField field, std::int32_t difference) {
    PackedContext::Fields& fields = from == nullptr ? context->fresh
                                    : stirred       ? context->stirred
                                                    : context->calm;
    const std::uint32_t value = coder->Code(ZigZag(difference), &fields[field]);
    stirred = (field != kPackedVx && stirred) || value != 0;
    return static_cast<std::uint32_t>(UnZigZag(value));
  };
  const auto code16 = [&](PackedField field, std::int16_t guess, std::int16_t* value) {
    const auto difference = static_cast<std::int16_t>(static_cast<std::uint16_t>(*value - guess));
    *value = static_cast<std::int16_t>(
        static_cast<std::uint16_t>(static_cast<std::uint32_t>(guess) + code(field, difference)));
  };
  const auto code32 = [&](PackedField field, std::uint32_t guess, std::uint32_t* value) {
    *value = guess + code(field, static_cast<std::int32_t>(*value - guess));
  };
  const WireBody guess =
      from == nullptr ? WireBody() : PredictVelocity(motion, *from, state->tick, falls);
  code16(kPackedVx, guess.vx, &state->vx);
  code16(kPackedVy, guess.vy, &state->vy);
  code16(kPackedSpin, guess.spin, &state->spin);
  WireBody pose = *state;
  pose.angle = 0;
  if (from != nullptr) {
    PredictPose(motion, *from, &pose);
  } else {
    pose.x = context->last.x;
    pose.y = context->last.y;
  }
  code32(kPackedX, pose.x, &state->x);
  code32(kPackedY, pose.y, &state->y);
  code16(kPackedAngle, pose.angle, &state->angle);
  context->was_stirred = stirred;
}

}  // namespace seam
