#pragma once
/// Joins a Hub and a FleetMember: the parts of seam-server that only a fleet has.

#include <string>

#include "common/net/net.h"
#include "server/fleet/member.h"
#include "server/hub/hub.h"
#include "server/server_flags.h"

namespace seam {

/// Throws OperatorError for flags that do not go together.
void CheckFleetFlags(const ServerFlags& flags);
/// Makes the folder of --resume for a server that only waits for rooms.
void PrepareFolders(const ServerFlags& flags);
/// Returns the member for a server that listens on `local`.
FleetMember::Config MemberOf(const ServerFlags& flags, const Address& local);
/// Opens the rooms that were taken over, stops those that others have, and prints the news.
void FollowFleet(FleetMember& member, Hub& hub);
/// Ends the rooms here, and sends their clients to --drain-to. `member`: nullptr: no directory.
void DrainRooms(const ServerFlags& flags, FleetMember* member, Hub& hub);

}  // namespace seam
