#pragma once
/// Conversion between edits and messages.

#include "common/codec/messages.h"
#include "common/topology/edit.h"

namespace seam {

class StateArchive;

/// Returns the message of an edit; the header fields (utime, number, tick) keep their defaults.
EditOrder ToOrder(const Edit& edit);
/// Returns the edit of a message. Requires one that Decode accepted.
Edit ToEdit(const EditOrder& order);
/// Writes or reads an edit, as the bytes of its message.
void Persist(StateArchive& a, Edit* edit);

}  // namespace seam
