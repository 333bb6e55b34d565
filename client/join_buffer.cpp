#include "client/join_buffer.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace seam {

void JoinBuffer::Add(const States& states) { Add(Message(states)); }
void JoinBuffer::Add(const Rest& rest) { Add(Message(rest)); }

void JoinBuffer::Add(Message message) {
  if (held_.size() >= room_) LetGo();
  if (held_.size() < kHeldMax) held_.push_back(std::move(message));
}

void JoinBuffer::Clear() {
  held_.clear();
  world_.clear();
  room_ = kRoomMin;
}

/// Drops outdated states. Messages of rest stay, because they are sent once. Doubles the room, so
/// that this is done seldom.
void JoinBuffer::LetGo() {
  std::map<std::int32_t, std::int64_t> newest;
  for (const Message& message : held_) {
    const auto* states = std::get_if<States>(&message);
    if (states == nullptr) continue;
    for (const std::int32_t id : states->id) {
      const auto known = newest.emplace(id, states->tick).first;
      known->second = std::max(known->second, states->tick);
    }
  }
  const auto outdated = [&](const Message& message) {
    const auto* states = std::get_if<States>(&message);
    return states != nullptr &&
           std::all_of(states->id.begin(), states->id.end(),
                       [&](std::int32_t id) { return newest.at(id) > states->tick; });
  };
  held_.erase(std::remove_if(held_.begin(), held_.end(), outdated), held_.end());
  room_ = std::min(kHeldMax, std::max(kRoomMin, 2 * held_.size()));
}

std::int64_t JoinBuffer::TickOf(const Message& message) {
  return std::visit([](const auto& of) { return std::int64_t{of.tick}; }, message);
}

bool JoinBuffer::Covers(const World& world, std::int64_t from) const {
  const auto composition = static_cast<std::int64_t>(world.composition().hash);
  std::set<int> heard;
  const auto note = [&](const auto& message) {
    if (message.composition == composition) heard.insert(message.id.begin(), message.id.end());
  };
  for (const Message& message : held_) {
    const auto* states = std::get_if<States>(&message);
    if (states == nullptr) {
      note(std::get<Rest>(message));
    } else if (states->tick >= from) {
      note(*states);
    }
  }
  for (int body = 0; body < world.body_count(); ++body) {
    if (heard.count(world.id(body)) == 0) return false;
  }
  return true;
}

std::int64_t JoinBuffer::TickOf(const World& world, std::int64_t oldest, std::int64_t now) const {
  const auto composition = static_cast<std::int64_t>(world.composition().hash);
  struct Heard {
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), newest = -1;
    bool rests = false;  // according to the newest
  };
  std::map<int, Heard> heard;
  const auto note = [&](const auto& message, bool rests) {
    if (message.composition != composition || message.tick > now) return;
    for (const std::int32_t id : message.id) {
      Heard& of = heard[id];
      of.first = std::min(of.first, message.tick);
      if (message.tick < of.newest) continue;
      of.newest = message.tick;
      of.rests = rests;
    }
  };
  for (const Message& message : held_) {
    std::visit([&](const auto& of) { note(of, std::holds_alternative<Rest>(message)); }, message);
  }
  std::int64_t tick = now, least = oldest;
  for (const auto& [id, of] : heard) {
    if (!of.rests) tick = std::min(tick, of.newest);
    least = std::max(least, of.first);
  }
  return std::min(now, std::max(tick, least));
}

/// First passes the messages up to the replica's tick, the newest first, because the replica
/// ignores older ones. A later message of rest is valid at the replica's tick, too.
void JoinBuffer::GiveTo(Replica& replica) const {
  std::vector<const Message*> all;
  for (const Message& message : held_) all.push_back(&message);
  std::stable_sort(all.begin(), all.end(), [](const Message* a, const Message* b) {
    const auto order = [](const Message& of) {
      return 2 * TickOf(of) + (std::holds_alternative<Rest>(of) ? 1 : 0);
    };
    return order(*a) < order(*b);
  });
  const auto later = std::find_if(all.begin(), all.end(), [&](const Message* message) {
    return TickOf(*message) > replica.tick();
  });
  const auto place = [&](const Message* message) {
    if (const auto* states = std::get_if<States>(message)) replica.Place(*states);
    if (const auto* rest = std::get_if<Rest>(message)) replica.Receive(*rest);
  };
  std::for_each(std::make_reverse_iterator(later), all.rend(), place);
  std::for_each(later, all.end(), place);
  replica.Begin();
  std::for_each(later, all.end(), [&](const Message* message) {
    if (const auto* states = std::get_if<States>(message)) replica.Receive(*states);
  });
}

}  // namespace seam
