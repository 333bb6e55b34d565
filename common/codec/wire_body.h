#pragma once
/// State of a body as it is sent: in the quanta of the wire, its position from the room's origin.

#include <cstdint>
#include <cstdlib>

#include "common/codec/messages.h"
#include "common/codec/quanta.h"

namespace seam {

struct WireBody {
  std::int64_t tick = -1;  ///< -1: no state
  std::int32_t id = 0;
  std::int32_t epoch = 0;
  std::uint32_t x = 0, y = 0;  ///< two's complement
  std::int16_t angle = 0, vx = 0, vy = 0, spin = 0;
  std::int8_t flags = 0;
};

/// Fields common to all bodies of a States.
struct StatesHeader {
  std::int32_t peer = 0;  ///< the authority
  std::int64_t tick = 0;
  std::int32_t revision = 0;
  std::int64_t composition = 0;
};

inline StatesHeader HeaderOf(const States& states) {
  return {states.peer, states.tick, states.revision, states.composition};
}

/// Returns entry `i` of a message.
inline WireBody BodyAt(const States& states, std::size_t i) {
  WireBody body;
  body.tick = states.tick;
  body.id = states.id[i];
  body.epoch = states.epoch[i];
  body.x = static_cast<std::uint32_t>(states.origin_x * kQuantaPerMetre + states.x[i]);
  body.y = static_cast<std::uint32_t>(states.origin_y * kQuantaPerMetre + states.y[i]);
  body.angle = states.angle[i];
  body.vx = states.vx[i];
  body.vy = states.vy[i];
  body.spin = states.spin[i];
  body.flags = states.flags[i];
  return body;
}

/// True if a coordinate, in quanta, is near enough to the origin of a message, in quanta.
inline bool NearOrigin(std::uint32_t at, std::int32_t origin) {
  return std::abs(static_cast<std::int32_t>(at) - origin) < kOriginReach * kQuantaPerMetre;
}

/// True if the message has room for the body, near its origin.
inline bool Fits(const States& states, const WireBody& body) {
  return states.id.size() < kStatesBodiesMax &&
         NearOrigin(body.x, states.origin_x * kQuantaPerMetre) &&
         NearOrigin(body.y, states.origin_y * kQuantaPerMetre);
}

/// Appends a body to a message with the header of its state. Requires that it is near the origin.
inline void AppendBody(const WireBody& body, States* to) {
  const auto from_origin = [](std::uint32_t at, std::int32_t origin) {
    return static_cast<std::int16_t>(static_cast<std::int32_t>(at) - origin * kQuantaPerMetre);
  };
  to->id.push_back(body.id);
  to->epoch.push_back(body.epoch);
  to->flags.push_back(body.flags);
  to->x.push_back(from_origin(body.x, to->origin_x));
  to->y.push_back(from_origin(body.y, to->origin_y));
  to->angle.push_back(body.angle);
  to->vx.push_back(body.vx);
  to->vy.push_back(body.vy);
  to->spin.push_back(body.spin);
}

}  // namespace seam
