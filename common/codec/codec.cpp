#include "common/codec/codec.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "common/base/check.h"
#include "common/codec/fingerprints.h"
#include "common/codec/validate.h"
#include "seam/all_types.hpp"  // each LCM type's header; made by the Makefile

namespace seam {
namespace {

/// The generated LCM type of a message. Both have the listed fields under the same names, so that
/// assigning one tuple of references to the other converts in either direction.
template <class Message>
struct Wire;

#define SEAM_MESSAGE_WIRE(Struct, lcm_type, ...) \
  template <>                                    \
  struct Wire<Struct> {                          \
    using Type = lcm_type;                       \
  };
SEAM_MESSAGES(SEAM_MESSAGE_WIRE)
#undef SEAM_MESSAGE_WIRE

/// Returns the number of elements of an array field; -1 for any other field.
template <class T>
int Elements(const std::vector<T>& values) {
  return static_cast<int>(values.size());
}
template <class T>
int Elements(const T&) {
  return -1;
}

/// Returns the number of elements of a message's first (or last) array.
template <class Message>
std::int16_t ArrayLength(const Message& message, bool last) {
  int length = 0;
  bool found = false;
  std::apply(
      [&](const auto&... field) {
        const auto look = [&](int elements) {
          if (elements < 0 || (found && !last)) return;
          found = true;
          length = elements;
        };
        (look(Elements(field)), ...);
      },
      MessageTraits<Message>::Fields(message));
  return static_cast<std::int16_t>(length);
}

/// Sets the counts of a generated type that has any: all arrays of a message have `count` elements,
/// except the last one if there is a `total`. The argument 0 prefers the first overload.
template <class Message, class Generated>
auto SetCount(const Message& message, Generated& wire, int) -> decltype(wire.count, void()) {
  wire.count = ArrayLength(message, false);
}
template <class Message, class Generated>
void SetCount(const Message&, Generated&, long) {}
template <class Message, class Generated>
auto SetTotal(const Message& message, Generated& wire, int) -> decltype(wire.total, void()) {
  wire.total = ArrayLength(message, true);
}
template <class Message, class Generated>
void SetTotal(const Message&, Generated&, long) {}

/// Type hash of a message of the bus without its field `session`; 0: it has no such form, because
/// it is of the edge alone, or is newer than protocol 12 and of the bus alone.
template <class Message>
constexpr std::uint64_t kHashWithoutSession = 0;
template <>
constexpr std::uint64_t kHashWithoutSession<Room> = 0x3b1556dd65c2c546;
template <>
constexpr std::uint64_t kHashWithoutSession<Inputs> = 0x61098e4e073aa192;
template <>
constexpr std::uint64_t kHashWithoutSession<States> = 0x1f0a57888e9a756c;
template <>
constexpr std::uint64_t kHashWithoutSession<Grants> = 0x67581669edb00607;
template <>
constexpr std::uint64_t kHashWithoutSession<EditOrder> = 0xb5af6cfe14504027;
template <>
constexpr std::uint64_t kHashWithoutSession<Meta> = 0x37a03ee57e14fe0e;
template <>
constexpr std::uint64_t kHashWithoutSession<View> = 0xc90a36171e1d6168;
template <>
constexpr std::uint64_t kHashWithoutSession<Impacts> = 0x84c369572c4b9199;
template <>
constexpr std::uint64_t kHashWithoutSession<Strands> = 0x4c2098e274343524;
template <>
constexpr std::uint64_t kHashWithoutSession<Stats> = 0x60f5b0e4b0054c75;
template <>
constexpr std::uint64_t kHashWithoutSession<Load> = 0xbe88264f7026f53b;
template <>
constexpr std::uint64_t kHashWithoutSession<Event> = 0x501798193aa2f237;

/// Largest encoding of a message; a Room has the longest scene on the edge alone.
template <class Message>
constexpr std::size_t kEncodedBytesMax = kBusMessageBytesMax;
template <>
constexpr std::size_t kEncodedBytesMax<Room> = kRoomBytesMax;

/// Place and size of `session` in an encoded message: after the type hash and utime.
constexpr std::ptrdiff_t kSessionFieldAt = 16, kSessionFieldBytes = 8;

/// Type hash of views without ages, up to protocol 13.
constexpr std::uint64_t kHashWithoutAges = 0x8e3b87bafb80c4b7;
/// Sizes of such a view's message: up to the number of its bodies, and of each body.
constexpr std::size_t kViewHeadBytes = 58, kViewBodyBytes = 31;
/// The bytes of an age, the last field of each body.
constexpr std::size_t kViewAgeBytes = 4;
/// Type hash of views without `unmoved`, up to protocol 17, and the bytes of that, a view's last.
constexpr std::uint64_t kHashWithoutUnmoved = 0xb8a9d0d37dae25e1;
constexpr std::size_t kViewUnmovedBytes = 2;
/// Type hash of events that are only a text, up to version 0.25.
constexpr std::uint64_t kHashWithoutKind = 0x71e7d8d436202ff5;
/// Bytes of the fields of an event after its text: kind, five ids, value.
constexpr std::size_t kEventKindBytes = 1, kEventIdsBytes = 20, kEventValueBytes = 8;

/// Bytes at a message's end that its form without a session lacks, too.
std::size_t YoungerBytes(const View& view) {
  return kViewAgeBytes * view.id.size() + kViewUnmovedBytes;
}
std::size_t YoungerBytes(const Event&) {
  return kEventKindBytes + kEventIdsBytes + kEventValueBytes;
}
template <class Message>
std::size_t YoungerBytes(const Message&) {
  return 0;
}

std::uint64_t ReadUint64(const std::uint8_t* from) {
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value = value << 8 | from[i];
  return value;
}

void WriteUint64(std::uint64_t value, std::uint8_t* to) {
  for (int i = 7; i >= 0; --i, value >>= 8) to[i] = static_cast<std::uint8_t>(value);
}

template <class Message>
Bytes EncodeAs(const Message& message) {
  SEAM_ASSERT(Valid(message));
  thread_local typename Wire<Message>::Type wire{};  // reuses memory: every field is set below
  MessageTraits<Message>::Fields(wire) = MessageTraits<Message>::Fields(message);
  SetCount(message, wire, 0);
  SetTotal(message, wire, 0);
  const int size = wire.getEncodedSize();
  SEAM_ASSERT(size > 0 && static_cast<std::size_t>(size) <= kEncodedBytesMax<Message>);
  Bytes bytes(static_cast<std::size_t>(size));
  SEAM_ASSERT(wire.encode(bytes.data(), 0, size) == size);
  if constexpr (kHashWithoutSession<Message> != 0) {
    if (message.session == 0) {
      bytes.erase(bytes.begin() + kSessionFieldAt,
                  bytes.begin() + kSessionFieldAt + kSessionFieldBytes);
      bytes.resize(bytes.size() - YoungerBytes(message));
      WriteUint64(kHashWithoutSession<Message>, bytes.data());
    }
  }
  return bytes;
}

/// Moves each element of one tuple of references into the other; arrays keep their memory.
template <class To, class From, std::size_t... i>
void MoveFields(To to, From from, std::index_sequence<i...>) {
  ((std::get<i>(to) = std::move(std::get<i>(from))), ...);
}

template <class Message>
AnyMessage DecodeAs(ByteView bytes) {
  // Not reused: an empty array is not read and would keep the previous message's elements.
  typename Wire<Message>::Type wire{};
  const int size = static_cast<int>(bytes.size);
  if (wire.decode(bytes.data, 0, size) != size) return {};
  Message message;
  const auto to = MessageTraits<Message>::Fields(message);
  const auto from = MessageTraits<Message>::Fields(wire);
  MoveFields(to, from, std::make_index_sequence<std::tuple_size_v<decltype(to)>>());
  if (!Valid(message)) return {};
  return AnyMessage(std::move(message));
}

template <class Message>
std::uint64_t WireHash() {
  return static_cast<std::uint64_t>(Wire<Message>::Type::getHash());
}

/// Puts `unmoved` of 0 behind a view's message that has none.
void AppendUnmoved(Bytes* view) { view->resize(view->size() + kViewUnmovedBytes, 0); }

/// Puts ages of 0 behind the bodies of a view's message that has none, and `unmoved`. By the size:
/// if the number of bodies that the message gives is another, it does not decode.
void AppendAges(Bytes* view) {
  const std::size_t bodies =
      (std::max(view->size(), kViewHeadBytes) - kViewHeadBytes) / kViewBodyBytes;
  view->resize(view->size() + kViewAgeBytes * bodies, 0);
  AppendUnmoved(view);
}

/// Puts kind 0, ids of -1 and value 0 behind the text of an event.
void AppendKind(Bytes* event) {
  event->resize(event->size() + kEventKindBytes, 0);
  event->resize(event->size() + kEventIdsBytes, 0xff);
  event->resize(event->size() + kEventValueBytes, 0);
}

/// Decodes a message that lacks the field `session`: puts a 0 there.
template <class Message>
AnyMessage DecodeWithoutSession(ByteView bytes) {
  if (bytes.size < static_cast<std::size_t>(kSessionFieldAt)) return {};
  thread_local Bytes whole;  // reuses memory
  whole.assign(bytes.data, bytes.data + bytes.size);
  whole.insert(whole.begin() + kSessionFieldAt, kSessionFieldBytes, 0);
  if constexpr (std::is_same_v<Message, View>) AppendAges(&whole);
  if constexpr (std::is_same_v<Message, Event>) AppendKind(&whole);
  WriteUint64(WireHash<Message>(), whole.data());
  return DecodeAs<Message>(whole);
}

/// Decodes a message with the field `session`, which is never 0: no message has two encodings.
template <class Message>
AnyMessage DecodeWithSession(ByteView bytes) {
  if (bytes.size < kSessionFieldAt + kSessionFieldBytes ||
      ReadUint64(bytes.data + kSessionFieldAt) == 0)
    return {};
  return DecodeAs<Message>(bytes);
}

/// Decodes an older form of a message, whose last fields `append` adds.
template <class Message, void (*append)(Bytes*)>
AnyMessage DecodeOlder(ByteView bytes) {
  thread_local Bytes whole;  // reuses memory
  whole.assign(bytes.data, bytes.data + bytes.size);
  append(&whole);
  WriteUint64(WireHash<Message>(), whole.data());
  return DecodeWithSession<Message>(whole);
}

struct Decoder {
  AnyMessage (*decode)(ByteView);
  bool on_bus, has_session;
  std::size_t bytes_max;
};

using Decoders = std::unordered_map<std::uint64_t, Decoder>;

template <class Message>
void AddDecoders(Decoders* decoders) {
  constexpr bool on_bus = MessageTraits<Message>::kTravels != Travels::kEdge;
  constexpr std::size_t most = kEncodedBytesMax<Message>;
  if constexpr (kHashWithoutSession<Message> != 0) {
    (*decoders)[WireHash<Message>()] = {DecodeWithSession<Message>, on_bus, true, most};
    (*decoders)[kHashWithoutSession<Message>] = {DecodeWithoutSession<Message>, on_bus, false,
                                                 most};
  } else {
    (*decoders)[WireHash<Message>()] = {DecodeAs<Message>, on_bus, on_bus, most};
  }
}

/// Finds the decoder for the type hash, the first 8 bytes; null for none.
const Decoder* FindDecoder(ByteView bytes) {
  static const Decoders decoders = [] {
    Decoders all;
#define SEAM_MESSAGE_DECODER(Struct, ...) AddDecoders<Struct>(&all);
    SEAM_MESSAGES(SEAM_MESSAGE_DECODER)
#undef SEAM_MESSAGE_DECODER
    all[kHashWithoutAges] = {DecodeOlder<View, AppendAges>, true, true, kEncodedBytesMax<View>};
    all[kHashWithoutUnmoved] = {DecodeOlder<View, AppendUnmoved>, true, true,
                                kEncodedBytesMax<View>};
    all[kHashWithoutKind] = {DecodeOlder<Event, AppendKind>, true, true, kEncodedBytesMax<Event>};
    return all;
  }();
  const auto found = decoders.find(TypeHash(bytes));
  return found == decoders.end() ? nullptr : &found->second;
}

}  // namespace

#define SEAM_MESSAGE_ENCODE(Struct, ...) \
  Bytes Encode(const Struct& m) { return EncodeAs(m); }
SEAM_MESSAGES(SEAM_MESSAGE_ENCODE)
#undef SEAM_MESSAGE_ENCODE

AnyMessage Decode(ByteView bytes) {
  const Decoder* const decoder = FindDecoder(bytes);
  if (decoder == nullptr || bytes.size > decoder->bytes_max) return {};
  try {
    return decoder->decode(bytes);
  } catch (...) {  // nothing is known to throw, but hostile bytes must not end the process
    return {};
  }
}

std::optional<std::int64_t> SessionOf(ByteView bytes) {
  const Decoder* const decoder = FindDecoder(bytes);
  if (decoder == nullptr || !decoder->on_bus) return std::nullopt;
  if (!decoder->has_session || bytes.size < kSessionFieldAt + kSessionFieldBytes) return 0;
  return static_cast<std::int64_t>(ReadUint64(bytes.data + kSessionFieldAt));
}

const std::vector<MessageType>& MessageTypes() {
#define SEAM_MESSAGE_NAME(Struct, lcm_type, ...) \
  {#lcm_type, WireHash<Struct>(),                \
   kHashWithoutSession<Struct> != 0 ? kHashWithoutSession<Struct> : WireHash<Struct>()},
  static const std::vector<MessageType> types = {SEAM_MESSAGES(SEAM_MESSAGE_NAME)};
#undef SEAM_MESSAGE_NAME
  return types;
}

std::uint64_t TypeHash(ByteView message) { return message.size < 8 ? 0 : ReadUint64(message.data); }

const MessageType* FindType(ByteView message) {
  static const auto types = [] {
    std::unordered_map<std::uint64_t, const MessageType*> all;
    for (const MessageType& type : MessageTypes()) all[type.hash] = all[type.on_edge] = &type;
    return all;
  }();
  const auto found = types.find(TypeHash(message));
  return found == types.end() ? nullptr : found->second;
}

std::vector<Fingerprint> Fingerprints() {
  std::vector<Fingerprint> all;
#define SEAM_FINGERPRINT(Type) \
  all.push_back({#Type, static_cast<std::uint64_t>(Type::getHash()), 0});
  SEAM_LCM_TYPES(SEAM_FINGERPRINT)
#undef SEAM_FINGERPRINT
#define SEAM_FINGERPRINT(Struct, lcm_type, ...)                                          \
  std::find_if(all.begin(), all.end(), [](const Fingerprint& f) {                        \
    return f.hash == WireHash<Struct>();                                                 \
  })->without_session = kHashWithoutSession<Struct>;
  SEAM_MESSAGES(SEAM_FINGERPRINT)
#undef SEAM_FINGERPRINT
  return all;
}

}  // namespace seam
