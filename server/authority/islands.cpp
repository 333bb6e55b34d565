#include "server/authority/islands.h"

#include <algorithm>

namespace seam {

Islands::Islands(const PlanGround& ground, const PlayerOfPeer& players)
    : driver_(ground.view().mechanisms.size(), -1), bodies_(driver_.size(), 0) {
  const AuthorityView& view = ground.view();
  for (std::size_t m = 0; m < driver_.size(); ++m) {
    const int driver = view.mechanisms[m].driver;
    if (driver >= 0 && view.players[static_cast<std::size_t>(driver)].peer > 0) driver_[m] = driver;
  }
  for (const MovingBox& box : view.boxes) ++bodies_[static_cast<std::size_t>(box.group)];
  Group(ground);
  Describe(view);
  FindHolders(view, players);
}

void Islands::Group(const PlanGround& ground) {
  const std::size_t count = ground.view().mechanisms.size();
  const std::vector<int>& lowest = ground.touching().lowest;
  islands_.reserve(count);
  island_.assign(count, -1);
  for (std::size_t m = 0; m < count; ++m) {
    const auto root = static_cast<std::size_t>(lowest[m]);  // at most m: numbered already
    if (root == m) {
      island_[m] = static_cast<int>(islands_.size());
      islands_.emplace_back();
    } else {
      island_[m] = island_[root];
    }
    ++islands_[static_cast<std::size_t>(island_[m])].members;
  }
  for (const int m : ground.touching().touched) ++Of(m).contacts;
  begin_.assign(islands_.size() + 1, 0);
  for (std::size_t i = 0; i < islands_.size(); ++i) begin_[i + 1] = begin_[i] + islands_[i].members;
  members_.resize(count);
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t m = 0; m < count; ++m) {
    int& at = next[static_cast<std::size_t>(island_[m])];
    members_[static_cast<std::size_t>(at++)] = static_cast<int>(m);
  }
}

void Islands::Describe(const AuthorityView& view) {
  for (std::size_t m = 0; m < driver_.size(); ++m) {
    Island& island = Of(static_cast<int>(m));
    if (!view.mechanisms[m].asleep) island.awake = true;
    if (driver_[m] < 0) {
      ++island.rest;
      island.rest_bodies += bodies_[m];
      continue;
    }
    if (island.driver >= 0 && island.driver != driver_[m]) island.disputed = true;
    const bool lower = island.driver < 0 || driver_[m] < island.driver;
    if (lower) island.driver = driver_[m];
  }
  for (const MovingBox& box : view.boxes) {
    if (driver(box.group) >= 0) continue;
    Island& island = Of(box.group);
    island.fastest = std::max(island.fastest, box.velocity.norm());
  }
}

void Islands::FindHolders(const AuthorityView& view, const PlayerOfPeer& players) {
  std::vector<int> has(view.players.size(), 0);  // bodies of the current island
  for (std::size_t i = 0; i < islands_.size(); ++i) {
    Island& island = islands_[i];
    if (island.members == 1) {  // the common case
      const int m = *MembersOf(static_cast<int>(i)).begin();
      const int player = players.At(view.mechanisms[static_cast<std::size_t>(m)].now.authority);
      if (player >= 0 && driver(m) < 0 && bodies(m) > 0) island.holder = player;
      continue;
    }
    const auto each = [&](const auto& visit) {
      for (const int m : MembersOf(static_cast<int>(i))) {
        const auto& now = view.mechanisms[static_cast<std::size_t>(m)].now;
        const int player = players.At(now.authority);
        if (player >= 0 && driver(m) < 0) visit(player, bodies(m));
      }
    };
    each([&](int p, int bodies) { has[static_cast<std::size_t>(p)] += bodies; });
    int most = 0;
    each([&](int p, int) {
      const int of_p = has[static_cast<std::size_t>(p)];
      if (of_p > most || (of_p == most && p < island.holder)) {
        most = of_p;
        island.holder = p;
      }
    });
    each([&](int p, int) { has[static_cast<std::size_t>(p)] = 0; });
  }
}

bool Islands::Drives(int player, const Island& island) const {
  const auto index = static_cast<int>(&island - islands_.data());
  const Members members = MembersOf(index);
  return player >= 0 &&
         std::any_of(members.begin(), members.end(), [&](int m) { return driver(m) == player; });
}

std::vector<MovingBox> Islands::VehicleBoxes(const AuthorityView& view) const {
  std::vector<MovingBox> around;
  std::vector<int> at(driver_.size(), -1);
  for (const MovingBox& box : view.boxes) {
    const auto m = static_cast<std::size_t>(box.group);
    if (driver_[m] < 0) continue;
    if (at[m] < 0) {
      at[m] = static_cast<int>(around.size());
      around.push_back(box);
    }
    MovingBox& whole = around[static_cast<std::size_t>(at[m])];
    whole.min = whole.min.cwiseMin(box.min);
    whole.max = whole.max.cwiseMax(box.max);
  }
  return around;
}

}  // namespace seam
