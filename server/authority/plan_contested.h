#pragma once
/// Crowds whose owners do not agree: one owner decides them.

#include "server/authority/plan_ground.h"

namespace seam {

/// Where nobody drives anything all peers come to the same bits, unless one was cut off or away and
/// has simulated its things in its own way meanwhile. In a crowd full of blows they never agree
/// again after that: each blow makes more of a difference, and blows that only one of two had win
/// energy (docs/lessons.md). So such a crowd becomes the server's, and stays so until it sleeps or
/// is alone.
///
/// A crowd is what is awake and may come into contact, directly or through others
/// (ContactGroups::soon). It is contested when several peers have of it and their states were
/// kContestedSum times far from the server's copies of late. What comes to a crowd of which most is
/// decided goes with it.
void DecideContested(const PlanGround& ground, AuthorityPlan* plan);

/// Sum of MechanismView::contested over a crowd.
constexpr float kContestedSum = 3;

}  // namespace seam
