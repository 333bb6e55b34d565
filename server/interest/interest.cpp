#include "server/interest/interest.h"

#include <algorithm>
#include <cmath>

#include "common/scene/planner/planner_rules.h"

namespace seam {
namespace {

std::uint64_t Key(std::int32_t x, std::int32_t y) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
         static_cast<std::uint32_t>(y);
}

std::int32_t CellOf(float coordinate, float side) {
  return static_cast<std::int32_t>(std::floor(coordinate / side));
}

}  // namespace

Interest::Interest(const Scene& scene, const SyncConfig& config, const Replica& replica)
    : scene_(scene), config_(config), replica_(replica) {
  Remap();
}

void Interest::Remap() {
  concern_.clear();
  small_ = replica_.world().body_count() <= scene_.follow_bodies;
}

Interest::Cells Interest::CellsOf(float side) const {
  const World& world = replica_.world();
  std::vector<std::pair<std::uint64_t, int>> all;  // cell, mechanism
  all.reserve(static_cast<std::size_t>(world.body_count()));
  for (int body = 0; body < world.body_count(); ++body) {
    const Vec2 at = world.Read(body).position;
    all.emplace_back(Key(CellOf(at.x(), side), CellOf(at.y(), side)), world.mechanism(body));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  Cells cells;
  cells.mechanisms.reserve(all.size());
  for (const auto& [key, mechanism] : all) {
    if (cells.keys.empty() || cells.keys.back() != key) {
      cells.keys.push_back(key);
      cells.begin.push_back(static_cast<int>(cells.mechanisms.size()));
    }
    cells.mechanisms.push_back(mechanism);
  }
  cells.begin.push_back(static_cast<int>(cells.mechanisms.size()));
  return cells;
}

void Interest::FindThings(const Receiver& receiver) {
  things_ = held_[static_cast<std::size_t>(receiver.peer)];
  if (receiver.player < 0) return;
  const World& world = replica_.world();
  const Composition& made = world.composition();
  for (const int m : replica_.drivers().MechanismsOf(receiver.player)) {
    for (const int assembly : made.mechanisms[static_cast<std::size_t>(m)].assemblies) {
      const int body = world.BodyOfId(made.assemblies[static_cast<std::size_t>(assembly)].id);
      if (body >= 0) things_.push_back(body);
    }
  }
}

void Interest::Note(const Receiver& receiver, int mechanism, Concern to) {
  const auto peer = static_cast<std::size_t>(receiver.peer);
  const auto m = static_cast<std::size_t>(mechanism);
  Concern& now = concern_[peer * stride_ + m];
  if (now == Concern::kNone) {
    noted_[peer].push_back(mechanism);
    hearing_[m].push_back(receiver.peer);
  }
  now = std::max(now, to);
}

void Interest::Raise(const Receiver& receiver, const Cells& cells, float side, Concern to) {
  centres_.clear();
  around_.clear();
  for (const int body : things_) {
    const Vec2 at = replica_.world().Read(body).position;
    const std::int32_t x = CellOf(at.x(), side), y = CellOf(at.y(), side);
    if (std::find(centres_.rbegin(), centres_.rend(), Key(x, y)) != centres_.rend()) continue;
    centres_.push_back(Key(x, y));
    for (int i = 0; i < 9; ++i) around_.push_back(Key(x + i % 3 - 1, y + i / 3 - 1));
  }
  std::sort(around_.begin(), around_.end());
  around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
  for (const std::uint64_t key : around_) {
    const auto found = std::lower_bound(cells.keys.begin(), cells.keys.end(), key);
    if (found == cells.keys.end() || *found != key) continue;
    const auto cell = static_cast<std::size_t>(found - cells.keys.begin());
    for (int i = cells.begin[cell]; i < cells.begin[cell + 1]; ++i) {
      Note(receiver, cells.mechanisms[static_cast<std::size_t>(i)], to);
    }
  }
}

/// Makes room for a Look; only what was noted is wiped.
void Interest::Begin(std::size_t peers, std::size_t mechanisms) {
  before_.swap(concern_);
  noted_before_.swap(noted_);
  looked_before_.swap(looked_);
  noted_.resize(peers);
  if (stride_ == mechanisms && concern_.size() == mechanisms * peers) {
    for (std::size_t p = 0; p < peers; ++p) {
      Concern* row = &concern_[p * mechanisms];
      for (const int m : noted_[p]) row[m] = Concern::kNone;
    }
  } else {
    concern_.assign(mechanisms * peers, Concern::kNone);
  }
  if (stride_ != mechanisms) before_.clear();
  stride_ = mechanisms;
  for (std::vector<int>& noted : noted_) noted.clear();
  looked_.assign(peers, 0);
  held_.resize(peers);
  for (std::vector<int>& held : held_) held.clear();
  hearing_.resize(mechanisms);
  for (std::vector<int>& hearing : hearing_) hearing.clear();
}

void Interest::FindRisen(const Receiver& receiver, std::vector<Risen>* risen) const {
  const auto peer = static_cast<std::size_t>(receiver.peer), row = peer * stride_;
  if (before_.empty()) return;
  const bool known = peer < looked_before_.size() && looked_before_[peer] != 0;
  for (const int m : noted_[peer]) {
    const std::size_t at = row + static_cast<std::size_t>(m);
    if (!known || concern_[at] > before_[at]) risen->push_back({receiver.peer, m});
  }
}

std::vector<Interest::Risen> Interest::Look(const std::vector<Receiver>& receivers) {
  if (small_) return {};
  const World& world = replica_.world();
  int highest = 0;
  for (const Receiver& receiver : receivers) highest = std::max(highest, receiver.peer);
  const std::size_t peers = static_cast<std::size_t>(highest) + 1;
  const int mechanisms = static_cast<int>(world.composition().mechanisms.size());
  Begin(peers, static_cast<std::size_t>(mechanisms));
  for (int body = 0; body < world.body_count(); ++body) {
    const auto holder =
        static_cast<std::size_t>(replica_.authority().at(world.mechanism(body)).authority);
    if (holder > 0 && holder < peers) held_[holder].push_back(body);
  }
  const bool central = config_.mode == Mode::kCentral;
  const float hear = scene_.planner->hear;
  const Cells far = CellsOf(hear), near = CellsOf(kNearReach);
  const Cells close = central ? CellsOf(kCloseReach) : Cells{};
  std::vector<Risen> risen;
  for (const Receiver& receiver : receivers) {
    looked_[static_cast<std::size_t>(receiver.peer)] = 1;
    if (receiver.player < 0) {
      for (int m = 0; m < mechanisms; ++m) Note(receiver, m, Concern::kNear);
    } else {
      FindThings(receiver);
      // Who has nothing at all may look anywhere.
      for (int m = 0; things_.empty() && m < mechanisms; ++m) Note(receiver, m, Concern::kFar);
      Raise(receiver, far, hear, Concern::kFar);
      Raise(receiver, near, kNearReach, Concern::kNear);
      if (central) Raise(receiver, close, kCloseReach, Concern::kClose);
    }
    FindRisen(receiver, &risen);
  }
  return risen;
}

}  // namespace seam
