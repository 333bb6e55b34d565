#pragma once
/// Edits as messages.

#include "common/codec/messages.h"
#include "common/topology/edit.h"

namespace seam {

/// The header fields (utime, number, tick) are left as they are by default.
EditOrder ToOrder(const Edit& edit);
/// Requires a message that Decode accepted.
Edit ToEdit(const EditOrder& order);

}  // namespace seam
