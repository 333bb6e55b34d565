#pragma once
/// Bounds of message contents. Every list fits a datagram, or a message of the bus, with room to
/// spare; sums of ticks and times cannot overflow.

#include <cstddef>
#include <cstdint>

#include "common/base/compress.h"
#include "common/base/limits.h"

namespace seam {

/// Largest encoded message on the bus; larger ones overflow stock lcm-logger's socket buffer.
constexpr std::size_t kBusMessageBytesMax = 60000;
/// Ids of parts, and of assemblies and mechanisms (named after one of their parts), are below this:
/// 0..kIdsMax - 1.
constexpr std::int32_t kIdsMax = 1 << 18;
/// Most bodies in one States message: 58 + 21 bytes each must fit kMessageBytesMax.
constexpr std::size_t kStatesBodiesMax = 48;
static_assert(58 + 21 * kStatesBodiesMax <= kMessageBytesMax);
/// Most bodies in one View message: 60 + 35 bytes each within kBusMessageBytesMax.
constexpr std::size_t kViewBodiesMax = 1700;
static_assert(60 + 35 * kViewBodiesMax <= kBusMessageBytesMax);

/// Most parts of a view: 65 535 bodies in messages of kViewBodiesMax need 35.
constexpr std::int32_t kViewPartsMax = 40;
static_assert(65535 <= kViewBodiesMax * kViewPartsMax);
constexpr int kViewUnmovedMax = 960;  ///< View::unmoved; a second's at most
/// `sequence` of a Room or ScenePart that was published before and is repeated: no loss, no seal
/// and no log counts it.
constexpr std::int64_t kSaidAgain = -1;
/// Most ticks in one Inputs message.
constexpr std::size_t kInputsMax = 64;
/// Most mechanisms in one Grants message, and most followers in it: 36 + 12 bytes each + 2 bytes a
/// follower must fit kMessageBytesMax. The followers of one mechanism are never split.
constexpr std::size_t kGrantsMax = 48, kGrantFollowersMax = 260;
static_assert(36 + 12 * kGrantsMax + 2 * kGrantFollowersMax <= kMessageBytesMax);
/// Most mechanisms in one Release message: 26 + 8 bytes each must fit kMessageBytesMax.
constexpr std::size_t kReleasesMax = 80;
static_assert(26 + 8 * kReleasesMax <= kMessageBytesMax);
/// Most mechanisms in one Differing message: 10 + 4 bytes each must fit kMessageBytesMax.
constexpr std::size_t kDifferingMax = 80;
static_assert(10 + 4 * kDifferingMax <= kMessageBytesMax);
/// Most bodies in one Rest message: 50 + 20 bytes each must fit kMessageBytesMax.
constexpr std::size_t kRestBodiesMax = 54;
/// Most blocks of bodies; a ping compares one of the blocks (RestBlock).
constexpr int kRestBlocksMax = 64;
static_assert(50 + 20 * kRestBodiesMax <= kMessageBytesMax);
/// Most values in one Meta message: 34 + 10 bytes each must fit kMessageBytesMax.
constexpr std::size_t kMetaMax = 110;
static_assert(34 + 10 * kMetaMax <= kMessageBytesMax);
/// Most impacts in one Impacts message: 46 + 20 bytes each within kBusMessageBytesMax.
constexpr std::size_t kImpactsMax = 2900;
static_assert(46 + 20 * kImpactsMax < kBusMessageBytesMax);
/// Most points in one Strands message: 10 bytes each within kBusMessageBytesMax.
constexpr std::size_t kStrandPointsMax = 3000;
static_assert(10 * kStrandPointsMax < kBusMessageBytesMax);
/// Most bodies in one ExactStates: 30 + 32 bytes each must fit kMessageBytesMax.
constexpr std::size_t kExactBodiesMax = 35;
static_assert(30 + 32 * kExactBodiesMax <= kMessageBytesMax);
/// Most impacts in one ImpactReport: 30 + 24 bytes each; a peer has few in one tick.
constexpr std::size_t kReportedImpactsMax = 32;
static_assert(30 + 24 * kReportedImpactsMax <= kMessageBytesMax);
/// Most touches in one TouchReport: 30 + 12 bytes each.
constexpr std::size_t kReportedTouchesMax = 64;
static_assert(30 + 12 * kReportedTouchesMax <= kMessageBytesMax);
/// Bytes of the keys in a Challenge and in a Join, and most of a connect token in a Join.
constexpr std::size_t kChallengeKeysBytes = 2 * 32;
constexpr std::size_t kJoinExchangeBytes = 32 + 24;
constexpr std::size_t kPassBytesMax = 400;
/// Most bytes in one Chunk.
constexpr std::size_t kChunkBytesMax = 1000;
static_assert(kChunkBytesMax < kMessageBytesMax);
/// Longest text of a scene. More costs every joiner seconds: a parser reads about 1 MB a second.
constexpr std::size_t kSceneTextBytesMax = 4000000;
/// Largest encoded Room, and the largest of it compressed, as joiners get it.
constexpr std::size_t kRoomBytesMax = kSceneTextBytesMax + 1000;
constexpr std::size_t kPackedRoomBytesMax = CompressedBytesMax(kRoomBytesMax);
/// Longest text in a Room of the bus; a longer one travels in ScenePart messages.
constexpr std::size_t kBusSceneBytesMax = 51200;
static_assert(kBusSceneBytesMax < kBusMessageBytesMax);
/// Longest name of a mode, reconciler or scene; longest network profile; longest event or reason.
constexpr std::size_t kLabelBytesMax = 64, kImpairBytesMax = 200, kTextBytesMax = 1000;
/// Ticks are below this (580 years at 60 Hz), times within kTimeMaxUs (285 years) of 0, so that
/// sums and differences of message fields cannot overflow.
constexpr std::int64_t kTickMax = std::int64_t{1} << 40;
constexpr std::int64_t kTimeMaxUs = std::int64_t{1} << 53;
/// Largest coordinate of a States origin, m: beyond it single precision is coarser than 1/16 m.
constexpr std::int32_t kOriginMax = 1 << 20;

/// Speed of a room's clock per million of real time: real time, and the slowest allowed.
constexpr std::int32_t kFullSpeedPpm = 1000000, kLeastSpeedPpm = 10000;

}  // namespace seam
