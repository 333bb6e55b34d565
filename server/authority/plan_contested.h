#pragma once
/// Crowds of disagreeing owners: the server becomes the only authority.

#include "server/authority/plan_ground.h"

namespace seam {

/// Peers that know the same inputs compute equal bits, unless one was disconnected or away, or
/// could not go back far enough, and has simulated its bodies differently meanwhile. In a crowd
/// full of impacts such peers never converge again: each impact amplifies the difference, and
/// impacts that only one of two peers computed add energy (docs/lessons.md). So the server takes
/// such a crowd, until it sleeps or its members separate. Where somebody drives it does so only
/// if it knows as much as the owners (AuthorityView::settles).
///
/// A crowd is a group of awake mechanisms that may come into contact, directly or through others
/// (ContactGroups::soon). It is contested if several peers have members and the recent states of
/// these were far from the server's copies kContestedSum times. Newcomers to a crowd are taken with
/// it if most members are taken already.
void DecideContested(const PlanGround& ground, AuthorityPlan* plan);

/// Least sum of MechanismView::contested over a contested crowd.
constexpr float kContestedSum = 3;

}  // namespace seam
