#pragma once
/// Things that happen in a room, told on the bus (lcmtypes/event_t.lcm).

#include <cstdint>
#include <string>
#include <utility>

namespace seam {

/// The numbers are those of event_t.
enum class EventKind : std::int8_t {
  kLine,  ///< of another publisher, or of before 0.26
  kStarted,
  kResumed,
  kEnded,
  kConnected,  ///< admitted, still loading
  kJoined,
  kRejoined,
  kLeft,
  kScored,
  kDestroyed,
  kBroke,
  kTrust,
  kSpeed,  ///< of the room's clock: overloaded, or no longer
  kSeatTaken,
  kSeatFreed,
  kSeatRefused,
  kScript,
  kTrigger,
  kRepaired,  ///< a client with another composition
  kOutOfBounds,
  kWarning,  ///< for the operator, such as a stopped script
  kControl,  ///< a setting or body was changed by the operator, or the input delay by the server
  kParted,   ///< a client's world differs from the server's where all must be equal
};
constexpr std::int8_t kEventKindMax = static_cast<std::int8_t>(EventKind::kParted);

struct Event {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;
  std::string text;
  std::int8_t kind = 0;          ///< EventKind
  std::int32_t client = -1;      ///< peer that it is about; -1: none
  std::int32_t player = -1;      ///< that it is about, or that did it; -1: none
  std::int32_t body = -1;        ///< id of a part; -1: none
  std::int32_t other = -1;       ///< id of the other part of a joint; -1: none
  std::int32_t index = -1;  ///< joint, seat or trigger in the scene; key of a setting; -1: none
  std::int64_t value_milli = 0;  ///< 1/1000: score, trust step, speed, parts, ticks
};
/// Largest absolute value_milli.
constexpr std::int64_t kEventValueMax = std::int64_t{1} << 53;

/// Returns an event of a kind, to be completed.
inline Event MakeEvent(EventKind kind, std::string text, std::int32_t player = -1) {
  Event event;
  event.kind = static_cast<std::int8_t>(kind);
  event.text = std::move(text);
  event.player = player;
  return event;
}

}  // namespace seam
