#pragma once
/// What both ends of packed states know and how they guess: docs/protocol.md, "Packed states".

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/codec/packed/bits.h"

namespace seam {

/// The newest states of a body that the receiver keeps: the sender counts on no older ones.
constexpr std::int32_t kPackedKept = 32;

/// How bodies go on by themselves.
struct PackedMotion {
  std::int64_t gravity_x = 0, gravity_y = 0;  ///< 2^-24 m/s a tick
  std::int64_t tick_hz = 60;

  PackedMotion() = default;
  /// m/s^2.
  PackedMotion(float x, float y, int hz);
};

/// A body's entry of a States, in its quanta; x and y from the room's origin.
struct PackedState {
  std::int64_t tick = 0;
  std::int32_t epoch = 0;
  std::uint32_t x = 0, y = 0;  ///< of two's complement
  std::int16_t angle = 0, vx = 0, vy = 0, spin = 0;
  std::int8_t flags = 0;
};

/// What a message says of all its entries: of whom and when they are.
struct PackedHeader {
  std::int32_t peer = 0;  ///< the authority
  std::int64_t tick = 0;
  std::int32_t revision = 0;
  std::int64_t composition = 0;
};
/// An entry of one.
struct PackedEntry {
  std::int32_t id = 0;
  PackedState state;
};

/// Fields of a PackedState that are coded as differences, in this order.
enum PackedField { kPackedVx, kPackedVy, kPackedSpin, kPackedX, kPackedY, kPackedAngle };
constexpr std::size_t kPackedFields = 6;

/// Where `from` is `tick` - from.tick later, if it falls freely, or else goes on: the velocities;
/// epoch and flags are those of `from`.
PackedState GuessVelocity(const PackedMotion& motion, const PackedState& from, std::int64_t tick,
                          bool falls);
/// Fills in where it is then, with the mean of the velocities of `from` and of `to`.
void GuessPlace(const PackedMotion& motion, const PackedState& from, PackedState* to);

/// What is coded as a message goes on, and learned from it; each message begins anew.
struct PackedContext {
  std::array<Learned, kPackedFields> known{Learned(2), Learned(2), Learned(1),
                                           Learned(2), Learned(2), Learned(3)};
  std::array<Learned, kPackedFields> fresh{Learned(9),  Learned(9),  Learned(8),
                                           Learned(10), Learned(10), Learned(13)};
  PackedState last;         // of the entry before
  std::int32_t id_gap = 0;  // to the entry before in its group; 0: there was none
  std::int32_t id = -1;     // of the entry before in its group
  std::uint32_t back = 0;   // messages back to what the entry before is a difference from; 0: none
  std::int64_t tick = 0;    // of the group before
};

}  // namespace seam
