#pragma once
/// The bounds of every message: what Encode promises and Decode demands.
/// What Valid accepts may be indexed, added and subtracted without a further look.

#include <string>

#include "common/codec/message_list.h"

namespace seam {

/// At most `bytes_max` bytes of well-formed UTF-8 (RFC 3629) without control characters;
/// `lines` allows newline, carriage return and tab.
bool IsPrintable(const std::string& text, std::size_t bytes_max, bool lines = false);

/// True when every field is within the bounds of messages.h: vectors of equal length, counts,
/// peers, ticks and times in range, ids >= 0 and ascending where documented, floats finite.
#define SEAM_MESSAGE_VALID(Struct, ...) bool Valid(const Struct&);
SEAM_MESSAGES(SEAM_MESSAGE_VALID)
#undef SEAM_MESSAGE_VALID

}  // namespace seam
