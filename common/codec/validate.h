#pragma once
/// The bounds of every message, asserted by Encode and enforced by Decode. The fields of a valid
/// message may be used as indices, added and subtracted without further checks.

#include <string>

#include "common/codec/message_list.h"

namespace seam {

/// Returns true for at most `bytes_max` bytes of well-formed UTF-8 (RFC 3629) without control
/// characters; `lines` allows newline, carriage return and tab.
bool IsPrintable(const std::string& text, std::size_t bytes_max, bool lines = false);

/// Returns true if every field is within the bounds of messages.h: vectors of equal length, counts,
/// peers, ticks and times in range, ids >= 0 and ascending where documented, floats finite.
#define SEAM_MESSAGE_VALID(Struct, ...) bool Valid(const Struct&);
SEAM_MESSAGES(SEAM_MESSAGE_VALID)
#undef SEAM_MESSAGE_VALID

}  // namespace seam
