#include "common/codec/codec.h"

#include <tuple>
#include <unordered_map>

#include "common/base/check.h"
#include "common/codec/validate.h"
#include "seam/bye_t.hpp"
#include "seam/chunk_t.hpp"
#include "seam/edit_t.hpp"
#include "seam/event_t.hpp"
#include "seam/grants_t.hpp"
#include "seam/hello_t.hpp"
#include "seam/impacts_t.hpp"
#include "seam/inputs_t.hpp"
#include "seam/meta_t.hpp"
#include "seam/ping_t.hpp"
#include "seam/pong_t.hpp"
#include "seam/room_t.hpp"
#include "seam/states_t.hpp"
#include "seam/stats_t.hpp"
#include "seam/view_t.hpp"
#include "seam/welcome_t.hpp"

namespace seam {
namespace {

/// The generated type of a message, and the fields that both have under one name, so that
/// assigning one tuple of references to the other converts in either direction.
template <class Message>
struct Wire;

template <>
struct Wire<Hello> {
  using Type = hello_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.protocol, m.name);
  }
};

template <>
struct Wire<Welcome> {
  using Type = welcome_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.peer, m.player, m.room_bytes);
  }
};

template <>
struct Wire<Chunk> {
  using Type = chunk_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.offset_bytes, m.data);
  }
};

template <>
struct Wire<Room> {
  using Type = room_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.protocol, m.room, m.scene_name, m.scene_text, m.mode,
                    m.reconcile, m.impair, m.seed, m.tick_hz, m.send_hz);
  }
};

template <>
struct Wire<Ping> {
  using Type = ping_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.revision, m.composition);
  }
};

template <>
struct Wire<Pong> {
  using Type = pong_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.client_us, m.tick0_us);
  }
};

template <>
struct Wire<Inputs> {
  using Type = inputs_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.player, m.first_tick, m.drive, m.lift, m.buttons);
  }
};

template <>
struct Wire<States> {
  using Type = states_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.peer, m.tick, m.revision, m.composition, m.origin_x,
                    m.origin_y, m.id, m.epoch, m.flags, m.x, m.y, m.angle, m.vx, m.vy, m.spin);
  }
};

template <>
struct Wire<Grants> {
  using Type = grants_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.tick, m.mechanism, m.authority, m.epoch, m.secondaries);
  }
};

template <>
struct Wire<EditOrder> {
  using Type = edit_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.number, m.tick, m.kind, m.cause, m.a, m.b, m.joint,
                    m.player, m.text, m.value);
  }
};

template <>
struct Wire<Meta> {
  using Type = meta_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.tick, m.kind, m.id, m.key, m.value);
  }
};

template <>
struct Wire<View> {
  using Type = view_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.peer, m.tick, m.revision, m.part, m.parts, m.id, m.role,
                    m.authority, m.x, m.y, m.angle, m.vx, m.vy, m.spin);
  }
};

template <>
struct Wire<Impacts> {
  using Type = impacts_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.peer, m.tick, m.id_a, m.id_b, m.x, m.y, m.dv);
  }
};

template <>
struct Wire<Stats> {
  using Type = stats_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.peer, m.tick, m.bytes_out, m.bytes_in, m.datagrams_out,
                    m.datagrams_in, m.dropped_malformed, m.dropped_stale, m.dropped_right,
                    m.dropped_implausible, m.cpu_us, m.rtt_us, m.loss_ppm, m.tick_late_us,
                    m.clock_offset_us);
  }
};

template <>
struct Wire<Event> {
  using Type = event_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.sequence, m.peer, m.tick, m.text);
  }
};

template <>
struct Wire<Bye> {
  using Type = bye_t;
  template <class M>
  static auto Fields(M& m) {
    return std::tie(m.utime, m.reason);
  }
};

/// The one count that a message's arrays share on the wire.
std::size_t Count(const Chunk& m) { return m.data.size(); }
std::size_t Count(const Inputs& m) { return m.drive.size(); }
std::size_t Count(const States& m) { return m.id.size(); }
std::size_t Count(const Grants& m) { return m.mechanism.size(); }
std::size_t Count(const EditOrder& m) { return m.value.size(); }
std::size_t Count(const Meta& m) { return m.id.size(); }
std::size_t Count(const View& m) { return m.id.size(); }
std::size_t Count(const Impacts& m) { return m.id_a.size(); }

/// Sets the count of a generated type that has one; 0 prefers the first where both fit.
template <class Message, class Generated>
auto SetCount(const Message& message, Generated& wire, int) -> decltype(wire.count, void()) {
  wire.count = static_cast<std::int16_t>(Count(message));
}
template <class Message, class Generated>
void SetCount(const Message&, Generated&, long) {}

template <class Message>
Bytes EncodeAs(const Message& message) {
  SEAM_ASSERT(Valid(message));
  typename Wire<Message>::Type wire{};
  Wire<Message>::Fields(wire) = Wire<Message>::Fields(message);
  SetCount(message, wire, 0);
  const int size = wire.getEncodedSize();
  SEAM_ASSERT(size > 0 && static_cast<std::size_t>(size) <= kBusMessageBytesMax);
  Bytes bytes(static_cast<std::size_t>(size));
  SEAM_ASSERT(wire.encode(bytes.data(), 0, size) == size);
  return bytes;
}

template <class Message>
AnyMessage DecodeAs(ByteView bytes) {
  typename Wire<Message>::Type wire{};
  const int size = static_cast<int>(bytes.size);
  if (wire.decode(bytes.data, 0, size) != size) return {};
  Message message;
  Wire<Message>::Fields(message) = Wire<Message>::Fields(wire);
  if (!Valid(message)) return {};
  return message;
}

template <class Message>
std::uint64_t WireHash() {
  return static_cast<std::uint64_t>(Wire<Message>::Type::getHash());
}

using Decoder = AnyMessage (*)(ByteView);

const std::unordered_map<std::uint64_t, Decoder>& Decoders() {
  static const std::unordered_map<std::uint64_t, Decoder> decoders = {
      {WireHash<Hello>(), DecodeAs<Hello>},     {WireHash<Welcome>(), DecodeAs<Welcome>},
      {WireHash<Chunk>(), DecodeAs<Chunk>},     {WireHash<Room>(), DecodeAs<Room>},
      {WireHash<Ping>(), DecodeAs<Ping>},       {WireHash<Pong>(), DecodeAs<Pong>},
      {WireHash<Inputs>(), DecodeAs<Inputs>},   {WireHash<States>(), DecodeAs<States>},
      {WireHash<Grants>(), DecodeAs<Grants>},   {WireHash<EditOrder>(), DecodeAs<EditOrder>},
      {WireHash<Meta>(), DecodeAs<Meta>},       {WireHash<View>(), DecodeAs<View>},
      {WireHash<Impacts>(), DecodeAs<Impacts>}, {WireHash<Stats>(), DecodeAs<Stats>},
      {WireHash<Event>(), DecodeAs<Event>},     {WireHash<Bye>(), DecodeAs<Bye>},
  };
  return decoders;
}

}  // namespace

Bytes Encode(const Hello& m) { return EncodeAs(m); }
Bytes Encode(const Welcome& m) { return EncodeAs(m); }
Bytes Encode(const Chunk& m) { return EncodeAs(m); }
Bytes Encode(const Room& m) { return EncodeAs(m); }
Bytes Encode(const Ping& m) { return EncodeAs(m); }
Bytes Encode(const Pong& m) { return EncodeAs(m); }
Bytes Encode(const Inputs& m) { return EncodeAs(m); }
Bytes Encode(const States& m) { return EncodeAs(m); }
Bytes Encode(const Grants& m) { return EncodeAs(m); }
Bytes Encode(const EditOrder& m) { return EncodeAs(m); }
Bytes Encode(const Meta& m) { return EncodeAs(m); }
Bytes Encode(const View& m) { return EncodeAs(m); }
Bytes Encode(const Impacts& m) { return EncodeAs(m); }
Bytes Encode(const Stats& m) { return EncodeAs(m); }
Bytes Encode(const Event& m) { return EncodeAs(m); }
Bytes Encode(const Bye& m) { return EncodeAs(m); }

AnyMessage Decode(ByteView bytes) {
  if (bytes.size < 8 || bytes.size > kBusMessageBytesMax) return {};
  std::uint64_t hash = 0;
  for (int i = 0; i < 8; ++i) hash = hash << 8 | bytes.data[i];
  const auto decoder = Decoders().find(hash);
  if (decoder == Decoders().end()) return {};
  try {
    return decoder->second(bytes);
  } catch (...) {  // nothing is known to throw; a hostile byte must not end the process
    return {};
  }
}

}  // namespace seam
