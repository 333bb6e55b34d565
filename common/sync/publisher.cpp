#include "common/sync/publisher.h"

#include <algorithm>
#include <utility>

#include "common/record/chain_check.h"

namespace seam {
namespace {

template <typename T>
std::vector<T> Slice(const std::vector<T>& v, std::size_t first, std::size_t last) {
  return std::vector<T>(v.begin() + static_cast<std::ptrdiff_t>(first),
                        v.begin() + static_cast<std::ptrdiff_t>(last));
}

}  // namespace

template <class Message>
void Publisher::Number(Message& message) {
  using Traits = MessageTraits<Message>;
  static_assert(Traits::kTravels != Travels::kEdge);
  if (!recorder_.listening()) return;
  int whose = -1;
  if constexpr (Traits::kTravels == Travels::kBusPeer) whose = message.peer;
  if constexpr (Traits::kTravels == Travels::kBusPlayer) whose = message.player;
  const std::string channel = ChannelName(room_, Traits::kKind, whose);
  message.session = session_;
  message.sequence = sequence_[channel]++;
  const Bytes bytes = Encode(message);
  ++chain_.messages;
  chain_.messages_crc = ChainedCrc(chain_.messages_crc, channel, bytes);
  recorder_.Publish(channel, message.utime, bytes);
}

void Publisher::EndTick(std::int64_t utime, int peer, std::int64_t tick) {
  if (!recorder_.listening()) return;
  const std::string channel = ChannelName(room_, MessageTraits<TickChain>::kKind, peer);
  chain_.utime = utime;
  chain_.session = session_;
  chain_.sequence = sequence_[channel]++;
  chain_.peer = peer;
  chain_.tick = tick;
  recorder_.EndTick(channel, std::exchange(chain_, TickChain()));
}

template <class Message>
void Publisher::Publish(Message message) {
  Number(message);
}

template void Publisher::Publish(Room);
template void Publisher::Publish(ScenePart);
template void Publisher::Publish(Inputs);
template void Publisher::Publish(States);
template void Publisher::Publish(Grants);
template void Publisher::Publish(Audit);
template void Publisher::Publish(EditOrder);
template void Publisher::Publish(Meta);
template void Publisher::Publish(Impacts);
template void Publisher::Publish(Strands);
template void Publisher::Publish(Stats);
template void Publisher::Publish(Load);
template void Publisher::Publish(Event);

void Publisher::Publish(const View& message) {
  if (!recorder_.listening()) return;
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
    piece.age = Slice(message.age, a, b);
    Number(piece);
  }
}

}  // namespace seam
