#include "common/fleet/room_watch.h"

#include <chrono>

namespace seam {
namespace {

/// Time between two looks, ms.
constexpr int kRoomLookMs = 250;

}  // namespace

RoomWatch::RoomWatch(const std::string& directory, const std::string& fleet,
                     const std::string& room)
    : room_(room), directory_(OpenKeyStore(directory), fleet) {
  thread_ = std::thread([this] { Run(); });
}

RoomWatch::~RoomWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    wake_.notify_all();
  }
  thread_.join();
}

void RoomWatch::Run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_) {
    lock.unlock();
    FleetListing listing;
    const Status status = directory_.List(&listing);
    lock.lock();
    trouble_ = !status.ok() ? status.why()
                            : "no server has " + (room_.empty() ? "a room" : "the room " + room_);
    for (const FleetRoom& room : listing.rooms) {
      if (!room.holder || (room.name != room_ && !room_.empty())) continue;
      newest_ = room.holder;
      Address at;
      standby_.reset();
      if (room.standby && ReadAddress(room.standby->address, &at)) standby_ = at;
      break;
    }
    wake_.wait_for(lock, std::chrono::milliseconds(kRoomLookMs), [this] { return stop_; });
  }
}

std::string RoomWatch::trouble() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return trouble_;
}

std::optional<FleetHolder> RoomWatch::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return newest_;
}

std::optional<Address> RoomWatch::standby() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return standby_;
}

}  // namespace seam
