#pragma once
/// Rules that several steps of the exact solver share.

namespace seam {

/// Gap below which a limit or a contact counts as reached, m or rad.
constexpr double kReached = 1e-6;
/// A body has an impact after a fall of more steps than this; else it rests.
constexpr double kRestSteps = 4;
/// Tries with less restitution if an impact with friction would gain energy; the last has none.
constexpr int kSofterTries = 3;

}  // namespace seam
