/// Limits of different rooms that must fit each other: this is the lowest room that sees them all.

#include "common/sync/limits.h"

#include <climits>

#include "common/codec/messages.h"
#include "common/scene/player_mask.h"
#include "common/scene/scene_limits.h"
#include "common/scene/toml/scene_text.h"
#include "common/topology/edit.h"
#include "common/topology/topology.h"

namespace seam {

// A scene that parses fits a Room. (A Room may be larger: it is checked before anything parses it.)
static_assert(kSceneBytesMax <= kSceneTextBytesMax,
              "a scene that can be loaded could not be sent to those who join");
// Permissions have a bit for each player.
static_assert(kPeersMax <= static_cast<int>(sizeof(PlayerMask) * CHAR_BIT));
// Edits go through the wire unchanged.
static_assert(kEditTextMax == kEditTextBytesMax && kEditKindMax == kEditKindsMax);
// All parts there can ever be have ids on the wire (int16) and fit into some View.
static_assert(kPartsMax <= kPartsEver && kPartsEver <= INT16_MAX);
static_assert(kPartsEver <= kViewBodiesMax * kViewPartsMax);
// A player's number is on the wire as a peer's.
static_assert(kPlayersMax < kPeersMax);

}  // namespace seam
