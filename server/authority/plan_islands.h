#pragma once
/// Authority by contact islands around the players: a player's peer gets all that the player
/// touches, so that bodies that press on each other have one authority.
///
///        <----- keep 36 m ----->
///        <-acquire 24 m->
///   [car of p]~~>[][]            p's car will touch it before a grant could arrive: p gets it
///   [car of p]       [][]        awake, within acquire: p keeps it until it is farther than keep
///   [car of p]       [][]<~~[q]  or until another player's vehicle touches it
///   [car of p][][][][car of q]   each keeps its own vehicle; the rest keeps its authority until it
///                                settles or is dense: then one player gets all of it

#include "server/authority/plan_ground.h"

namespace seam {

/// Sets the authority of each mechanism. An island is a set of touching mechanisms (boxes nearer
/// than kTouchGap); anchored parts belong to none.
///
/// A driven mechanism belongs to its driver while that player is present. The rest of an island
/// goes to the first of these that exists:
/// - its only driver; several drivers: see above;
/// - the player that will touch it within a round trip, a plan period and kTouchAhead (standing:
///   kStandingAhead), with its vehicle or, if the island sleeps, with any other mechanism it has;
///   of several the current holder, else the first to touch;
/// - the holder of most of its bodies, within rules.keep, if it is awake;
/// - the nearest player within rules.acquire, if it is awake;
/// - its holder, if it sleeps and the holder would touch it when looking kTouchKeep farther ahead,
///   or has fallen silent;
/// - the server.
/// A silent player gets nothing new. A player gets no island that exceeds its capacity: see
/// plan_capacity.h.
void PlanIslands(const PlanGround& ground, AuthorityPlan* plan);

/// m between touching boxes. Resting bodies are up to 2 cm apart, copies slightly more.
constexpr float kTouchGap = kPressGap;
/// s between plans, and additional look-ahead for contacts, s: a body that is hit will itself hit
/// the next one, which nothing approaches yet.
constexpr float kPlanPeriod = 0.1f, kTouchAhead = 0.4f;
/// Like kTouchAhead, for standing vehicles.
constexpr float kStandingAhead = 0.1f;
/// Additional look-ahead before the holder of a sleeping island gives it back, s. Measured round
/// trips vary: without a margin a vehicle at the edge of its reach would get and lose an island
/// with each of them. Normal: more than that variation; with twice as much a vehicle would keep
/// islands a length away.
constexpr float kTouchKeep = 0.15f;
/// m/s; bodies that approach a player's vehicle faster are seen less far ahead. Normal: all are
/// slower.
constexpr float kApproachMax = 30;
/// m/s; a disputed rest has settled when all of it is slower.
constexpr float kSettles = 0.5f;
/// Least contacts per mechanism, and least mechanisms, of a dense disputed rest.
constexpr float kDenseContacts = 1.5f;
constexpr int kDenseCount = 4;

}  // namespace seam
