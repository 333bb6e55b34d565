#pragma once
/// The LCM channels by which other programs see, drive and talk to a room: [lcm] of a scene.

#include <cstddef>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/scene/types.h"

namespace seam {

/// Most bytes of an LCM channel's name.
constexpr std::size_t kLcmChannelMax = 63;
/// Most tables of each kind, and most parts of one [[lcm.publish]].
constexpr std::size_t kLcmTablesMax = 16, kLcmPartsMax = 64;

/// [[lcm.publish]]: the poses of parts, from fixed ticks.
struct LcmPublishing {
  std::string channel;
  std::vector<PartId> parts;
  int player = -1;     ///< the player whose client publishes what it shows; -1: the server
  double rate_hz = 0;  ///< at most the scene's ticks per second
};

/// [[lcm.drive]]: the inputs of a player.
struct LcmDriving {
  std::string channel;
  int player = 0;
};

struct LcmTables {
  std::vector<LcmPublishing> publish;
  std::vector<LcmDriving> drive;
  std::vector<std::string> message;  ///< [[lcm.message]]: channels of messages for scripts
};

/// Returns one line for a channel that cannot be used: not 1 to kLcmChannelMax letters, digits or
/// _ - . /, or one of the room's or of LCM's own.
Status CheckLcmChannel(const std::string& channel);

}  // namespace seam
