#pragma once
/// Authority by contact islands around the players: who touches something has it, so that what
/// presses on each other is one peer's.
///
///        <----- keep 36 m ----->
///        <-acquire 24 m->
///   [car of p]~~>[][]            an island that p's car will touch before a grant could tell: p's
///   [car of p]       [][]        awake, within acquire of p: p's, until it is farther than keep
///   [car of p]       [][]<~~[q]  or until another player's vehicle touches it
///   [car of p][][][][car of q]   each keeps its own vehicle; the rest stays with who has it until
///                                it settles or is dense: then it is one player's

#include "server/authority/plan_ground.h"

namespace seam {

/// Sets the authority of each mechanism. An island is what touches (boxes nearer than kTouchGap);
/// what is anchored belongs to none.
///
/// A mechanism that a player drives is its driver's while that player is here. Of the rest of an
/// island: with one driver in it, the driver's; with several, see above; with none, of who will
/// touch it within its round trip, a plan and kTouchAhead (standing: kStandingAhead), with what it
/// drives or, if it sleeps, with anything else that it has (of several who has it, else who touches
/// first); else of who has most of it, within rules.keep; else, if anything of it is awake, of the
/// nearest player within rules.acquire; else the server's, and so is what sleeps, unless who has it
/// would touch it if one looked kTouchKeep farther ahead, or has fallen silent. Who is silent
/// gets nothing new, and whom an island would ask to step more than its capacity does not get it:
/// see plan_capacity.h.
void PlanIslands(const PlanGround& ground, AuthorityPlan* plan);

/// m between boxes of what touches. Resting things are up to 2 cm apart, copies a few more.
constexpr float kTouchGap = kPressGap;
/// s from a plan to the next, and s more that a touch is seen ahead: what is touched touches the
/// next, which nothing moves towards yet.
constexpr float kPlanPeriod = 0.1f, kTouchAhead = 0.4f;
/// The same for what stands.
constexpr float kStandingAhead = 0.1f;
/// s more before who has what sleeps gives it back: round trips are measured, and a vehicle that
/// stands at the edge of its reach would be given it and lose it with each of them. Normal: more
/// than round trips swing; with twice as much a vehicle would keep what lies a length away.
constexpr float kTouchKeep = 0.15f;
/// m/s; what comes faster towards a player's vehicle is seen ahead less early. Normal: all is
/// slower.
constexpr float kApproachMax = 30;
/// m/s; when all of a disputed rest is slower it settles.
constexpr float kSettles = 0.5f;
/// Contacts for each mechanism, and mechanisms, from which on a disputed rest is dense.
constexpr float kDenseContacts = 1.5f;
constexpr int kDenseCount = 4;

}  // namespace seam
