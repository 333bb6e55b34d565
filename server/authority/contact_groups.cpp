#include "server/authority/contact_groups.h"

#include <algorithm>

#include "common/base/disjoint_sets.h"
#include "server/authority/box_sweep.h"
#include "server/authority/crowds.h"
#include "server/authority/player_of_peer.h"
#include "server/authority/swept_boxes.h"

namespace seam {
namespace {

/// Neighbours along the sweep that are compared first. In a crowd these pairs already unite nearly
/// everything, and pairs within one group need no comparison.
constexpr std::size_t kNeighbours = 32;

/// Returns the one-way delay of the farthest player, s.
float LongestWay(const AuthorityView& view) {
  float longest = 0;
  for (const PlayerView& player : view.players) longest = std::max(longest, player.one_way_s);
  return longest;
}

class Look {
 public:
  Look(const PlanGround& ground, const AuthorityPlan& plan, bool by_path)
      : view_(ground.view()),
        clusters_(ground.clusters()),
        plan_(plan),
        fall_(by_path ? FallAxisOf(view_.gravity) : FallAxis{}),
        one_way_(plan.size(), 0),
        servers_(plan.size(), 0),
        soon_(plan.size()),
        later_(plan.size()),
        server_soon_(plan.size(), 0),
        server_later_(plan.size(), 0) {
    const PlayerOfPeer players(view_);
    for (std::size_t m = 0; m < plan.size(); ++m) {
      servers_[m] = NeedsServer(m) ? 1 : 0;
      const int player = players.At(plan[m].authority);
      if (player >= 0) one_way_[m] = view_.players[static_cast<std::size_t>(player)].one_way_s;
    }
  }

  ContactGroups Sweep() {
    // Grows each box by the distance it may cover in the longest look-ahead of any pair: the sweep
    // then finds all pairs that touch or may meet.
    const float longest = LongestWay(view_), seconds = kZoneKeep + ZoneSeconds(longest, longest);
    const BoxSweep sweep(clusters_.around(), [this, seconds](std::size_t c) {
      float way = 0;
      clusters_.Each(c,
                     [&](std::size_t i) { way = std::max(way, WayOf(view_.boxes[i], seconds)); });
      return way;
    });
    const auto meet = [this](std::size_t a, std::size_t b) { MeetAny(a, b); };
    if (!sweep.EachNearPair(kNeighbours, meet)) return Groups();
    const std::vector<int> group = soon_.Lowest();
    sweep.EachPairApart(
        kNeighbours, [&](std::size_t c) { return group[GroupOf(c)]; }, meet);
    // Within a group, contacts with mechanisms of the server still have to be marked.
    const bool any = std::find(servers_.begin(), servers_.end(), 1) != servers_.end();
    if (!any) return Groups();
    const auto unless_marked = [&](std::size_t a, std::size_t b) {
      const bool known = server_soon_[GroupOf(a)] != 0 && server_soon_[GroupOf(b)] != 0;
      if (!known) meet(a, b);
    };
    sweep.EachPairApart(
        kNeighbours, [&](std::size_t c) { return -servers_[GroupOf(c)]; }, unless_marked);
    return Groups();
  }

 private:
  ContactGroups Groups() {
    return {soon_.Lowest(), later_.Lowest(), std::move(server_soon_), std::move(server_later_)};
  }

  /// True if the server has to simulate the mechanism. When planning by islands, a sleeping one
  /// does not count: it costs nothing, and a player gets it before anything touches it.
  bool NeedsServer(std::size_t m) const {
    return plan_[m].authority == 0 && !(view_.islands && view_.mechanisms[m].asleep);
  }

  std::size_t GroupOf(std::size_t cluster) const {
    return static_cast<std::size_t>(clusters_.GroupOf(cluster));
  }

  /// Compares the boxes of two clusters until the result for their groups is known.
  void MeetAny(std::size_t a, std::size_t b) {
    const std::size_t x = GroupOf(a), y = GroupOf(b);
    if (x == y) return;
    const bool servers = servers_[x] != 0 || servers_[y] != 0;
    for (std::size_t i = clusters_.begin(a); i < clusters_.end(a); ++i) {
      for (std::size_t j = clusters_.begin(b); j < clusters_.end(b); ++j) {
        const bool known = !servers || (server_soon_[x] != 0 && server_soon_[y] != 0);
        if (known && soon_.Same(static_cast<int>(x), static_cast<int>(y))) return;  // implies later
        Meet(view_.boxes[i], view_.boxes[j], servers);
      }
    }
  }

  /// `servers`: one of them is the server's.
  void Meet(const MovingBox& a, const MovingBox& b, bool servers) {
    const auto x = static_cast<std::size_t>(a.group), y = static_cast<std::size_t>(b.group);
    // The condition of MayMeet, for both look-aheads.
    const float gap = Gap(a, b), speed = (a.velocity - b.velocity).norm();
    const float acceleration = a.acceleration + b.acceleration;
    const auto within = [&](float seconds) {
      return gap <= speed * seconds + (kZoneSlack + acceleration * seconds * seconds / 2);
    };
    const float soon = ZoneSeconds(one_way_[x], one_way_[y]), later = kZoneKeep + soon;
    if (!within(later)) return;
    const bool may_soon = within(soon);
    if (servers) {
      server_later_[x] = server_later_[y] = 1;
      if (may_soon) server_soon_[x] = server_soon_[y] = 1;
    }
    if (!OnTheirPaths(a, b, later)) return;
    later_.Unite(a.group, b.group);
    if (may_soon && OnTheirPaths(a, b, soon)) soon_.Unite(a.group, b.group);
  }

  bool OnTheirPaths(const MovingBox& a, const MovingBox& b, float seconds) const {
    return (!Falls(a) && !Falls(b)) || MayMeetInFall(a, b, fall_, seconds);
  }
  bool Falls(const MovingBox& box) const {
    return fall_.axis >= 0 && view_.mechanisms[static_cast<std::size_t>(box.group)].falls;
  }

  const AuthorityView& view_;
  const BoxClusters& clusters_;
  const AuthorityPlan& plan_;
  const FallAxis fall_;         // no axis: only MayMeet counts
  std::vector<float> one_way_;  // by mechanism: delay of its planned authority, s
  std::vector<int> servers_;    // by mechanism: 1 if the server has to simulate it
  DisjointSets soon_, later_;
  std::vector<char> server_soon_, server_later_;
};

}  // namespace

ContactGroups FindContactGroups(const PlanGround& ground, const AuthorityPlan& plan, bool by_path) {
  return Look(ground, plan, by_path).Sweep();
}

}  // namespace seam
