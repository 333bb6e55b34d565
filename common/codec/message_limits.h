#pragma once
/// Bounds of what messages hold: every list fits a datagram, or a message of the bus, with room to
/// spare; sums of what they say cannot overflow.

#include <cstddef>
#include <cstdint>

#include "common/base/limits.h"

namespace seam {

/// Largest encoded message on the bus; larger ones overflow stock lcm-logger's socket buffer.
constexpr std::size_t kBusMessageBytesMax = 60000;
/// Most bodies in one States message: 58 + 19 bytes each must fit kMessageBytesMax.
constexpr std::size_t kStatesBodiesMax = 48;
static_assert(54 + 19 * kStatesBodiesMax <= kMessageBytesMax);
/// Most bodies in one View message: 29 bytes each within kBusMessageBytesMax.
constexpr std::size_t kViewBodiesMax = 1900;
static_assert(29 * kViewBodiesMax <= kBusMessageBytesMax);

/// Most views' parts: 32768 ids in views of kViewBodiesMax need 18.
constexpr std::int32_t kViewPartsMax = 32;
static_assert(32768 <= kViewBodiesMax * kViewPartsMax);
/// Most ticks in one Inputs message.
constexpr std::size_t kInputsMax = 64;
/// Most mechanisms in one Grants or Release message, and most followers in one Grants: 36 + 10
/// bytes each + 2 bytes a follower must fit kMessageBytesMax.
constexpr std::size_t kGrantsMax = 80, kGrantFollowersMax = 150;
static_assert(38 + 10 * kGrantsMax + 2 * kGrantFollowersMax <= kMessageBytesMax);
/// Most bodies in one Rest message: 50 + 18 bytes each must fit kMessageBytesMax.
constexpr std::size_t kRestBodiesMax = 60;
static_assert(50 + 18 * kRestBodiesMax <= kMessageBytesMax);
/// Most values in one Meta message: 34 + 8 bytes each must fit kMessageBytesMax.
constexpr std::size_t kMetaMax = 120;
static_assert(34 + 8 * kMetaMax <= kMessageBytesMax);
/// Most impacts in one Impacts message: 16 bytes each within kBusMessageBytesMax.
constexpr std::size_t kImpactsMax = 3000;
static_assert(16 * kImpactsMax < kBusMessageBytesMax);
/// Most points in one Strands message: 10 bytes each within kBusMessageBytesMax.
constexpr std::size_t kStrandPointsMax = 3000;
static_assert(10 * kStrandPointsMax < kBusMessageBytesMax);
/// Most bodies in one ExactStates: 34 + 30 bytes each must fit kMessageBytesMax.
constexpr std::size_t kExactBodiesMax = 36;
static_assert(34 + 30 * kExactBodiesMax <= kMessageBytesMax);
/// Most impacts in one ImpactReport: 34 + 20 bytes each; a peer has few in one tick.
constexpr std::size_t kReportedImpactsMax = 32;
static_assert(34 + 20 * kReportedImpactsMax <= kMessageBytesMax);
/// Most bytes in one Chunk.
constexpr std::size_t kChunkBytesMax = 1000;
static_assert(kChunkBytesMax < kMessageBytesMax);
/// Longest scene file that a Room can carry; a longer one cannot be played.
constexpr std::size_t kSceneTextBytesMax = 51200;
static_assert(kSceneTextBytesMax < kBusMessageBytesMax);
/// Longest names of modes, reconcilers, scenes; longest network profile; longest event or reason.
constexpr std::size_t kLabelBytesMax = 64, kImpairBytesMax = 200, kTextBytesMax = 1000;
/// Ticks are below this (580 years at 60 Hz), times below kTimeMaxUs (285 years) either side of 0:
/// sums and differences of what a message says cannot overflow.
constexpr std::int64_t kTickMax = std::int64_t{1} << 40;
constexpr std::int64_t kTimeMaxUs = std::int64_t{1} << 53;
/// Largest coordinate of a States origin, m: beyond it single precision is coarser than 1/16 m.
constexpr std::int32_t kOriginMax = 1 << 20;

/// Speed of a room's clock that is real time, and the slowest there is, per million.
constexpr std::int32_t kFullSpeedPpm = 1000000, kLeastSpeedPpm = 10000;

}  // namespace seam
