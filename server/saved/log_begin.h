#pragma once
/// The room with which a log begins, as a server that goes on can load it: for a room whose
/// snapshots are lost or damaged.

#include <memory>
#include <string>

#include "common/base/status.h"
#include "server/room_state.h"

namespace seam {

/// Returns the room before tick 1 of its log. Returns nullptr, and one line in `status`, if the
/// log cannot be read or is not one that begins with tick 1: a part of it was removed, or the room
/// came from another server.
std::unique_ptr<const SavedRoom> RoomAtLogBegin(const std::string& log, const std::string& room,
                                                Status* status);

}  // namespace seam
