#pragma once
/// The rooms that the flags of seam-server ask for.

#include <cstdint>
#include <string>
#include <vector>

#include "common/net/secret_file.h"
#include "server/fleet/member.h"
#include "server/hub/hosted_room.h"
#include "server/server_flags.h"

namespace seam {

/// Returns the plan of a room that goes on from the folder of --resume, the one of `index` of so
/// many rooms. `epoch`: in which it goes on; 0: in its own. Throws OperatorError if it cannot.
RoomPlan PlanOfResumed(const ServerFlags& flags, const Secret* log_key, const std::string& name,
                       int index, int rooms, std::int32_t epoch = 0);
/// Returns the plan of a room that goes on here as it was followed until now.
RoomPlan PlanOfFollowed(const ServerFlags& flags, const std::string& name, std::int32_t epoch,
                        FollowedRoom& followed);
/// Returns the plans of all rooms that begin or go on at once, claimed from `member` (nullptr: no
/// fleet). Throws OperatorError for flags that do not go together, and if a room cannot be.
/// `left_out`: a line for each room of the folder of --resume that cannot go on, while others can.
std::vector<RoomPlan> MakePlans(const ServerFlags& flags, const Secret* log_key,
                                FleetMember* member, std::vector<std::string>* left_out);

}  // namespace seam
