#include "server/interest/send_queue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace seam {
namespace {

/// Bytes of a message besides its bodies, with the headers of link and datagram.
constexpr double kMessageCost = static_cast<double>(kStatesBytes.empty) + 30;

/// Origin of a message: all its bodies have to be near the first one.
struct Origin {
  std::int32_t x, y;

  explicit Origin(const WireBody& first)
      : x(static_cast<std::int32_t>(first.x) / kQuantaPerMetre * kQuantaPerMetre),
        y(static_cast<std::int32_t>(first.y) / kQuantaPerMetre * kQuantaPerMetre) {}
  bool Reaches(const WireBody& body) const {
    return NearOrigin(body.x, x) && NearOrigin(body.y, y);
  }
};

bool Same(const StatesHeader& a, const StatesHeader& b) {
  return a.peer == b.peer && a.tick == b.tick && a.revision == b.revision &&
         a.composition == b.composition;
}

}  // namespace

void SendQueue::Add(std::int64_t now_us, PartId id, Urgency urgency) {
  const auto i = static_cast<std::size_t>(id);
  pressing_ = pressing_ || urgency == Urgency::kFollowed;
  if (urgency == Urgency::kFollowed) NoteFollowed(1);
  if (place_.size() <= i) place_.resize(i + 1, -1);
  if (place_[i] >= 0) {
    Urgency& before = waiting_[static_cast<std::size_t>(place_[i])].urgency;
    before = std::max(before, urgency);
    return;
  }
  place_[i] = static_cast<std::int32_t>(waiting_.size());
  waiting_.push_back({id, urgency, now_us});
}

bool SendQueue::Ready(std::int64_t now_us) {
  if (bytes_per_s() <= 0) return true;
  credit_.Fill(now_us, bytes_per_s());
  return credit_.Ready();
}

std::size_t SendQueue::allowed() const {
  if (bytes_per_s() <= 0) return std::numeric_limits<std::size_t>::max();
  return static_cast<std::size_t>(std::max(0.0, credit_.bytes()));
}

float SendQueue::FollowedLoad(std::int64_t now_us) {
  if (loaded_us_ < 0) loaded_us_ = now_us;
  if (now_us - loaded_us_ < kLoadUs) return load_;
  const double carries = bytes_per_s() * static_cast<double>(now_us - loaded_us_) * 1e-6;
  load_ = full_ && carries > 0 ? static_cast<float>(followed_ / carries) : 0.0f;
  followed_ = 0;
  loaded_us_ = now_us;
  return load_;
}

bool SendQueue::Affords(std::int64_t now_us, std::size_t bodies) {
  return Ready(now_us) && (bytes_per_s() <= 0 ||
                           credit_.bytes() >= kMessageCost + each_ * static_cast<double>(bodies));
}

void SendQueue::NoteCost(std::size_t bytes, std::size_t bodies) {
  if (bodies == 0) return;
  each_ += (static_cast<double>(bytes) / static_cast<double>(bodies) - each_) / 16;
}

std::size_t SendQueue::Affordable(std::int64_t now_us) {
  const double bodies = Ready(now_us) ? (credit_.bytes() - kMessageCost) / each_ : 0;
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
  Origin origin{WireBody{}};
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const PartId id = order_[i].id;
    const WireBody& body = newest.at(id);
    const StatesHeader& header = newest.header(id);
    const bool fits = !composed_.empty() && composed_.back().size() < kStatesBodiesMax &&
                      Same(composed_.back().header, header) && origin.Reaches(body);
    if (!fits) {
      origin = Origin(body);
      composed_.push_back({header, &bodies_[i], &bodies_[i]});
    }
    bodies_[i] = body;
    ++composed_.back().end;
  }
}

const std::vector<SendQueue::Message>& SendQueue::Compose(std::int64_t now_us,
                                                          const NewestStates& newest) {
  composed_.clear();
  std::size_t count = waiting_.size();
  if (bytes_per_s() > 0) count = Affordable(now_us);
  if (count == 0) return composed_;
  order_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const PartId id = waiting_[i].id;
    place_[static_cast<std::size_t>(id)] = -1;
    if (!newest.has(id)) continue;  // an edit has changed the body since
    order_.push_back({newest.header(id).peer, newest.at(id).tick, id});
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
