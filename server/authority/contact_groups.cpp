#include "server/authority/contact_groups.h"

#include <algorithm>

#include "server/authority/box_sweep.h"
#include "server/authority/player_of_peer.h"
#include "server/authority/swept_boxes.h"
#include "server/authority/unions.h"

namespace seam {
namespace {

/// Neighbours along the sweep that are compared first: in a crowd they make one group of nearly
/// all, and what is in one group already need not be compared.
constexpr std::size_t kNeighbours = 12;

/// One way, of the farthest player, s.
float LongestWay(const AuthorityView& view) {
  float longest = 0;
  for (const PlayerView& player : view.players) longest = std::max(longest, player.one_way_s);
  return longest;
}

class Look {
 public:
  Look(const AuthorityView& view, const AuthorityPlan& plan, bool by_ways)
      : view_(view),
        plan_(plan),
        fall_(by_ways ? FallAxisOf(view.gravity) : FallAxis{}),
        one_way_(plan.size(), 0),
        servers_(plan.size(), 0),
        soon_(plan.size()),
        later_(plan.size()),
        server_soon_(plan.size(), 0),
        server_later_(plan.size(), 0) {
    const PlayerOfPeer players(view);
    for (std::size_t m = 0; m < plan.size(); ++m) {
      servers_[m] = IsServers(m) ? 1 : 0;
      const int player = players.At(plan[m].authority);
      if (player >= 0) one_way_[m] = view.players[static_cast<std::size_t>(player)].one_way_s;
    }
  }

  ContactGroups Sweep() {
    // Each box grown by the way that it can make in the farthest that any pair is looked ahead:
    // all pairs that touch or may meet.
    const float longest = LongestWay(view_), seconds = kZoneKeep + ZoneSeconds(longest, longest);
    const BoxSweep sweep(view_.boxes, [seconds](const MovingBox& box) {
      return box.velocity.norm() * seconds + kZoneSlack / 2 +
             box.acceleration * seconds * seconds / 2;
    });
    const auto meet = [this](std::size_t i, std::size_t j) {
      Meet(view_.boxes[i], view_.boxes[j]);
    };
    sweep.EachNearPair(kNeighbours, meet);
    const std::vector<int> group = soon_.Lowest();
    sweep.EachPairApart(
        kNeighbours, [&](std::size_t i) { return group[GroupOf(i)]; }, meet);
    // Within a group it still matters what meets something of the server's.
    const bool any = std::find(servers_.begin(), servers_.end(), 1) != servers_.end();
    if (!any) return Groups();
    const auto unless_marked = [&](std::size_t i, std::size_t j) {
      const bool known = server_soon_[GroupOf(i)] != 0 && server_soon_[GroupOf(j)] != 0;
      if (!known) meet(i, j);
    };
    sweep.EachPairApart(
        kNeighbours, [&](std::size_t i) { return -servers_[GroupOf(i)]; }, unless_marked);
    return Groups();
  }

 private:
  ContactGroups Groups() {
    return {soon_.Lowest(), later_.Lowest(), std::move(server_soon_), std::move(server_later_)};
  }

  /// Whether the server has to see to a mechanism. Where it plans by islands what sleeps is its
  /// own, costs nothing, and becomes somebody's before it is touched.
  bool IsServers(std::size_t m) const {
    return plan_[m].authority == 0 && !(view_.islands && view_.mechanisms[m].asleep);
  }

  std::size_t GroupOf(std::size_t box) const {
    return static_cast<std::size_t>(view_.boxes[box].group);
  }

  void Meet(const MovingBox& a, const MovingBox& b) {
    if (a.group == b.group) return;
    const auto x = static_cast<std::size_t>(a.group), y = static_cast<std::size_t>(b.group);
    const bool servers = servers_[x] != 0 || servers_[y] != 0;
    const bool known = !servers || (server_soon_[x] != 0 && server_soon_[y] != 0);
    if (known && soon_.Same(a.group, b.group)) return;  // and later with it
    // As MayMeet, for both times.
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
    if (!OnTheirWays(a, b, later)) return;
    later_.Unite(a.group, b.group);
    if (may_soon && OnTheirWays(a, b, soon)) soon_.Unite(a.group, b.group);
  }

  bool OnTheirWays(const MovingBox& a, const MovingBox& b, float seconds) const {
    return (!Falls(a) && !Falls(b)) || MayMeetOnTheirWays(a, b, fall_, seconds);
  }
  bool Falls(const MovingBox& box) const {
    return fall_.axis >= 0 && view_.mechanisms[static_cast<std::size_t>(box.group)].falls;
  }

  const AuthorityView& view_;
  const AuthorityPlan& plan_;
  const FallAxis fall_;         // none: as MayMeet says
  std::vector<float> one_way_;  // by mechanism: to who is planned to have it
  std::vector<int> servers_;    // by mechanism: 1 where the server has to see to it
  Unions soon_, later_;
  std::vector<char> server_soon_, server_later_;
};

}  // namespace

ContactGroups FindContactGroups(const AuthorityView& view, const AuthorityPlan& plan,
                                bool by_ways) {
  return Look(view, plan, by_ways).Sweep();
}

}  // namespace seam
