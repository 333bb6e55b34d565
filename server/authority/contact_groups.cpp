#include "server/authority/contact_groups.h"

#include <algorithm>

#include "server/authority/player_of_peer.h"
#include "server/authority/unions.h"

namespace seam {
namespace {

class Look {
 public:
  Look(const AuthorityView& view, const AuthorityPlan& plan)
      : view_(view),
        plan_(plan),
        one_way_(plan.size(), 0),
        soon_(plan.size()),
        later_(plan.size()),
        server_soon_(plan.size(), 0),
        server_later_(plan.size(), 0) {
    const PlayerOfPeer players(view);
    for (std::size_t m = 0; m < plan.size(); ++m) {
      const int player = players.At(plan[m].authority);
      if (player >= 0) one_way_[m] = view.players[static_cast<std::size_t>(player)].one_way_s;
    }
  }

  ContactGroups Sweep(const BoxSweep& sweep) {
    sweep.EachPair([this](std::size_t i, std::size_t j) { Meet(view_.boxes[i], view_.boxes[j]); });
    return {soon_.Lowest(), later_.Lowest(), std::move(server_soon_), std::move(server_later_)};
  }

 private:
  /// Whether the server has to see to a mechanism. Where it plans by islands what sleeps is its
  /// own, costs nothing, and becomes somebody's before it is touched.
  bool IsServers(std::size_t m) const {
    return plan_[m].authority == 0 && !(view_.islands && view_.mechanisms[m].asleep);
  }

  void Meet(const MovingBox& a, const MovingBox& b) {
    if (a.group == b.group) return;
    const auto x = static_cast<std::size_t>(a.group), y = static_cast<std::size_t>(b.group);
    const bool servers = IsServers(x) || IsServers(y);
    const bool known = !servers || (server_soon_[x] != 0 && server_soon_[y] != 0);
    if (known && soon_.Same(a.group, b.group)) return;  // and later with it
    const float seconds = ZoneSeconds(one_way_[x], one_way_[y]);
    if (!MayMeet(a, b, kZoneKeep + seconds)) return;
    later_.Unite(a.group, b.group);
    if (servers) server_later_[x] = server_later_[y] = 1;
    if (!MayMeet(a, b, seconds)) return;
    soon_.Unite(a.group, b.group);
    if (servers) server_soon_[x] = server_soon_[y] = 1;
  }

  const AuthorityView& view_;
  const AuthorityPlan& plan_;
  std::vector<float> one_way_;  // by mechanism: to who is planned to have it
  Unions soon_, later_;
  std::vector<char> server_soon_, server_later_;
};

}  // namespace

ContactGroups FindContactGroups(const AuthorityView& view, const AuthorityPlan& plan,
                                const Nearby& nearby) {
  return Look(view, plan).Sweep(nearby.meeting);
}

}  // namespace seam
