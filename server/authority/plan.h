#pragma once
/// Plan of the authority over each mechanism and of its followers, a pure function of an
/// AuthorityView. Authority follows either fixed rectangles of the scene (plan_rectangles.cpp) or
/// contact islands around the players (plan_islands.cpp).

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

/// Planned authority over one mechanism, and its planned followers.
struct PlannedAuthority {
  int authority = 0;
  PeerSet secondaries;
  bool decided = false;  ///< the server takes it as part of a contested crowd
};

/// One entry per mechanism, by index.
using AuthorityPlan = std::vector<PlannedAuthority>;

/// Planner input about one player.
struct PlayerView {
  int peer = -1;        ///< of its client; -1: no client is ready to drive it
  float one_way_s = 0;  ///< from the server to the client
  bool has_region = false;
  Vec2 region_min{0, 0}, region_max{0, 0};  ///< m
  bool silent = false;  ///< not heard from for kSilentUs: the server simulates its moving bodies
  bool untrusted = false;     ///< may have no authority; follows what it would have
  int capacity = kUnlimited;  ///< bodies that its machine can step

  static constexpr int kUnlimited = std::numeric_limits<int>::max();
  bool limited() const { return peer > 0 && capacity != kUnlimited; }
};

/// Planner input about one mechanism.
struct MechanismView {
  Vec2 position{0, 0};  ///< m, of the root
  int owner = -1;       ///< player that owns it as a vehicle; -1: none
  AuthorityRecord now;
  std::int64_t held_ticks = 0;         ///< since its authority last changed
  bool moves = true;                   ///< faster than kStandInSpeed
  bool asleep = false;                 ///< all of its bodies sleep
  int driver = -1;                     ///< player that drives it: vehicle, character, seat
  PlayerMask may_have = kEveryPlayer;  ///< players that may get its authority
  float contested = 0;   ///< recent holder's states far from the server's copy, decaying
  bool decided = false;  ///< PlannedAuthority::decided of the last plan
  bool falls = false;    ///< single body, in free fall now or a moment ago, without rotation
};

/// The complete planner input; mechanisms are given by index into `mechanisms`. Times of past
/// changes (for the dwell) are in it too, as data.
struct AuthorityView {
  const Policy* policy = &BufferPolicy(false);
  int tick_hz = 60;
  float buffer_m = 0;          ///< width of the buffer zone
  Vec2 gravity{0, 0};          ///< m/s^2
  int follow_bodies = 0;       ///< see Scene::follow_bodies
  int server_follow = 0;       ///< see Scene::server_follow; 0 if nobody needs the server's copies
  bool physics_edits = false;  ///< see ProposesEdits: the server follows everything
  /// Nobody drives and peers replay from received states: all peers should arrive at equal bits.
  bool exact = false;
  /// The server decides where owners disagree: `exact`, or it has simulated every body since the
  /// room began.
  bool settles = false;
  bool islands = false;  ///< plans by islands around the players, not by their regions
  PlannerRules rules;    ///< for islands, and the minimum time of an authority
  std::vector<PlayerView> players;
  std::vector<MechanismView> mechanisms;
  std::vector<MovingBox> boxes;  ///< of all their bodies; group: index of the mechanism
  /// Bodies left out of the view: the server's, asleep, and far from everything else
  /// (SleepingIndex).
  std::size_t left_out = 0;
  /// Mechanisms that a pending edit will join: each entry should get one common authority.
  std::vector<std::vector<int>> together;
};

/// Returns one planned entry per mechanism of the view.
///
///   Authority, by rectangles: the owner's peer if present; else the peer in whose region the root
///   of the mechanism is (it leaves the current region only kHysteresis beyond the border); else
///   the server. By islands: see PlanIslands. A client keeps an authority for rules.dwell_s at
///   least. If view.settles, the server takes over contested crowds: see DecideContested.
///   Mechanisms that are to be joined go to one peer. The server gets a mechanism if the player of
///   the chosen peer may not have it.
///   Followers (mode buffer): peers with a region or a mechanism within the scene's buffer width of
///   its boxes; peers with a mechanism that it may touch, directly or through others, before a
///   grant could reach them (ZoneSeconds); and every peer in a room of at most follow_bodies. In a
///   larger room a freely falling mechanism counts only if it may touch on its path
///   (MayMeetInFall). If eight or more peers have mechanisms of a group, and less than three
///   quarters of the group touch, indirect contacts count only within 24 m or along a chain of
///   touching bodies.
///   The server follows everything in a room of at most server_follow bodies, and in a scene where
///   physics proposes edits, which it orders as soon as it knows the inputs they depend on. Else it
///   follows all that may touch one of its own mechanisms, and moving mechanisms of silent holders.
///   Modes oracle and central: the server has everything.
AuthorityPlan PlanAuthority(const AuthorityView& view);

constexpr float kHysteresis = 2.0f;  ///< m beyond the border before a hand-over
/// Returns how far ahead to look for contacts between mechanisms of two peers, s: until the next
/// plan and the grant's arrival, plus twice the time that a state takes from one peer to the other,
/// because one state may be lost.
constexpr float ZoneSeconds(float one_way_a_s, float one_way_b_s) {
  return 0.25f + 2 * (one_way_a_s + one_way_b_s);
}
constexpr float kZoneKeep = 0.5f;  ///< s longer before a follower stops following

}  // namespace seam
