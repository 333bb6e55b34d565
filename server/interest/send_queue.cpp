#include "server/interest/send_queue.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "common/codec/quanta.h"

namespace seam {
namespace {

constexpr std::int32_t kReachQuanta = kOriginReach * kQuantaPerMetre;
/// Bytes of a message besides its bodies, with the headers of link and datagram.
constexpr double kMessageCost = static_cast<double>(kStatesBytes.empty) + 30;

/// Origin of a message: all its bodies have to be near the first one.
struct Origin {
  std::int32_t x, y;

  explicit Origin(const ReceivedState& first)
      : x(first.x / kQuantaPerMetre * kQuantaPerMetre),
        y(first.y / kQuantaPerMetre * kQuantaPerMetre) {}
  bool Reaches(const ReceivedState& state) const {
    return std::abs(state.x - x) < kReachQuanta && std::abs(state.y - y) < kReachQuanta;
  }
};

PackedHeader HeaderOf(const ReceivedState& state) {
  return {state.peer, state.tick, state.revision, state.composition};
}

bool Same(const PackedHeader& a, const PackedHeader& b) {
  return a.peer == b.peer && a.tick == b.tick && a.revision == b.revision &&
         a.composition == b.composition;
}

PackedState Packed(const ReceivedState& state) {
  PackedState packed;
  packed.tick = state.tick;
  packed.epoch = state.epoch;
  packed.x = static_cast<std::uint32_t>(state.x);
  packed.y = static_cast<std::uint32_t>(state.y);
  packed.angle = state.angle;
  packed.vx = state.vx;
  packed.vy = state.vy;
  packed.spin = state.spin;
  packed.flags = state.flags;
  return packed;
}

}  // namespace

void SendQueue::Add(std::int64_t now_us, PartId id, Urgency urgency) {
  const auto i = static_cast<std::size_t>(id);
  pressing_ = pressing_ || urgency == Urgency::kFollowed;
  if (place_.size() <= i) place_.resize(i + 1, -1);
  if (place_[i] >= 0) {
    Urgency& before = waiting_[static_cast<std::size_t>(place_[i])].urgency;
    before = std::max(before, urgency);
    return;
  }
  place_[i] = static_cast<std::int32_t>(waiting_.size());
  waiting_.push_back({id, urgency, now_us});
}

void SendQueue::Fill(std::int64_t now_us) {
  const double most = std::max(kBurst * bytes_per_s_, 2.0 * kDatagramBytesMax);
  if (filled_us_ < 0) credit_ = most;
  const double passed_s = filled_us_ < 0 ? 0 : 1e-6 * static_cast<double>(now_us - filled_us_);
  filled_us_ = now_us;
  // Messages sent before the states, such as the room, delay them by no more than a burst.
  credit_ = std::min(std::max(credit_, -most) + passed_s * bytes_per_s_, most);
}

bool SendQueue::Affords(std::int64_t now_us, std::size_t bodies) {
  if (bytes_per_s_ <= 0) return true;
  Fill(now_us);
  return credit_ >= kMessageCost + each_ * static_cast<double>(bodies);
}

void SendQueue::NoteCost(std::size_t bytes, std::size_t bodies) {
  if (bodies == 0) return;
  each_ += (static_cast<double>(bytes) / static_cast<double>(bodies) - each_) / 16;
}

std::size_t SendQueue::Affordable(std::int64_t now_us) {
  Fill(now_us);
  const double bodies = (credit_ - kMessageCost) / each_;
  if (bodies >= static_cast<double>(waiting_.size())) return waiting_.size();
  if (bodies < 1 || now_us - part_us_ < kPartEveryUs) return 0;
  part_us_ = now_us;
  const auto count = static_cast<std::size_t>(bodies);
  const auto worth = [&](const Waiting& w) {
    return static_cast<std::int64_t>(w.urgency) * (now_us - w.since_us + 1000);
  };
  std::nth_element(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count),
                   waiting_.end(), [&](const Waiting& a, const Waiting& b) {
                     return std::make_pair(worth(b), a.id) < std::make_pair(worth(a), b.id);
                   });
  return count;
}

bool SendQueue::Place::operator<(const Place& o) const {
  return std::tie(peer, tick, id) < std::tie(o.peer, o.tick, o.id);
}

void SendQueue::ComposeInOrder(const NewestStates& newest) {
  bodies_.resize(order_.size());  // before any pointer into it is taken
  Origin origin{ReceivedState{}};
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const PartId id = order_[i].id;
    const ReceivedState& state = newest.at(id);
    const PackedHeader header = HeaderOf(state);
    const bool fits = !composed_.empty() && composed_.back().size() < kStatesBodiesMax &&
                      Same(composed_.back().header, header) && origin.Reaches(state);
    if (!fits) {
      origin = Origin(state);
      composed_.push_back({header, &bodies_[i], &bodies_[i]});
    }
    bodies_[i] = {static_cast<std::int32_t>(id), Packed(state)};
    ++composed_.back().end;
  }
}

const std::vector<SendQueue::Message>& SendQueue::Compose(std::int64_t now_us,
                                                          const NewestStates& newest) {
  composed_.clear();
  std::size_t count = waiting_.size();
  if (bytes_per_s_ > 0) count = Affordable(now_us);
  if (count == 0) return composed_;
  order_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const PartId id = waiting_[i].id;
    place_[static_cast<std::size_t>(id)] = -1;
    if (!newest.has(id)) continue;  // an edit has changed the body since
    const ReceivedState& state = newest.at(id);
    order_.push_back({state.peer, state.tick, id});
  }
  std::sort(order_.begin(), order_.end());
  ComposeInOrder(newest);
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
  pressing_ = false;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    pressing_ = pressing_ || waiting_[i].urgency == Urgency::kFollowed;
    place_[static_cast<std::size_t>(waiting_[i].id)] = static_cast<std::int32_t>(i);
  }
  return composed_;
}

}  // namespace seam
