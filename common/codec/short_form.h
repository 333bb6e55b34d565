#pragma once
/// The form of an LCM message within a datagram: its type as one byte instead of eight, and zeros
/// left out.
///
/// Byte 0: bits 0..5 the type's place in MessageTypes, kOtherType for bytes of no such type; bit 6:
/// the rest is as it was. Else the rest is the fields and a byte 1, in words of 8 bytes, the last
/// one filled up with zeros: for each word a byte whose bit i (of value 2^i) says that byte i is
/// not 0, and those bytes ("packing" in Cap'n Proto, without its runs). The shorter of the two is
/// sent. docs/protocol.md is the reference.

#include <cstddef>

#include "common/base/bytes.h"
#include "common/base/limits.h"

namespace seam {

/// Bytes by which the short form of bytes of no type is longer.
constexpr std::size_t kShortFormExtra = 1;
constexpr std::size_t kShortFormBytesMax = kMessageBytesMax + kShortFormExtra;

/// Returns the short form of 1..kMessageBytesMax bytes, in 1..kShortFormBytesMax.
Bytes ShortForm(ByteView message);
/// Finds the message with this short form. False, with `message` undefined, for
/// bytes that are none, or of a message of more than kMessageBytesMax bytes.
bool ReadShortForm(ByteView bytes, Bytes* message);
/// Returns the place in MessageTypes of a message's type by its short form; -1 if it has none.
int TypeOfShortForm(ByteView bytes);

}  // namespace seam
