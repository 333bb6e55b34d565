#pragma once
/// Servers that nobody hears: they try whether a saved room can be continued, since its bytes may
/// be whole and still not make a room, and save a room as it begins.

#include "common/base/status.h"
#include "server/room_state.h"
#include "server/server.h"

namespace seam {

/// Returns the settings with which a server continues a room: its method and rates.
ServerConfig ConfigOf(const Room& room);
/// Loads the room into a server of its own that nobody hears. Returns why it cannot be continued.
/// `tick`: gets its tick, unless null.
Status CanLoad(const SavedRoom& saved, std::int64_t* tick = nullptr);
/// Returns the room as it is before its first tick, as RoomState::Save does. `room` has the scene's
/// text. Throws OperatorError if that is no scene.
Bytes SaveUnbegun(const Room& room);

}  // namespace seam
