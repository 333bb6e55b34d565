#include "server/interest/interest.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/scene/mechanism_ids.h"
#include "common/scene/planner/planner_rules.h"

namespace seam {
namespace {

std::uint64_t Key(std::int32_t x, std::int32_t y) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
         static_cast<std::uint32_t>(y);
}

/// Sorts in the same order as Key.
std::uint32_t ShortKey(std::int32_t x, std::int32_t y) {
  return static_cast<std::uint32_t>(x) << 16 | static_cast<std::uint16_t>(y);
}

/// Returns the Key of the same cell.
std::uint64_t KeyOf(std::uint32_t short_key) {
  return Key(static_cast<std::int16_t>(short_key >> 16), static_cast<std::int16_t>(short_key));
}

/// Hash slots: several cells share one, so a cell may count as wanted because of another.
constexpr std::size_t kSlots = 1 << 15;
std::size_t Slot(std::uint32_t short_key) { return (short_key * 0x9e3779b1u) >> 17; }

/// Returns the cell of a coordinate. Positions beyond the 16-bit range, hundreds of km away, are
/// clamped to its outermost cells.
std::int32_t CellOf(float coordinate, float side) {
  constexpr float kLow = -32768, kHigh = 32767;  // of 16 bits
  return static_cast<std::int32_t>(std::clamp(std::floor(coordinate / side), kLow, kHigh));
}

}  // namespace

Interest::Interest(const Scene& scene, const SyncConfig& config, const Replica& replica)
    : scene_(scene),
      config_(config),
      replica_(replica),
      hearing_(replica.table(), MechanismRule::kScratch),
      receivers_near_(replica.table(), MechanismRule::kScratch),
      place_of_(replica.table(), BodyRule::kScratch),
      edited_(replica.table(), [this](const BodyRemap&) { Start(); }) {
  Start();
}

void Interest::Start() {
  relevance_.clear();
  const World& world = replica_.world();
  by_mechanism_.clear();
  for (int body = 0; body < world.body_count(); ++body) {
    by_mechanism_.emplace_back(world.mechanism(body), body);
  }
  std::sort(by_mechanism_.begin(), by_mechanism_.end());
  int place = 0;
  for (const auto& [mechanism, body] : by_mechanism_) place_of_[body] = place++;
  all_moved_ = true;
  small_ = world.body_count() <= scene_.follow_bodies;
}

void Interest::Want(const Receiver& receiver, float side, Cells* cells) {
  FindReceiverBodies(receiver);
  std::uint64_t last = 0;
  bool any = false;
  for (const int body : receiver_bodies_) {
    const Vec2 at = replica_.world().Read(body).position;
    const std::int32_t x = CellOf(at.x(), side), y = CellOf(at.y(), side);
    if (any && last == Key(x, y)) continue;
    any = true;
    last = Key(x, y);
    for (int i = 0; i < 9; ++i) {
      cells->wanted[Slot(ShortKey(x + i % 3 - 1, y + i / 3 - 1))] = 1;
    }
  }
}

void Interest::FindMoved() {
  const World& world = replica_.world();
  moved_.clear();
  if (!all_moved_ && world.ChangedSince(change_, &moved_)) {
    moved_.insert(moved_.end(), world.present().begin(), world.present().end());
  } else {
    moved_.resize(by_mechanism_.size());
    std::iota(moved_.begin(), moved_.end(), 0);
  }
  all_moved_ = false;
  change_ = world.last_change();
}

void Interest::FindCells(float side, const std::vector<Receiver>& receivers, Cells* cells) {
  const World& world = replica_.world();
  const std::size_t count = by_mechanism_.size();
  // Only wanted cells are sorted: the rest of the room is mostly asleep.
  cells->wanted.assign(kSlots, 0);
  for (const Receiver& receiver : receivers) {
    if (receiver.player >= 0) Want(receiver, side, cells);
  }
  cells->places.resize(count);
  for (const int body : moved_) {
    const Vec2 at = world.Read(body).position;
    cells->places[static_cast<std::size_t>(place_of_[body])] =
        ShortKey(CellOf(at.x(), side), CellOf(at.y(), side));
  }
  order_.clear();
  // Ordered by x, then y, then mechanism: the sort is stable.
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t key = cells->places[i];
    if (cells->wanted[Slot(key)] != 0) order_.push_back(SortKey{key} << 32 | i);
  }
  SortByKey(&order_, &spare_);
  cells->keys.clear();
  cells->begin.clear();
  cells->mechanisms.clear();
  for (const SortKey sorted : order_) {
    const auto i = static_cast<std::size_t>(sorted & 0xffffffffu);
    const std::uint64_t key = KeyOf(static_cast<std::uint32_t>(sorted >> 32));
    const int mechanism = by_mechanism_[i].first;
    if (cells->keys.empty() || cells->keys.back() != key) {
      cells->keys.push_back(key);
      cells->begin.push_back(static_cast<int>(cells->mechanisms.size()));
    } else if (cells->mechanisms.back() == mechanism) {
      continue;
    }
    cells->mechanisms.push_back(mechanism);
  }
  cells->begin.push_back(static_cast<int>(cells->mechanisms.size()));
}

void Interest::FindReceiverBodies(const Receiver& receiver) {
  receiver_bodies_ = held_[static_cast<std::size_t>(receiver.peer)];
  if (receiver.player < 0) return;
  const World& world = replica_.world();
  for (const int m : replica_.drivers().MechanismsOf(receiver.player)) {
    EachIdOf(world.composition(), m, [&](PartId id) {
      const int body = world.BodyOfId(id);
      if (body >= 0) receiver_bodies_.push_back(body);
    });
  }
}

void Interest::Note(const Receiver& receiver, const int* begin, const int* end, Relevance to) {
  const auto peer = static_cast<std::size_t>(receiver.peer);
  Relevance* const row = &relevance_[peer * stride_];
  std::vector<int>& noted = noted_[peer];
  for (; begin != end; ++begin) {
    Relevance& now = row[*begin];
    if (now >= to) continue;
    if (now == Relevance::kNone) {
      noted.push_back(*begin);
      hearing_[*begin].push_back(receiver.peer);
    }
    if (now < Relevance::kNear && to >= Relevance::kNear) {
      receivers_near_[*begin].push_back(receiver.peer);
    }
    now = to;
  }
}

void Interest::NoteAll(const Receiver& receiver, Relevance to) {
  for (int m = 0; m < static_cast<int>(stride_); ++m) Note(receiver, &m, &m + 1, to);
}

void Interest::Raise(const Receiver& receiver, const Cells& cells, float side, Relevance to) {
  centres_.clear();
  around_.clear();
  for (const int body : receiver_bodies_) {
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
    const int* const all = cells.mechanisms.data();
    Note(receiver, all + cells.begin[cell], all + cells.begin[cell + 1], to);
  }
}

/// Prepares the tables for a Look; clears only entries that were set.
void Interest::Begin(std::size_t peers, std::size_t mechanisms) {
  before_.swap(relevance_);
  noted_before_.swap(noted_);
  looked_before_.swap(looked_);
  noted_.resize(peers);
  if (stride_ == mechanisms && relevance_.size() == mechanisms * peers) {
    for (std::size_t p = 0; p < peers; ++p) {
      Relevance* row = &relevance_[p * mechanisms];
      for (const int m : noted_[p]) row[m] = Relevance::kNone;
    }
  } else {
    relevance_.assign(mechanisms * peers, Relevance::kNone);
  }
  if (stride_ != mechanisms) before_.clear();
  stride_ = mechanisms;
  for (std::vector<int>& noted : noted_) noted.clear();
  looked_.assign(peers, 0);
  held_.resize(peers);
  for (std::vector<int>& held : held_) held.clear();
  for (std::vector<int>& hearing : hearing_) hearing.clear();
  for (std::vector<int>& hearing : receivers_near_) hearing.clear();
}

void Interest::FindRisen(const Receiver& receiver, std::vector<Risen>* risen) const {
  const auto peer = static_cast<std::size_t>(receiver.peer), row = peer * stride_;
  if (before_.empty()) return;
  const bool known = peer < looked_before_.size() && looked_before_[peer] != 0;
  for (const int m : noted_[peer]) {
    const std::size_t at = row + static_cast<std::size_t>(m);
    if (!known || relevance_[at] > before_[at]) risen->push_back({receiver.peer, m});
  }
}

std::vector<Interest::Risen> Interest::Look(const std::vector<Receiver>& receivers) {
  if (small_) return {};
  const World& world = replica_.world();
  int highest = 0;
  for (const Receiver& receiver : receivers) highest = std::max(highest, receiver.peer);
  const std::size_t peers = static_cast<std::size_t>(highest) + 1;
  Begin(peers, world.composition().mechanisms.size());
  for (int body = 0; body < world.body_count(); ++body) {
    const auto holder =
        static_cast<std::size_t>(replica_.authority().at(world.mechanism(body)).authority);
    if (holder > 0 && holder < peers) held_[holder].push_back(body);
  }
  const bool central = config_.policy->simulators() == Policy::Simulators::kNear;
  const float hear = scene_.planner->hear;
  FindMoved();
  FindCells(hear, receivers, &far_);
  FindCells(kNearReach, receivers, &near_);
  if (central) FindCells(kCloseReach, receivers, &close_);
  std::vector<Risen> risen;
  for (const Receiver& receiver : receivers) {
    looked_[static_cast<std::size_t>(receiver.peer)] = 1;
    if (receiver.player < 0) {
      NoteAll(receiver, Relevance::kNear);
    } else {
      FindReceiverBodies(receiver);
      // A client without any body may look anywhere.
      if (receiver_bodies_.empty()) NoteAll(receiver, Relevance::kFar);
      Raise(receiver, far_, hear, Relevance::kFar);
      Raise(receiver, near_, kNearReach, Relevance::kNear);
      if (central) Raise(receiver, close_, kCloseReach, Relevance::kClose);
    }
    FindRisen(receiver, &risen);
  }
  return risen;
}

}  // namespace seam
