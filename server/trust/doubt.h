#pragma once
/// A reason not to believe a client.

#include <cstdint>

#include "common/scene/types.h"

namespace seam {

enum class DoubtKind {
  kSmall,    ///< a believed state differs from the server's copy
  kRefused,  ///< a state differs too much to be believed
  kGain,     ///< the client's own states do not follow from each other (Auditor)
  kLeftOut   ///< nothing is known to differ: other bodies' states or inputs are missing
};

struct Doubt {
  DoubtKind kind = DoubtKind::kSmall;
  int body = -1;
  std::int64_t tick = 0;
  BodyState told, expected;
  float weight = 0;  ///< see TrustLadder
  /// The server's copy rests on a guess (Replica::EditHidesPast): what it expected may be wrong.
  bool guessed = false;
};

}  // namespace seam
