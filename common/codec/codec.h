#pragma once
/// Turns messages into LCM bytes and back; distrusts every byte it reads.

#include <string>
#include <variant>
#include <vector>

#include "common/base/bytes.h"
#include "common/codec/message_list.h"
#include "common/codec/messages.h"

namespace seam {

/// What Decode found. std::monostate: malformed, foreign, or breaking a bound of its type.
#define SEAM_MESSAGE_TYPE(Struct, ...) , Struct
using AnyMessage = std::variant<std::monostate SEAM_MESSAGES(SEAM_MESSAGE_TYPE)>;
#undef SEAM_MESSAGE_TYPE

/// LCM encoding (8 bytes of type hash, then big-endian fields). Requires vectors of equal length
/// within the bounds of messages.h (asserted: a violation is our bug).
#define SEAM_MESSAGE_ENCODE(Struct, ...) Bytes Encode(const Struct&);
SEAM_MESSAGES(SEAM_MESSAGE_ENCODE)
#undef SEAM_MESSAGE_ENCODE

/// Chooses the type by the hash in the first 8 bytes. Never throws, never allocates more than
/// a small multiple of `bytes.size`; demands that the message fills `bytes` exactly, that every
/// float is finite, ids ascend where messages.h says so, and strings are printable UTF-8 free
/// of control characters (scene_text may have newlines and tabs).
AnyMessage Decode(ByteView bytes);

/// A message's LCM type, by its name ("hello_t") and the hash that its bytes begin with.
struct MessageType {
  const char* name;
  std::uint64_t hash;
};
/// All that Decode knows.
const std::vector<MessageType>& MessageTypes();

/// The protocol of a Room that Decode does not accept because another version wrote it; 0 when it
/// is no Room of a version that this one knows.
std::int32_t ForeignProtocol(ByteView bytes);

}  // namespace seam
