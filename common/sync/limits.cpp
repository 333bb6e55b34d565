/// Limits of several rooms that must fit each other; this is the lowest room that sees them all.

#include "common/sync/limits.h"

#include "common/codec/messages.h"
#include "common/scene/scene_limits.h"
#include "common/scene/toml/scene_text.h"
#include "common/topology/edit.h"
#include "common/topology/topology.h"

namespace seam {

// A scene that parses fits a Room. (A Room may be larger: it is checked before it is parsed.)
static_assert(kSceneBytesMax <= kSceneTextBytesMax,
              "a scene that can be loaded could not be sent to those who join");
// Edits go through the wire unchanged.
static_assert(kEditTextMax == kEditTextBytesMax && kEditKindMax == kEditKindsMax);
// All parts that can ever exist have ids on the wire, and all that can exist at once fit a View.
static_assert(kPartsMax <= kPartsEver && kPartsEver <= static_cast<std::size_t>(kIdsMax));
static_assert(kPartsMax <= kViewBodiesMax * kViewPartsMax);
// A peer's number is on the wire as an int16.
static_assert(kPeersMax - 1 <= INT16_MAX);

}  // namespace seam
