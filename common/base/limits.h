#pragma once
/// Limits that parts of the code must agree on without including each other.

#include <cstddef>
#include <cstdint>

namespace seam {

/// Peers are 0..kPeersMax - 1; 0 is the server. With more of them each session's tables grow.
constexpr std::int32_t kPeersMax = 1024;
/// Most players of a scene. Peer numbers are reserved for players; spectators take the rest.
constexpr std::int32_t kPlayersMax = 1000;
static_assert(kPlayersMax < kPeersMax);
/// Most players of a room that every peer follows whole. With more, a body that all follow would
/// take each state to each of them: the cost of a room would be the square of its players.
constexpr std::int32_t kPlayersFollowingMax = 256;

/// Range of a scene's ticks per second. With fewer, bodies tunnel; more gain nothing.
constexpr int kTickHzMin = 10, kTickHzMax = 960;
/// Highest rate at which a peer may be asked to send States, per second.
constexpr int kSendHzMax = 240;
/// Longest delay from reading an input to its tick: 0.2 s at 60 Hz. With more, driving fails.
constexpr int kInputDelayTicksMax = 12;
/// Greatest age of others' displayed bodies that may be asked for, ticks: half a second at 60 Hz.
/// A peer's past reaches a second back.
constexpr int kShowAgeTicksMax = 30;
/// The greatest age if nothing else is asked for, ticks: others' inputs are known by then at 100 ms
/// there and back.
constexpr int kShowAgeTicks = 8;
/// Longest session, s.
constexpr double kDurationMax = 1e6;

/// Largest datagram we send: below every common path MTU, so that IP never fragments it.
constexpr std::size_t kDatagramBytesMax = 1200;
/// Largest message of a Link, so that it fits one datagram with its headers.
constexpr std::size_t kMessageBytesMax = 1150;

}  // namespace seam
