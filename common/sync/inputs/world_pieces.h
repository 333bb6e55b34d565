#pragma once
/// The world that a joining client begins with where peers send inputs alone, as bytes in a row of
/// Chunk messages: the length, then the compressed bytes of Replica::Persist.

#include <optional>
#include <vector>

#include "common/base/bytes.h"
#include "common/codec/messages.h"

namespace seam {

/// Returns the messages; empty if the world is too long for them.
std::vector<Chunk> ToWorldPieces(ByteView world, std::int64_t now_us);
/// True if these bytes of the messages, in a row, are all.
bool IsWholeWorld(const Bytes& received);
/// Returns the world; nullopt if the bytes are damaged.
std::optional<Bytes> WorldOf(const Bytes& received);

}  // namespace seam
