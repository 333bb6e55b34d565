#pragma once
/// Follows which server has a room, in a thread of its own, for a client.

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/fleet/directory.h"
#include "common/net/net.h"

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
  /// Returns the address of the room's standby as of the last look; nullopt: it has none.
  std::optional<Address> standby() const;
  /// Returns why no holder was seen yet: the directory does not answer, or nobody has the room.
  std::string trouble() const;

 private:
  void Run();

  const std::string room_;
  Directory directory_;
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable wake_;
  std::optional<FleetHolder> newest_;
  std::optional<Address> standby_;
  std::string trouble_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace seam
