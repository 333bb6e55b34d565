#pragma once
/// A server as a member of a fleet: a thread of its own talks to the directory, so that no tick
/// waits for it. It renews the lease, watches who has which room, and takes over rooms whose server
/// is gone. Without the directory the rooms go on.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/codec/messages.h"
#include "common/fleet/directory.h"
#include "server/hub/hosted_room.h"

namespace seam {

class FleetMember {
 public:
  /// Makes the plan of a room that is to go on here in this epoch; called by the thread. Throws
  /// OperatorError if it cannot.
  using Prepare = std::function<RoomPlan(const std::string& room, std::int32_t epoch)>;
  struct Config {
    std::string directory;  ///< as OpenKeyStore takes it
    std::string fleet;
    FleetServer me;
    std::string folder;  ///< of the rooms' states; "": none
    bool takes = false;  ///< takes over rooms in the folder
  };

  /// Throws OperatorError if the directory cannot be used at all. `prepare` is called only if it
  /// takes rooms.
  FleetMember(const Config& config, Prepare prepare);
  /// Leaves the directory.
  ~FleetMember();
  FleetMember(const FleetMember&) = delete;
  FleetMember& operator=(const FleetMember&) = delete;

  // Before Start and after Stop:
  /// Takes a room that begins here, in an epoch of at least `least`, which it returns. Throws
  /// OperatorError if somebody else has it, or the directory does not answer.
  std::int32_t Claim(const std::string& room, std::int32_t least);
  /// True if the directory has a room of this name, held or not.
  bool Knows(const std::string& room);
  void Start();
  void Stop();
  /// Moves a room that was given away: to the server at `to`, or of any other that has room if it
  /// is empty. Returns where it goes on; an empty address if nowhere.
  Redirect Move(const std::string& room, const std::string& to, std::int32_t epoch);
  /// The room has ended here, and is nobody's.
  void Release(const std::string& room);

  // Thread-safe:
  /// Returns the rooms that have been taken over since the last call, ready to be opened.
  std::vector<RoomPlan> TakeReady();
  /// Returns the rooms that other servers have got since, and where they are.
  std::vector<Redirect> TakeLost();
  /// Returns lines for the operator since the last call.
  std::vector<std::string> TakeReports();
  /// Gives back a room of TakeReady that could not be opened in this epoch: its state stays, and
  /// any server may take it. It is not tried here again at once.
  void GiveBack(const std::string& room, std::int32_t epoch, const std::string& why);
  /// Returns where a room is now, as far as is known; empty room: the first.
  std::optional<Redirect> Find(const std::string& room) const;
  /// True if the directory answered last.
  bool up() const { return up_; }

 private:
  void Run();
  /// Does one round: renews, reads the listing and acts on it.
  Status Round();
  Status LookAt(const FleetRoom& room);
  Status TakeHere(const FleetRoom& room, std::int32_t epoch);
  /// A room that was taken over and could not be opened here.
  struct Unopened {
    std::string room;
    std::int32_t epoch = 0;
    std::string why;
  };
  /// Holds the rooms that were given back no longer.
  Status GiveUpUnopened();
  void NoteUnopened(const Unopened& failed);
  bool IsOurs(const std::string& room) const;
  /// Returns the spec and state of the rooms here: their folder.
  std::string SpecOfRooms() const;
  void Say(const std::string& line);

  const Config config_;
  const Prepare prepare_;
  Directory directory_;
  struct Failure {
    std::int64_t again_us = 0, wait_us = 0;  // left to others until then
    std::string why;
  };
  std::map<std::string, std::int32_t> held_;     // epoch of each room that is here
  std::map<std::string, Failure> failed_;        // rooms that could not be opened here
  std::map<std::string, std::int32_t> to_give_;  // epoch of each that the directory has to give up
  std::atomic<bool> up_{true};
  std::thread thread_;
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable wake_;
  bool stop_ = false;
  FleetListing listing_;
  std::vector<RoomPlan> ready_;
  std::vector<Unopened> unopened_;
  std::vector<Redirect> lost_;
  std::vector<std::string> news_;
  std::string refused_;  // the last value that was reported
};

}  // namespace seam
