#pragma once
/// Turns messages into LCM bytes and back; distrusts every byte it reads.

#include <string>
#include <variant>

#include "common/base/bytes.h"
#include "common/codec/messages.h"

namespace seam {

/// What Decode found. std::monostate: malformed, foreign, or breaking a bound of its type.
using AnyMessage = std::variant<std::monostate, Hello, Welcome, Chunk, Room, Ping, Pong, Inputs,
                                States, Grants, EditOrder, Meta, View, Impacts, Stats, Event, Bye>;

/// LCM encoding (8 bytes of type hash, then big-endian fields). Requires vectors of equal length
/// within the bounds of messages.h (asserted: a violation is our bug).
Bytes Encode(const Hello&);
Bytes Encode(const Welcome&);
Bytes Encode(const Chunk&);
Bytes Encode(const Room&);
Bytes Encode(const Ping&);
Bytes Encode(const Pong&);
Bytes Encode(const Inputs&);
Bytes Encode(const States&);
Bytes Encode(const Grants&);
Bytes Encode(const EditOrder&);
Bytes Encode(const Meta&);
Bytes Encode(const View&);
Bytes Encode(const Impacts&);
Bytes Encode(const Stats&);
Bytes Encode(const Event&);
Bytes Encode(const Bye&);

/// Chooses the type by the hash in the first 8 bytes. Never throws, never allocates more than
/// a small multiple of `bytes.size`; demands that the message fills `bytes` exactly, that every
/// float is finite, ids ascend where messages.h says so, and strings are printable UTF-8 free
/// of control characters (scene_text may have newlines and tabs).
AnyMessage Decode(ByteView bytes);

}  // namespace seam
