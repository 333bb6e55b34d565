#pragma once
/// Who should have authority over each mechanism, and who should follow it in its buffer zone: a
/// pure function of what planning looks at. By the rectangles that the scene fixes
/// (plan_rectangles.cpp), or by contact islands around the players (plan_islands.cpp).

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/scene/planner/planner_rules.h"
#include "common/scene/player_mask.h"
#include "common/sync/authority.h"
#include "common/sync/mode.h"
#include "common/sync/reach/zones.h"

namespace seam {

/// Who should have authority over one mechanism, and who should follow it.
struct PlannedAuthority {
  int authority = 0;
  PeerSet secondaries;
  bool decided = false;  ///< the server's as part of a crowd whose owners do not agree
};

/// One entry per mechanism, by its index.
using AuthorityPlan = std::vector<PlannedAuthority>;

/// A player, as planning sees it.
struct PlayerView {
  int peer = -1;        ///< that drives it; -1: nobody is ready to
  float one_way_s = 0;  ///< from the server to it
  bool has_region = false;
  Vec2 region_min{0, 0}, region_max{0, 0};  ///< m
  bool silent = false;  ///< not heard for kSilentUs: the server simulates what moves of its own
  int capacity = kUnlimited;  ///< bodies that its machine can step

  static constexpr int kUnlimited = std::numeric_limits<int>::max();
  bool limited() const { return peer > 0 && capacity != kUnlimited; }
};

/// A mechanism, as planning sees it.
struct MechanismView {
  Vec2 position{0, 0};  ///< m, of its root
  int owner = -1;       ///< the player whose vehicle it is; -1: nobody's
  AuthorityRecord now;
  std::int64_t held_ticks = 0;         ///< since its authority changed
  bool moves = true;                   ///< fast enough that it would be missed
  bool asleep = false;                 ///< all of its bodies
  int driver = -1;                     ///< the player who drives it: vehicle, character, seat
  PlayerMask may_have = kEveryPlayer;  ///< players whose peers may have its authority
  float contested = 0;   ///< holder's states that were far from the server's copy, of late
  bool decided = false;  ///< in the last plan
  bool falls = false;    ///< one body that falls freely, or did a moment ago: it does not turn
};

/// All that planning looks at; indices of mechanisms are into `mechanisms`. The memory of when what
/// changed (dwell) is in it too, as data.
struct AuthorityView {
  Mode mode = Mode::kBuffer;
  int tick_hz = 60;
  float buffer_m = 0;          ///< width of the buffer zone
  Vec2 gravity{0, 0};          ///< m/s^2
  int follow_bodies = 0;       ///< see Scene::follow_bodies
  int server_follow = 0;       ///< see Scene::server_follow; 0 where it need not see
  bool physics_edits = false;  ///< see ProposesEdits: the server follows everything
  /// Nobody drives anything and peers go back to what they hear: all should come to the same bits.
  bool exact = false;
  bool islands = false;  ///< by islands around the players, not by their regions
  PlannerRules rules;    ///< of islands; and how long authority lasts at least
  std::vector<PlayerView> players;
  std::vector<MechanismView> mechanisms;
  std::vector<MovingBox> boxes;  ///< of all their bodies; group: the mechanism's index
  /// Bodies of the room that are left out: the server's, asleep, near nothing else (Lying).
  std::size_t left_out = 0;
  /// Mechanisms that an edit is about to join: those of each entry should be in one hand.
  std::vector<std::vector<int>> together;
};

/// One planned per mechanism of the view.
///
///   authority, by rectangles: the owner's peer if it is here; else the peer in whose region the
///   mechanism's root is (with kHysteresis before it leaves the one that has it); else the server.
///   By islands: see PlanIslands. A client's authority lasts rules.dwell_s at least.
///   Where nobody drives anything, what the owners of a crowd do not agree on is the server's: see
///   DecideContested.
///   Mechanisms that are to be joined go to one peer; a peer whose player may not have
///   a mechanism gives way to the server. Secondary (mode buffer): peers whose region, or whose
///   mechanisms, are within the scene's buffer width of its boxes, or with whose mechanisms it may
///   come into contact, directly or through others, before a grant could tell them (ZoneSeconds);
///   and all of a room of at most follow_bodies. In a larger one what falls freely only if it may
///   on its way (MayMeetOnTheirWays), and where things of eight peers may come into contact with
///   each other and less than three quarters of them touch: through others only within 24 m, or if
///   all touches on the way.
///   The server: everything in a room of at most server_follow bodies, and where physics finds
///   edits, which it orders as soon as it knows the inputs that they hang on; else what may come
///   into contact with something of its own, and what moves of a silent holder.
///   Modes oracle and central: all the server's.
AuthorityPlan PlanAuthority(const AuthorityView& view);

constexpr float kHysteresis = 2.0f;  ///< m beyond the border before a hand-over
/// How far ahead contacts between mechanisms of two peers are looked for, s: until the next plan
/// and the grant's arrival, and as long as states of one take to the other, twice, because either
/// may be lost once.
constexpr float ZoneSeconds(float one_way_a_s, float one_way_b_s) {
  return 0.25f + 2 * (one_way_a_s + one_way_b_s);
}
constexpr float kZoneKeep = 0.5f;  ///< s more before who follows ceases to

}  // namespace seam
