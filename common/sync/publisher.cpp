#include "common/sync/publisher.h"

#include <algorithm>

namespace seam {
namespace {

template <typename T>
std::vector<T> Slice(const std::vector<T>& v, std::size_t first, std::size_t last) {
  return std::vector<T>(v.begin() + static_cast<std::ptrdiff_t>(first),
                        v.begin() + static_cast<std::ptrdiff_t>(last));
}

}  // namespace

template <typename Message>
void Publisher::Number(Message& message, const char* kind, int peer) {
  const std::string channel = ChannelName(room_, kind, peer);
  message.sequence = sequence_[channel]++;
  const Bytes bytes = Encode(message);
  recorder_.Publish(channel, message.utime, bytes);
}

void Publisher::Publish(Room message) { Number(message, "scene", -1); }
void Publisher::Publish(Inputs message) { Number(message, "inputs", message.player); }
void Publisher::Publish(States message) { Number(message, "states", message.peer); }
void Publisher::Publish(Grants message) { Number(message, "grants", -1); }
void Publisher::Publish(EditOrder message) { Number(message, "edit", -1); }
void Publisher::Publish(Meta message) { Number(message, "meta", -1); }
void Publisher::Publish(Impacts message) { Number(message, "impacts", message.peer); }
void Publisher::Publish(Stats message) { Number(message, "stats", message.peer); }
void Publisher::Publish(Event message) { Number(message, "event", message.peer); }

void Publisher::Publish(const View& message) {
  const std::size_t count = message.id.size();
  const std::size_t parts = std::max<std::size_t>(1, (count + kViewBodiesMax - 1) / kViewBodiesMax);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t a = count * part / parts;
    const std::size_t b = count * (part + 1) / parts;
    View piece;
    piece.utime = message.utime;
    piece.peer = message.peer;
    piece.tick = message.tick;
    piece.revision = message.revision;
    piece.part = static_cast<std::int32_t>(part);
    piece.parts = static_cast<std::int32_t>(parts);
    piece.id = Slice(message.id, a, b);
    piece.role = Slice(message.role, a, b);
    piece.authority = Slice(message.authority, a, b);
    piece.x = Slice(message.x, a, b);
    piece.y = Slice(message.y, a, b);
    piece.angle = Slice(message.angle, a, b);
    piece.vx = Slice(message.vx, a, b);
    piece.vy = Slice(message.vy, a, b);
    piece.spin = Slice(message.spin, a, b);
    Number(piece, "view", message.peer);
  }
}

}  // namespace seam
