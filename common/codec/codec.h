#pragma once
/// Encodes messages as LCM bytes and decodes them; validates every byte it reads.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/bytes.h"
#include "common/codec/message_list.h"
#include "common/codec/messages.h"

namespace seam {

/// The result of Decode. std::monostate: malformed, foreign, or outside the bounds of its type.
#define SEAM_MESSAGE_TYPE(Struct, ...) , Struct
using AnyMessage = std::variant<std::monostate SEAM_MESSAGES(SEAM_MESSAGE_TYPE)>;
#undef SEAM_MESSAGE_TYPE

/// Encodes as LCM does: 8 bytes of type hash, then big-endian fields. Requires vectors of equal
/// length within the bounds of messages.h (asserted: a violation is our bug). A message whose
/// `session` is 0 is encoded without this field, under the hash of the type without it: so it is on
/// the edge, and so protocols 8 to 12 recorded it.
#define SEAM_MESSAGE_ENCODE(Struct, ...) Bytes Encode(const Struct&);
SEAM_MESSAGES(SEAM_MESSAGE_ENCODE)
#undef SEAM_MESSAGE_ENCODE

/// Decodes a message; the first 8 bytes select the type. Never throws, never allocates more than a
/// small multiple of `bytes.size`. Requires that the message fills `bytes` exactly, every float is
/// finite, ids ascend where messages.h says so, and strings are printable UTF-8 without control
/// characters (scene_text may have newlines and tabs).
AnyMessage Decode(ByteView bytes);

/// Returns the session of an encoded message of the bus without decoding it, 0 if it says none;
/// nullopt for other bytes.
std::optional<std::int64_t> SessionOf(ByteView bytes);

/// A message's LCM type: its name ("hello_t"), and the hash at the start of its bytes on the bus
/// and on the edge. They differ where the form of the bus alone has a session.
struct MessageType {
  const char* name;
  std::uint64_t hash, on_edge;
};
/// Returns all types that Decode knows.
const std::vector<MessageType>& MessageTypes();
/// Returns the hash at the start of a message, 0 for fewer than 8 bytes.
std::uint64_t TypeHash(ByteView message);
/// Finds a message's type among MessageTypes, of the bus or of the edge; null for other bytes.
const MessageType* FindType(ByteView message);

/// Returns the protocol version of a Room that Decode rejects because an older version wrote it. 0
/// unless the bytes are a Room of a recognised old version (1 to 3).
std::int32_t OldRoomProtocol(ByteView bytes);

}  // namespace seam
