#pragma once
/// Numbers that rooms which do not know each other must agree on.

#include <cstddef>
#include <cstdint>

namespace seam {

/// Peers are 0..kPeersMax - 1; 0 is the server. With more of them each session's tables grow.
constexpr std::int32_t kPeersMax = 1024;
/// Players of a scene. Their peers have places of their own: spectators take the others'.
constexpr std::int32_t kPlayersMax = 256;
static_assert(kPlayersMax < kPeersMax);

/// Ticks per second that a scene may ask for. With fewer, bodies tunnel; more gain nothing.
constexpr int kTickHzMin = 10, kTickHzMax = 960;
/// Most States per second that a peer may be asked for.
constexpr int kSendHzMax = 240;
/// Longest delay between reading an input and its tick: 0.2 s at 60 Hz, with more nobody can drive.
constexpr int kInputDelayTicksMax = 12;
/// Longest session, s.
constexpr double kDurationMax = 1e6;

/// Largest datagram we send: below every common path MTU, so that IP never fragments it.
constexpr std::size_t kDatagramBytesMax = 1200;
/// Largest message of a Link, so that it fits one datagram with its headers.
constexpr std::size_t kMessageBytesMax = 1150;

}  // namespace seam
