#include "server/authority/plan_followers.h"

#include <algorithm>
#include <cfloat>
#include <optional>
#include <tuple>
#include <utility>

#include "common/base/spatial/box_grid.h"
#include "server/authority/contact_groups.h"
#include "server/authority/crowds.h"
#include "server/authority/group_lists.h"
#include "server/authority/own_boxes.h"
#include "server/authority/player_of_peer.h"

namespace seam {
namespace {

class Followers {
 public:
  Followers(const PlanGround& ground, AuthorityPlan* plan)
      : ground_(ground),
        clusters_(ground.clusters()),
        view_(ground.view()),
        plan_(*plan),
        players_(view_),
        room_(view_.boxes.size() + view_.left_out),
        crowded_(room_ > static_cast<std::size_t>(std::max(0, view_.follow_bodies))),
        bodies_(plan->size(), 0),
        steps_(view_.players.size(), 0),
        own_(view_, *plan, players_),
        soon_crowds_(plan->size(), view_.players.size()),
        later_crowds_(plan->size(), view_.players.size()),
        distance_(plan->size(), FLT_MAX),
        seen_by_(plan->size(), -1) {
    for (const MovingBox& box : view_.boxes) ++bodies_[static_cast<std::size_t>(box.group)];
    for (std::size_t p = 0; p < steps_.size(); ++p) steps_[p] = own_.CountOf(p);
  }

  void Plan() {
    const ContactGroups contacts = FindContactGroups(ground_, plan_, crowded_);
    FollowAtServer(contacts);
    const GroupLists soon(contacts.soon);
    FollowGroups(soon, nullptr);
    FollowGroups(GroupLists(contacts.later), &soon);
    if (crowded_) grid_.emplace(clusters_.around());
    if (soon_crowds_.any() || later_crowds_.any()) {
      ways_ = FindWays(view_, plan_, players_);
      FollowTouching();
    }
    for (std::size_t p = 0; p < view_.players.size(); ++p) {
      const bool has_all = steps_[p] == static_cast<int>(view_.boxes.size()) && !limited(p);
      if (view_.players[p].peer > 0 && !has_all) FollowNear(p);
    }
  }

 private:
  PlannedAuthority& planned(int m) { return plan_[static_cast<std::size_t>(m)]; }
  const AuthorityRecord& now(int m) const {
    return view_.mechanisms[static_cast<std::size_t>(m)].now;
  }

  bool limited(std::size_t player) const {
    return view_.players[player].capacity != PlayerView::kUnlimited;
  }

  /// Makes the player's peer a follower, unless it is one already. If its capacity is limited, only
  /// queues the request for FollowWithin.
  void Follow(std::size_t player, int m) {
    const int peer = view_.players[player].peer;
    PlannedAuthority& of = planned(m);
    if (of.authority == peer || of.secondaries.Has(peer)) return;
    if (limited(player)) {
      wanted_.push_back({static_cast<int>(player), m});
      return;
    }
    of.secondaries.Add(peer);
    steps_[player] += bodies_[static_cast<std::size_t>(m)];
  }

  /// Makes the server a follower of all that may touch its own mechanisms, or of everything in a
  /// small room, where its copies are displayed to spectators. In a large room this would cost too
  /// much.
  void FollowAtServer(const ContactGroups& contacts) {
    PeerSet silent;
    for (const PlayerView& player : view_.players) {
      if (player.silent && player.peer > 0) silent.Add(player.peer);
    }
    const bool small = room_ <= static_cast<std::size_t>(view_.server_follow);
    for (std::size_t m = 0; m < plan_.size(); ++m) {
      PlannedAuthority& of = plan_[m];
      const bool follows = view_.mechanisms[m].now.secondaries.Has(0);
      const bool meets = (follows ? contacts.server_later[m] : contacts.server_soon[m]) != 0;
      const bool alone = silent.Has(of.authority) && view_.mechanisms[m].moves;
      if (of.authority != 0 && (small || view_.physics_edits || meets || alone)) {
        of.secondaries.Add(0);
      }
    }
  }

  /// Makes each holder in a group a follower of the whole group. If `soon` is given, `groups` are
  /// the wider ones, in which a peer only keeps following.
  void FollowGroups(const GroupLists& groups, const GroupLists* soon) {
    last_group_.assign(view_.players.size(), -1);
    for (std::size_t g = 0; g < groups.count(); ++g) {
      if (groups.SizeOf(g) < 2) continue;
      if (soon != nullptr && soon->SizeOf(g) == groups.SizeOf(g)) continue;  // no wider than soon
      FindHolders(groups, g);
      if (IsCrowd(groups, g)) {
        (soon == nullptr ? soon_crowds_ : later_crowds_).Note(groups, g, holders_);
        continue;
      }
      for (const int m : groups.Of(g)) {
        for (const std::size_t player : holders_) {
          const int peer = view_.players[player].peer;
          if (soon == nullptr || now(m).secondaries.Has(peer)) Follow(player, m);
        }
      }
    }
  }

  /// Makes a peer follow all that presses on its mechanisms, directly or through others, at any
  /// distance and in crowds too.
  void FollowTouching() {
    const GroupLists touching(ground_.touching().lowest);
    last_group_.assign(view_.players.size(), -1);
    for (std::size_t g = 0; g < touching.count(); ++g) {
      if (touching.SizeOf(g) < 2) continue;
      FindHolders(touching, g);
      for (const int m : touching.Of(g)) {
        for (const std::size_t player : holders_) Follow(player, m);
      }
    }
  }

  /// Finds the players planned to have a member of a group.
  void FindHolders(const GroupLists& groups, std::size_t group) {
    holders_.clear();
    for (const int m : groups.Of(group)) {
      const int has = planned(m).authority;
      const int player = has > 0 ? players_.At(has) : -1;
      if (player < 0) continue;
      int& last = last_group_[static_cast<std::size_t>(player)];
      if (last == static_cast<int>(group)) continue;
      last = static_cast<int>(group);
      holders_.push_back(static_cast<std::size_t>(player));
    }
  }

  bool IsCrowd(const GroupLists& groups, std::size_t group) {
    if (!crowded_ || holders_.size() < kManyHolders) return false;
    return !IsPacked(ground_.touching().lowest, groups.Of(group));
  }

  /// Returns the distance within which the player follows a mechanism, m.
  float ReachOf(std::size_t player, int m) const {
    const bool follows = now(m).secondaries.Has(view_.players[player].peer);
    const float reach = view_.buffer_m + (follows ? kHysteresis : 0.0f);
    if (soon_crowds_.Has(player, m) || (follows && later_crowds_.Has(player, m))) {
      return std::max(reach, CrowdReach(ways_.of[static_cast<std::size_t>(m)], player, follows));
    }
    return reach;
  }

  /// Returns that distance within a crowd, for a mechanism that may cover `way`.
  float CrowdReach(const Way& way, std::size_t player, bool follows) const {
    const Way& own = ways_.own[player];
    return follows ? std::max(kCrowdReach + kHysteresis, way.later + own.later)
                   : std::max(kCrowdReach, way.soon + own.soon);
  }

  void FollowNear(std::size_t player) {
    if (!crowded_ && !limited(player)) {
      for (int m = 0; m < static_cast<int>(plan_.size()); ++m) Follow(player, m);
      return;
    }
    if (!limited(player)) return FollowAround(player);
    Measure(player);
    FollowWithin(player);
  }

  /// Returns an upper bound of ReachOf over all mechanisms, m.
  float FarthestReach(std::size_t player) const {
    const bool any_crowd = soon_crowds_.Any(player) || later_crowds_.Any(player);
    return std::max(view_.buffer_m + kHysteresis,
                    any_crowd ? CrowdReach(ways_.farthest, player, true) : 0.0f);
  }

  /// Follows all within reach of the player's region or of one of its boxes; only in rooms that are
  /// not followed whole.
  void FollowAround(std::size_t player) {
    const int peer = view_.players[player].peer;
    const Vec2 farthest = Vec2::Constant(FarthestReach(player) + 0.1f);  // m, for rounding
    const auto follow_within = [&](const MovingBox& around, const auto& within) {
      grid_->Near(around.min - farthest, around.max + farthest, [&](int i) {
        const auto c = static_cast<std::size_t>(i);
        const int m = clusters_.GroupOf(c);
        const PlannedAuthority& of = planned(m);
        if (of.authority == peer || of.secondaries.Has(peer)) return;
        const float reach = ReachOf(player, m);
        const bool follows = clusters_.Any(c, [&](std::size_t b) {
          const MovingBox& box = view_.boxes[b];
          return Gap(box, around) <= reach && within(box, reach);
        });
        if (follows) Follow(player, m);
      });
    };
    own_.EachRun(player, 2 * farthest.x(), [&](const NearestBox& own) {
      follow_within(own.around(),
                    [&](const MovingBox& box, float reach) { return own.Within(box, reach); });
    });
    if (view_.players[player].has_region) {
      follow_within(RegionOf(player), [](const MovingBox&, float) { return true; });
    }
  }

  MovingBox RegionOf(std::size_t player) const {
    return {view_.players[player].region_min, view_.players[player].region_max, {0, 0}, 0, -1};
  }

  /// Finds the distance of each mechanism's nearest box to the region and boxes of a player of
  /// limited capacity, m. Beyond the buffer zone it is the distance to the bounding box of all of
  /// the player's boxes. In a room that is not followed whole, farther mechanisms are not found.
  void Measure(std::size_t p) {
    const float farthest = FarthestReach(p);
    const MovingBox region = RegionOf(p);
    seen_.clear();
    const auto from_own = [&](const NearestBox& own, std::size_t i) {
      const MovingBox& box = view_.boxes[i];
      const float around = own.any() ? Gap(box, own.around()) : FLT_MAX;
      See(box.group, static_cast<int>(p), around > farthest ? around : own.DistanceTo(box));
    };
    const auto from_region = [&](std::size_t i) {
      const MovingBox& box = view_.boxes[i];
      See(box.group, static_cast<int>(p), Gap(box, region));
    };
    const bool has_region = view_.players[p].has_region;
    if (!crowded_) {
      const NearestBox own = own_.Of(p);
      for (int m = 0; m < static_cast<int>(plan_.size()); ++m) See(m, static_cast<int>(p), FLT_MAX);
      for (std::size_t i = 0; i < view_.boxes.size(); ++i) {
        from_own(own, i);
        if (has_region) from_region(i);
      }
      return;
    }
    const Vec2 reach = Vec2::Constant(farthest + 0.1f);  // m, for rounding
    const auto near = [&](const MovingBox& around, const auto& visit) {
      grid_->Near(around.min - reach, around.max + reach,
                  [&](int c) { clusters_.Each(static_cast<std::size_t>(c), visit); });
    };
    own_.EachRun(p, 2 * reach.x(), [&](const NearestBox& run) {
      near(run.around(), [&](std::size_t i) { from_own(run, i); });
    });
    if (has_region) near(region, from_region);
  }

  void See(int mechanism, int player, float distance) {
    const auto m = static_cast<std::size_t>(mechanism);
    if (seen_by_[m] != player) {
      seen_by_[m] = player;
      distance_[m] = distance;
      seen_.push_back(mechanism);
    } else {
      distance_[m] = std::min(distance_[m], distance);
    }
  }

  /// Chooses the mechanisms that a peer of limited capacity follows. It follows all that it may
  /// touch, however many: otherwise both peers would compute a different impact. Then it follows
  /// its buffer zone while within capacity, and in a room that is followed whole the nearest.
  void FollowWithin(std::size_t player) {
    const int peer = view_.players[player].peer;
    within_.clear();
    for (const auto& [wants, m] : wanted_) {
      if (wants == static_cast<int>(player)) within_.push_back({0, DistanceOf(player, m), m});
    }
    for (const int m : seen_) {
      const float far = DistanceOf(player, m);
      if (far <= ReachOf(player, m)) {
        within_.push_back({soon_crowds_.Has(player, m) ? 0 : 1, far, m});
      } else if (!crowded_) {
        within_.push_back({2, far, m});
      }
    }
    std::sort(within_.begin(), within_.end());
    const int most = view_.players[player].capacity;
    for (const auto& [rank, far, m] : within_) {
      const int limit = rank == 2 ? std::min(most, view_.follow_bodies) : most;
      PlannedAuthority& of = planned(m);
      if (of.authority == peer || of.secondaries.Has(peer)) continue;
      if (rank > 0 && steps_[player] + bodies_[static_cast<std::size_t>(m)] > limit) continue;
      of.secondaries.Add(peer);
      steps_[player] += bodies_[static_cast<std::size_t>(m)];
    }
  }

  /// Returns FLT_MAX if not found by Measure for this player.
  float DistanceOf(std::size_t player, int m) const {
    const auto i = static_cast<std::size_t>(m);
    return seen_by_[i] == static_cast<int>(player) ? distance_[i] : FLT_MAX;
  }

  const PlanGround& ground_;
  const BoxClusters& clusters_;
  const AuthorityView& view_;
  AuthorityPlan& plan_;
  const PlayerOfPeer players_;
  const std::size_t room_;  // bodies
  const bool crowded_;
  std::vector<int> bodies_;  // by mechanism
  std::vector<int> steps_;   // by player: bodies that it has or follows
  const OwnBoxes own_;
  Crowds soon_crowds_, later_crowds_;
  Ways ways_;                                        // only if there are crowds
  std::vector<float> distance_;                      // by mechanism, for the player in seen_by_
  std::vector<int> seen_by_;                         // by mechanism
  std::vector<int> seen_;                            // mechanisms found by Measure
  std::optional<BoxGrid> grid_;                      // of all clusters; only if not followed whole
  std::vector<int> last_group_;                      // by player: last group that it is a holder of
  std::vector<std::size_t> holders_;                 // players
  std::vector<std::pair<int, int>> wanted_;          // player, mechanism
  std::vector<std::tuple<int, float, int>> within_;  // rank, m, mechanism
};

}  // namespace

void PlanFollowers(const PlanGround& ground, AuthorityPlan* plan) {
  Followers(ground, plan).Plan();
}

}  // namespace seam
