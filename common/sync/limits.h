#pragma once
/// Size limits that depend on each other: messages against their carriers, and lengths of one text
/// in different rooms. A violation does not compile.

#include <cstddef>

#include "common/codec/messages.h"
#include "common/codec/scene_part.h"
#include "common/net/datagram.h"
#include "common/net/link.h"
#include "common/net/net.h"

namespace seam {

/// Encoded size of a message with empty lists and texts, and the size of each element, as the .lcm
/// files define it: 8 bytes of type, the fields, a count of 2 bytes before lists, 5 bytes for an
/// empty string.
struct MessageBytes {
  std::size_t empty;
  std::size_t each;
};
constexpr MessageBytes kStatesBytes{58, 21};
constexpr MessageBytes kGrantsBytes{36, 12};  ///< plus kFollowerBytes per follower
constexpr std::size_t kFollowerBytes = 2;
constexpr MessageBytes kReleaseBytes{26, 8};
constexpr MessageBytes kRestBytes{50, 20};
constexpr MessageBytes kExactStatesBytes{30, 32};
constexpr MessageBytes kImpactReportBytes{30, 24};
constexpr MessageBytes kTouchReportBytes{30, 12};
constexpr MessageBytes kMetaBytes{34, 10};
constexpr MessageBytes kInputsBytes{38, 4};
constexpr MessageBytes kChunkBytes{22, 1};
constexpr MessageBytes kEditBytes{79, 1};  ///< per byte of text; it has at most five numbers
constexpr MessageBytes kViewBytes{52, 35};
constexpr MessageBytes kImpactsBytes{38, 20};
constexpr MessageBytes kStrandsBytes{38, 10};
constexpr MessageBytes kRoomBytes{83, 1};  ///< per byte of any of its texts
constexpr MessageBytes kScenePartBytesOf{42, 1};

constexpr std::size_t Largest(const MessageBytes& bytes, std::size_t count) {
  return bytes.empty + bytes.each * count;
}

// Between peers: a message with the headers of link.h fits one datagram.
static_assert(kDatagramOverheadBytes + 4 + kMessageBytesMax <= kDatagramBytesMax,
              "a message would not fit a datagram");
static_assert(Largest(kStatesBytes, kStatesBodiesMax) <= kMessageBytesMax, "States too large");
static_assert(Largest(kGrantsBytes, kGrantsMax) + kFollowerBytes * kGrantFollowersMax <=
                  kMessageBytesMax,
              "Grants too large");
static_assert(kGrantFollowersMax >= static_cast<std::size_t>(kPlayersFollowingMax) + 1,
              "the followers of a mechanism that all follow must fit one Grants");
static_assert(Largest(kReleaseBytes, kReleasesMax) <= kMessageBytesMax, "Release too large");
static_assert(Largest(kRestBytes, kRestBodiesMax) <= kMessageBytesMax, "Rest too large");
static_assert(Largest(kExactStatesBytes, kExactBodiesMax) <= kMessageBytesMax,
              "ExactStates too large");
static_assert(Largest(kImpactReportBytes, kReportedImpactsMax) <= kMessageBytesMax,
              "ImpactReport too large");
static_assert(Largest(kTouchReportBytes, kReportedTouchesMax) <= kMessageBytesMax,
              "TouchReport too large");
static_assert(Largest(kMetaBytes, kMetaMax) <= kMessageBytesMax, "Meta too large");
static_assert(Largest(kInputsBytes, kInputsMax) <= kMessageBytesMax, "Inputs too large");
static_assert(Largest(kChunkBytes, kChunkBytesMax) <= kMessageBytesMax, "Chunk too large");
static_assert(Largest(kEditBytes, kEditTextBytesMax) <= kMessageBytesMax, "EditOrder too large");

// On the bus.
static_assert(Largest(kViewBytes, kViewBodiesMax) <= kBusMessageBytesMax, "View too large");
static_assert(Largest(kImpactsBytes, kImpactsMax) <= kBusMessageBytesMax, "Impacts too large");
static_assert(Largest(kStrandsBytes, kStrandPointsMax) <= kBusMessageBytesMax, "Strands too large");
constexpr std::size_t kRoomLabelBytesMax = 5 * kLabelBytesMax + kImpairBytesMax;
static_assert(Largest(kRoomBytes, kBusSceneBytesMax + kRoomLabelBytesMax) <= kBusMessageBytesMax,
              "a Room with the longest scene of the bus could not be published");
static_assert(Largest(kRoomBytes, kSceneTextBytesMax + kRoomLabelBytesMax) <= kRoomBytesMax,
              "a Room with the longest scene could not be joined");
static_assert(Largest(kScenePartBytesOf, kScenePartBytes) <= kBusMessageBytesMax,
              "ScenePart too large");

}  // namespace seam
