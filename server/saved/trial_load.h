#pragma once
/// Tries whether a server can continue a saved room: its bytes may be whole and still not make a
/// room.

#include "common/base/status.h"
#include "server/room_state.h"
#include "server/server.h"

namespace seam {

/// Returns the settings with which a server continues a room: its method and rates.
ServerConfig ConfigOf(const Room& room);
/// Loads the room into a server of its own that nobody hears. Returns why it cannot be continued.
/// `tick`: gets its tick, unless null.
Status CanLoad(const SavedRoom& saved, std::int64_t* tick = nullptr);

}  // namespace seam
