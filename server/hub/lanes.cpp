#include "server/hub/lanes.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "common/base/process.h"

namespace seam {
namespace {

/// Period of the check for held lanes, us: with kSlowUs half a tick at 60 Hz.
constexpr std::int64_t kWatchUs = 3000;
/// Longest sleep of a lane, us.
constexpr std::int64_t kSleepUs = 1000000;

}  // namespace

Lanes::Lanes(const std::vector<Runnable*>& rooms, int workers)
    : workers_(static_cast<std::size_t>(std::max(1, workers))) {
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    rooms_.push_back(std::make_unique<Room>());
    rooms_.back()->what = rooms[i];
    rooms_.back()->index = static_cast<int>(i);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t l = 0; l < std::min(workers_, rooms_.size()); ++l) AddLane();
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    lanes_[i % lanes_.size()]->rooms.push_back(rooms_[i].get());
  }
  watcher_ = std::thread([this] { Watch(); });
}

Lanes::~Lanes() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    watch_.notify_all();
    for (const auto& lane : lanes_) lane->wake.notify_all();
  }
  watcher_.join();
  for (const auto& lane : lanes_) lane->thread.join();
}

/// Adds a lane and its thread. Requires the lock.
Lanes::Lane* Lanes::AddLane() {
  lanes_.push_back(std::make_unique<Lane>());
  Lane* const lane = lanes_.back().get();
  lane->thread = std::thread([this, lane] { Work(lane); });
  return lane;
}

Lanes::Room* Lanes::NextDue(const Lane& lane, std::int64_t now_us, std::int64_t* due_us) {
  Room* next = nullptr;
  *due_us = std::numeric_limits<std::int64_t>::max();
  for (Room* room : lane.rooms) {
    if (room->held) continue;
    const std::int64_t room_us = room->woken ? now_us : room->what->due_us();
    if (room_us >= *due_us) continue;
    *due_us = room_us;
    next = room;
  }
  return *due_us <= now_us ? next : nullptr;
}

void Lanes::Work(Lane* lane) {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_ && !lane->over) {
    const std::int64_t now_us = SteadyClockUs();
    std::int64_t due_us = 0;
    Room* const room = NextDue(*lane, now_us, &due_us);
    if (room == nullptr) {
      const std::int64_t wait_us = std::clamp<std::int64_t>(due_us - now_us, 0, kSleepUs);
      lane->wake.wait_for(lock, std::chrono::microseconds(wait_us));
      continue;
    }
    room->woken = false;
    lane->busy = room;
    lane->busy_since_us = now_us;
    lock.unlock();
    room->what->Run(now_us);
    lock.lock();
    lane->busy = nullptr;
    if (room->held) rests_.notify_all();
    const std::int64_t end_us = SteadyClockUs();
    if (end_us - now_us > kSlowUs) lane->slow_us = end_us;
    // The room goes to the back: a room that is always due does not starve the others.
    const auto at = std::find(lane->rooms.begin(), lane->rooms.end(), room);
    std::rotate(at, at + 1, lane->rooms.end());
  }
  lane->ended = true;
}

/// Joins and deletes finished threads. Requires the lock, which a finished thread no longer needs.
void Lanes::RemoveEnded() {
  for (auto lane = lanes_.begin(); lane != lanes_.end();) {
    if (!(*lane)->ended) {
      ++lane;
      continue;
    }
    (*lane)->thread.join();
    lane = lanes_.erase(lane);
  }
}

void Lanes::Watch() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_) {
    watch_.wait_for(lock, std::chrono::microseconds(kWatchUs));
    if (stop_) return;
    RemoveEnded();
    const std::int64_t now_us = SteadyClockUs();
    for (std::size_t l = 0; l < lanes_.size(); ++l) {
      Lane* const lane = lanes_[l].get();
      const bool held = lane->busy != nullptr && now_us - lane->busy_since_us > kSlowUs;
      if (held && lane->rooms.size() > 1) Part(now_us, lane);
      const bool calm = lane->busy == nullptr && now_us - lane->slow_us > kCalmUs;
      if (lane->slow_us > 0 && calm && lane->rooms.size() == 1) Join(lane);
    }
  }
}

/// Leaves the slow room on its thread and moves the other rooms to a new one.
void Lanes::Part(std::int64_t now_us, Lane* lane) {
  lane->slow_us = now_us;
  Room* const slow = lane->busy;
  Lane* const other = AddLane();
  for (Room* room : lane->rooms) {
    if (room != slow) other->rooms.push_back(room);
  }
  lane->rooms = {slow};
  other->wake.notify_one();
}

/// Moves the only room of a lane to the lane with the fewest rooms, if there are more lanes than
/// workers.
void Lanes::Join(Lane* lane) {
  std::size_t open = 0;
  Lane* fewest = nullptr;
  for (const auto& other : lanes_) {
    if (other->over) continue;
    ++open;
    if (other.get() == lane) continue;
    if (fewest == nullptr || other->rooms.size() < fewest->rooms.size()) fewest = other.get();
  }
  if (open <= workers_ || fewest == nullptr) return;
  fewest->rooms.push_back(lane->rooms.front());
  lane->rooms.clear();
  lane->over = true;
  lane->wake.notify_one();
  fewest->wake.notify_one();
}

void Lanes::Add(Runnable* room) {
  const std::lock_guard<std::mutex> lock(mutex_);
  rooms_.push_back(std::make_unique<Room>());
  rooms_.back()->what = room;
  rooms_.back()->index = static_cast<int>(rooms_.size()) - 1;
  std::size_t open = 0;
  Lane* fewest = nullptr;
  for (const auto& lane : lanes_) {
    if (lane->over) continue;
    ++open;
    if (fewest == nullptr || lane->rooms.size() < fewest->rooms.size()) fewest = lane.get();
  }
  if (open < workers_) fewest = AddLane();
  fewest->rooms.push_back(rooms_.back().get());
  fewest->wake.notify_one();
}

void Lanes::Wake(int room) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Room* const woken = rooms_[static_cast<std::size_t>(room)].get();
  woken->woken = true;
  for (const auto& lane : lanes_) {
    const bool here = std::find(lane->rooms.begin(), lane->rooms.end(), woken) != lane->rooms.end();
    if (here) lane->wake.notify_one();
  }
}

void Lanes::Hold(int room) {
  std::unique_lock<std::mutex> lock(mutex_);
  Room* const held = rooms_[static_cast<std::size_t>(room)].get();
  held->held = true;
  rests_.wait(lock, [&] {
    return std::none_of(lanes_.begin(), lanes_.end(),
                        [held](const auto& lane) { return lane->busy == held; });
  });
}

void Lanes::Free(int room) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    rooms_[static_cast<std::size_t>(room)]->held = false;
  }
  Wake(room);
}

int Lanes::lane_count() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<int>(
      std::count_if(lanes_.begin(), lanes_.end(), [](const auto& lane) { return !lane->over; }));
}

}  // namespace seam
