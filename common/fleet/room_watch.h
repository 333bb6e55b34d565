#pragma once
/// Follows which server has a room, in a thread of its own, for a client.

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/fleet/directory.h"

namespace seam {

class RoomWatch {
 public:
  /// `room`: "": the first by name. Throws OperatorError as OpenKeyStore does.
  RoomWatch(const std::string& directory, const std::string& fleet, const std::string& room);
  ~RoomWatch();
  RoomWatch(const RoomWatch&) = delete;
  RoomWatch& operator=(const RoomWatch&) = delete;

  /// Returns the newest holder of the room; nullopt: none was seen yet.
  std::optional<FleetHolder> newest() const;
  /// True if the directory answered last.
  bool up() const { return up_; }

 private:
  void Run();

  const std::string room_;
  Directory directory_;
  std::atomic<bool> up_{true};
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable wake_;
  std::optional<FleetHolder> newest_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace seam
