#include "server/interest/interest.h"

#include <algorithm>
#include <cmath>

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
  Cells cells;
  const World& world = replica_.world();
  for (int body = 0; body < world.body_count(); ++body) {
    const Vec2 at = world.Read(body).position;
    std::vector<int>& there = cells[Key(CellOf(at.x(), side), CellOf(at.y(), side))];
    const int m = world.mechanism(body);
    if (there.empty() || there.back() != m) there.push_back(m);
  }
  return cells;
}

std::vector<int> Interest::ThingsOf(const Receiver& receiver) const {
  std::vector<int> things = held_[static_cast<std::size_t>(receiver.peer)];
  if (receiver.player < 0) return things;
  const World& world = replica_.world();
  const Composition& made = world.composition();
  for (const int m : replica_.drivers().MechanismsOf(receiver.player)) {
    for (const int assembly : made.mechanisms[static_cast<std::size_t>(m)].assemblies) {
      const int body = world.BodyOfId(made.assemblies[static_cast<std::size_t>(assembly)].id);
      if (body >= 0) things.push_back(body);
    }
  }
  return things;
}

void Interest::Note(const Receiver& receiver, int mechanism, Concern to) {
  Concern& now = concern_[static_cast<std::size_t>(mechanism) * stride_ +
                          static_cast<std::size_t>(receiver.peer)];
  now = std::max(now, to);
}

void Interest::Raise(const Receiver& receiver, const Cells& cells, float side, Concern to) {
  std::vector<std::uint64_t> centres, around;
  for (const int body : ThingsOf(receiver)) {
    const Vec2 at = replica_.world().Read(body).position;
    const std::int32_t x = CellOf(at.x(), side), y = CellOf(at.y(), side);
    if (std::find(centres.rbegin(), centres.rend(), Key(x, y)) != centres.rend()) continue;
    centres.push_back(Key(x, y));
    for (int i = 0; i < 9; ++i) around.push_back(Key(x + i % 3 - 1, y + i / 3 - 1));
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  for (const std::uint64_t key : around) {
    const auto found = cells.find(key);
    if (found == cells.end()) continue;
    for (const int m : found->second) Note(receiver, m, to);
  }
}

std::vector<Interest::Risen> Interest::Look(const std::vector<Receiver>& receivers) {
  if (small_) return {};
  const World& world = replica_.world();
  const std::size_t mechanisms = world.composition().mechanisms.size();
  const std::size_t stride_before = stride_;
  std::vector<Concern> before = std::move(concern_);
  int highest = 0;
  for (const Receiver& receiver : receivers) highest = std::max(highest, receiver.peer);
  stride_ = static_cast<std::size_t>(highest) + 1;
  concern_.assign(mechanisms * stride_, Concern::kFar);
  held_.assign(stride_, {});
  for (int body = 0; body < world.body_count(); ++body) {
    const auto holder =
        static_cast<std::size_t>(replica_.authority().at(world.mechanism(body)).authority);
    if (holder > 0 && holder < stride_) held_[holder].push_back(body);
  }
  const Cells near = CellsOf(kNearReach);
  const Cells close = config_.mode == Mode::kCentral ? CellsOf(kCloseReach) : Cells{};
  for (const Receiver& receiver : receivers) {
    if (receiver.player < 0) {
      for (std::size_t m = 0; m < mechanisms; ++m) {
        Note(receiver, static_cast<int>(m), Concern::kNear);
      }
      continue;
    }
    Raise(receiver, near, kNearReach, Concern::kNear);
    if (!close.empty()) Raise(receiver, close, kCloseReach, Concern::kClose);
  }
  std::vector<Risen> risen;
  if (before.size() != mechanisms * stride_before) return risen;
  for (const Receiver& receiver : receivers) {
    const auto p = static_cast<std::size_t>(receiver.peer);
    if (p >= stride_before) continue;
    for (std::size_t m = 0; m < mechanisms; ++m) {
      if (concern_[m * stride_ + p] > before[m * stride_before + p]) {
        risen.push_back({receiver.peer, static_cast<int>(m)});
      }
    }
  }
  return risen;
}

}  // namespace seam
