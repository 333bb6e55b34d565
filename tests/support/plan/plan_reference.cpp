/// The first, slow planner: compares every player with every box, as plan.h documents.

#include "tests/support/plan/plan_reference.h"

#include <algorithm>
#include <cfloat>
#include <set>
#include <utility>

#include "server/authority/swept_boxes.h"

namespace seam {
namespace {

float DistanceToBox(const Vec2& p, const Vec2& min, const Vec2& max) {
  const Vec2 nearest = p.cwiseMax(min).cwiseMin(max);
  return (p - nearest).norm();
}

float DistanceToRegion(const Vec2& p, const PlayerView& player) {
  return DistanceToBox(p, player.region_min, player.region_max);
}

/// The player of the mechanism's holder; -1: the server, or a peer without a player.
int CurrentPlayer(const AuthorityView& view, const MechanismView& mechanism) {
  int current = -1;
  for (std::size_t p = 0; p < view.players.size(); ++p) {
    const bool has = mechanism.now.authority > 0 && view.players[p].peer == mechanism.now.authority;
    if (has) current = static_cast<int>(p);
  }
  return current;
}

/// The player in whose region the mechanism is, present or not; -1: none.
int RegionalPlayer(const AuthorityView& view, const Vec2& at, int current_player) {
  if (current_player >= 0) {
    const PlayerView& current = view.players[static_cast<std::size_t>(current_player)];
    if (current.has_region && DistanceToRegion(at, current) <= kHysteresis) return current_player;
  }
  for (std::size_t p = 0; p < view.players.size(); ++p) {
    const PlayerView& player = view.players[p];
    if (player.has_region && DistanceToRegion(at, player) <= 0) return static_cast<int>(p);
  }
  return -1;
}

int PlannedHolder(const AuthorityView& view, const MechanismView& mechanism) {
  const int current_player = CurrentPlayer(view, mechanism);
  const auto dwell_ticks = static_cast<std::int64_t>(PlannerRules{}.dwell_s * view.tick_hz);
  if (current_player >= 0 && mechanism.held_ticks < dwell_ticks) return mechanism.now.authority;
  int player = mechanism.owner;
  if (player < 0 || view.players[static_cast<std::size_t>(player)].peer < 0) {
    player = RegionalPlayer(view, mechanism.position, current_player);
  }
  const int peer = player >= 0 ? view.players[static_cast<std::size_t>(player)].peer : -1;
  return peer < 0 ? 0 : peer;
}

/// Pairs of mechanisms that may come into contact within the time of their peers and `more`
/// seconds. `by_path`: where one falls, those alone that may on their ways.
std::vector<std::pair<int, int>> ContactPairs(const AuthorityView& view, const ReferencePlan& plan,
                                              float more, bool by_path) {
  std::vector<float> one_way(plan.size(), 0);
  float longest = 0;
  for (const PlayerView& player : view.players) {
    longest = std::max(longest, player.one_way_s);
    for (std::size_t m = 0; m < plan.size(); ++m) {
      if (player.peer > 0 && plan[m].authority == player.peer) one_way[m] = player.one_way_s;
    }
  }
  const auto seconds_of = [&](int a, int b) {
    return more +
           ZoneSeconds(one_way[static_cast<std::size_t>(a)], one_way[static_cast<std::size_t>(b)]);
  };
  const FallAxis fall = FallAxisOf(view.gravity);
  if (!by_path || fall.axis < 0) {
    return MeetingGroups(view.boxes, more + ZoneSeconds(longest, longest), seconds_of);
  }
  std::set<std::pair<int, int>> pairs;
  for (const MovingBox& a : view.boxes) {
    for (const MovingBox& b : view.boxes) {
      const float seconds = seconds_of(a.group, b.group);
      const bool falls = view.mechanisms[static_cast<std::size_t>(a.group)].falls ||
                         view.mechanisms[static_cast<std::size_t>(b.group)].falls;
      const bool may = MayMeet(a, b, seconds) && (!falls || MayMeetInFall(a, b, fall, seconds));
      if (a.group < b.group && may) pairs.insert({a.group, b.group});
    }
  }
  return {pairs.begin(), pairs.end()};
}

/// By mechanism: true if it is in a group with one of the peer's.
std::vector<bool> WithThoseOf(int peer, const ReferencePlan& plan, const std::vector<int>& group) {
  std::vector<bool> has(plan.size(), false), with(plan.size(), false);
  for (std::size_t m = 0; m < plan.size(); ++m) {
    if (plan[m].authority == peer) has[static_cast<std::size_t>(group[m])] = true;
  }
  for (std::size_t m = 0; m < plan.size(); ++m) with[m] = has[static_cast<std::size_t>(group[m])];
  return with;
}

/// By mechanism: distance of its nearest box from the player's region or from a box of the peer's,
/// m. Beyond `near` only the distance from the box around all of the peer's is known.
std::vector<float> Distances(const AuthorityView& view, const PlayerView& player,
                             const ReferencePlan& plan, float near) {
  std::vector<float> nearest(plan.size(), FLT_MAX);
  std::vector<const MovingBox*> own;
  MovingBox all;
  for (const MovingBox& box : view.boxes) {
    if (plan[static_cast<std::size_t>(box.group)].authority != player.peer) continue;
    all.min = own.empty() ? box.min : all.min.cwiseMin(box.min);
    all.max = own.empty() ? box.max : all.max.cwiseMax(box.max);
    own.push_back(&box);
  }
  const MovingBox region{player.region_min, player.region_max, {0, 0}, 0, -1};
  for (const MovingBox& box : view.boxes) {
    float least = player.has_region ? Gap(box, region) : FLT_MAX;
    const float around = own.empty() ? FLT_MAX : Gap(box, all);
    if (around > near) {
      least = std::min(least, around);
    } else {
      for (std::size_t o = 0; o < own.size() && least > 0; ++o) {
        least = std::min(least, Gap(box, *own[o]));
      }
    }
    float& of_mechanism = nearest[static_cast<std::size_t>(box.group)];
    of_mechanism = std::min(of_mechanism, least);
  }
  return nearest;
}

/// By mechanism: true if it is in a pair with one of the server's.
std::vector<bool> WithServers(const ReferencePlan& plan,
                              const std::vector<std::pair<int, int>>& pairs) {
  std::vector<bool> shared(plan.size(), false);
  for (const auto& [a, b] : pairs) {
    const auto x = static_cast<std::size_t>(a), y = static_cast<std::size_t>(b);
    if (plan[x].authority == 0 || plan[y].authority == 0) shared[x] = shared[y] = true;
  }
  return shared;
}

/// Adds the server as a follower of mechanisms that may touch one of its own, or of everything if
/// the room is small: spectators of its view see its copies. In a large room it is relieved.
void FollowAtServer(const AuthorityView& view, const std::vector<std::pair<int, int>>& soon,
                    const std::vector<std::pair<int, int>>& later, ReferencePlan* plan) {
  const std::vector<bool> meets_soon = WithServers(*plan, soon);
  const std::vector<bool> meets_later = WithServers(*plan, later);
  PeerSet silent;
  for (const PlayerView& player : view.players) {
    if (player.silent && player.peer > 0) silent.Add(player.peer);
  }
  const bool small = view.boxes.size() <= static_cast<std::size_t>(view.server_follow);
  for (std::size_t m = 0; m < plan->size(); ++m) {
    ReferenceEntry& planned = (*plan)[m];
    const bool follows = view.mechanisms[m].now.secondaries.Has(0);
    const bool meets = follows ? meets_later[m] : meets_soon[m];
    const bool alone = silent.Has(planned.authority) && view.mechanisms[m].moves;
    if (planned.authority != 0 && (small || view.physics_edits || meets || alone)) {
      planned.secondaries.Add(0);
    }
  }
}

/// By mechanism, the lowest of those that it presses on, directly or through others.
std::vector<int> Pressing(const AuthorityView& view) {
  std::vector<std::pair<int, int>> pairs;
  for (const MovingBox& a : view.boxes) {
    for (const MovingBox& b : view.boxes) {
      if (a.group < b.group && Gap(a, b) <= 0.05f) pairs.emplace_back(a.group, b.group);
    }
  }
  return Components(static_cast<int>(view.mechanisms.size()), pairs);
}

/// By mechanism: true if its group is a crowd; only its nearby bodies are followed.
std::vector<bool> InCrowds(const AuthorityView& view, const ReferencePlan& plan,
                           const std::vector<int>& group) {
  std::vector<std::set<int>> holders(plan.size());
  const std::vector<int> touching = Pressing(view);
  std::vector<int> alone(plan.size(), 0), mechanisms(plan.size(), 0);
  for (std::size_t m = 0; m < plan.size(); ++m) {
    const auto g = static_cast<std::size_t>(group[m]);
    ++mechanisms[g];
    for (const PlayerView& player : view.players) {
      if (player.peer > 0 && player.peer == plan[m].authority) holders[g].insert(player.peer);
    }
  }
  for (std::size_t m = 0; m < plan.size(); ++m) {
    const bool single = std::count(touching.begin(), touching.end(), touching[m]) == 1;
    if (single) ++alone[static_cast<std::size_t>(group[m])];
  }
  const bool whole = view.boxes.size() <= static_cast<std::size_t>(view.follow_bodies);
  std::vector<bool> crowd(plan.size());
  for (std::size_t m = 0; m < plan.size(); ++m) {
    const auto g = static_cast<std::size_t>(group[m]);
    crowd[m] = !whole && holders[g].size() >= 8 && 4 * alone[g] > mechanisms[g];
  }
  return crowd;
}

/// Adds to each mechanism the peers in whose buffer zone it is.
void AddFollowers(const AuthorityView& view, ReferencePlan* plan) {
  const bool whole = view.boxes.size() <= static_cast<std::size_t>(view.follow_bodies);
  FollowAtServer(view, ContactPairs(view, *plan, 0, false),
                 ContactPairs(view, *plan, kZoneKeep, false), plan);
  const auto pairs_soon = ContactPairs(view, *plan, 0, !whole);
  const auto pairs_later = ContactPairs(view, *plan, kZoneKeep, !whole);
  // By mechanism, the lowest of those that it may come into contact with, directly or through
  // others.
  const auto count = static_cast<int>(plan->size());
  const std::vector<int> soon = Components(count, pairs_soon);
  const std::vector<int> later = Components(count, pairs_later);
  const std::vector<bool> crowd_soon = InCrowds(view, *plan, soon);
  const std::vector<bool> crowd_later = InCrowds(view, *plan, later);
  const std::vector<int> touching = Pressing(view);
  constexpr float kCrowdReach = 24;
  float longest = 0;
  for (const PlayerView& player : view.players) longest = std::max(longest, player.one_way_s);
  const auto way = [&](float seconds, auto counts) {
    float farthest = 0;
    for (const MovingBox& box : view.boxes) {
      if (!counts(box.group)) continue;
      farthest = std::max(farthest, box.velocity.norm() * seconds + kZoneSlack / 2 +
                                        box.acceleration * seconds * seconds / 2);
    }
    return farthest;
  };
  for (const PlayerView& player : view.players) {
    if (player.peer <= 0) continue;
    const auto own = [&](int m) {
      return (*plan)[static_cast<std::size_t>(m)].authority == player.peer;
    };
    const auto crowd_reach = [&](bool follows, auto counts) {
      const float seconds = ZoneSeconds(longest, longest) + (follows ? kZoneKeep : 0.0f);
      return std::max(kCrowdReach + (follows ? kHysteresis : 0.0f),
                      way(seconds, counts) + way(seconds, own));
    };
    const std::vector<bool> meets_soon = WithThoseOf(player.peer, *plan, soon);
    const std::vector<bool> meets_later = WithThoseOf(player.peer, *plan, later);
    const std::vector<bool> touches = WithThoseOf(player.peer, *plan, touching);
    bool any_crowd = false;
    for (std::size_t m = 0; m < plan->size(); ++m) {
      any_crowd =
          any_crowd || (meets_soon[m] && crowd_soon[m]) || (meets_later[m] && crowd_later[m]);
    }
    const float near = std::max(view.buffer_m + kHysteresis,
                                any_crowd ? crowd_reach(true, [](int) { return true; }) : 0.0f);
    const std::vector<float> distance = Distances(view, player, *plan, near);
    for (std::size_t m = 0; m < plan->size(); ++m) {
      ReferenceEntry& planned = (*plan)[m];
      if (planned.authority == player.peer) continue;
      const bool follows = view.mechanisms[m].now.secondaries.Has(player.peer);
      const bool meets_later_too = follows && meets_later[m];
      const bool meets = (meets_soon[m] && !crowd_soon[m]) || (meets_later_too && !crowd_later[m]);
      const bool crowd = (meets_soon[m] && crowd_soon[m]) || (meets_later_too && crowd_later[m]);
      const auto this_one = [&](int group) { return static_cast<std::size_t>(group) == m; };
      const float reach = std::max(view.buffer_m + (follows ? kHysteresis : 0.0f),
                                   crowd ? crowd_reach(follows, this_one) : 0.0f);
      if (whole || meets || touches[m] || distance[m] <= reach)
        planned.secondaries.Add(player.peer);
    }
  }
}

/// Plans mechanisms that are to be joined for the same authority.
void BringTogether(const AuthorityView& view, ReferencePlan* plan) {
  for (const std::vector<int>& mechanisms : view.together) {
    if (mechanisms.size() < 2) continue;
    // To the peer of either's owner; else to the first's holder.
    int to = (*plan)[static_cast<std::size_t>(mechanisms.front())].authority;
    for (const int m : mechanisms) {
      if (view.mechanisms[static_cast<std::size_t>(m)].owner >= 0) {
        to = (*plan)[static_cast<std::size_t>(m)].authority;
        break;
      }
    }
    for (const int m : mechanisms) {
      ReferenceEntry& planned = (*plan)[static_cast<std::size_t>(m)];
      if (planned.authority != to) planned.secondaries.Add(planned.authority);
      planned.authority = to;
      planned.secondaries.Remove(to);
    }
  }
}

/// A mechanism that its player may not have is the server's.
void Forbid(const AuthorityView& view, ReferencePlan* plan) {
  for (std::size_t m = 0; m < plan->size(); ++m) {
    ReferenceEntry& planned = (*plan)[m];
    for (std::size_t p = 0; p < view.players.size() && planned.authority > 0; ++p) {
      const bool allowed = Allows(view.mechanisms[m].may_have, static_cast<int>(p));
      if (view.players[p].peer == planned.authority && !allowed) planned.authority = 0;
    }
  }
}

}  // namespace

ReferencePlan PlanSlowly(const AuthorityView& view) {
  ReferencePlan plan(view.mechanisms.size());
  if (!view.policy->PlansAuthority()) return plan;
  for (std::size_t m = 0; m < plan.size(); ++m) {
    plan[m].authority = PlannedHolder(view, view.mechanisms[m]);
  }
  if (view.policy->PlansFollowers()) AddFollowers(view, &plan);
  BringTogether(view, &plan);
  Forbid(view, &plan);
  return plan;
}

}  // namespace seam
