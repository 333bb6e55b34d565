#pragma once
/// Tries whether a server can continue a saved room: its bytes may be whole and still not make a
/// room.

#include "common/base/status.h"
#include "server/room_state.h"

namespace seam {

/// Loads the room into a server of its own that nobody hears. Returns why it cannot be continued.
Status CanLoad(const SavedRoom& saved);

}  // namespace seam
