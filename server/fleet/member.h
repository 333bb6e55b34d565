#pragma once
/// A server as a member of a fleet: a thread of its own talks to the directory, so that no tick
/// waits for it. It renews the lease, watches who has which room, takes over rooms whose server is
/// gone, and stands by for others (StandbyWatch). Without the directory the rooms go on.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/fleet/directory.h"
#include "server/fleet/standby_watch.h"
#include "server/hub/hosted_room.h"

namespace seam {

/// A join to a room that is not here, of a client that has proved its address.
struct FleetJoin {
  std::string room;  ///< "": the first
  std::string name;
  std::uint64_t place_key = 0;
  std::int32_t epoch = 0;     ///< of the room that the client was in
  bool epoch_proved = false;  ///< by a server of this fleet
};

/// Returns the redirect to a room's holder.
Redirect RedirectTo(const std::string& room, const FleetHolder& holder);

class FleetMember {
 public:
  /// Makes the plan of a room that is to go on here in this epoch; called by the thread.
  /// `followed`: the room, if this server has followed it; nullptr: its state is read. Throws
  /// OperatorError if it cannot.
  using Prepare = std::function<RoomPlan(const std::string& room, std::int32_t epoch,
                                         std::unique_ptr<FollowedRoom> followed)>;
  struct Config {
    std::string directory;  ///< as OpenKeyStore takes it
    std::string fleet;
    FleetServer me;
    std::string folder;  ///< of the rooms' states; "": none
    bool takes = false;  ///< takes over rooms in the folder, and stands by for them
    bool warm = false;   ///< follows the rooms for which it stands by
    std::shared_ptr<const Secret> log_key;  ///< of their logs; null: none
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
  /// Takes several likewise; returns the epoch of each.
  std::vector<std::int32_t> ClaimAll(const std::vector<std::string>& rooms, std::int32_t least);
  /// True if the directory has a room of this name, held or not.
  bool Knows(const std::string& room);
  void Start();
  void Stop();
  /// Lets others take the rooms that are here: their standbys, or the server at `to`, which becomes
  /// their standby; "": any. Takes none any more. Thread-safe.
  void Drain(const std::string& to);
  /// True while others may still do so. Thread-safe.
  bool drains() const { return drains_; }
  /// Moves a room that was given away: to the server at `to`, or of any other that has room if it
  /// is empty. Returns where it goes on: at another server that has taken it meanwhile, in a higher
  /// epoch, too; an empty address if nowhere.
  Redirect Move(const std::string& room, const std::string& to, std::int32_t epoch);
  /// The room has ended here, and is nobody's.
  void Release(const std::string& room);

  // Thread-safe:
  /// Returns a room that has been taken over, ready to be opened, if there is one: to open it takes
  /// a while, in which others knock.
  std::vector<RoomPlan> TakeReady();
  /// Returns the rooms that other servers have got since, and where they are.
  std::vector<Redirect> TakeLost();
  /// Returns rooms that are held here and have got a standby since: its address.
  std::vector<std::pair<std::string, std::string>> TakeStandbys();
  /// Returns lines for the operator since the last call.
  std::vector<std::string> TakeReports();
  /// Gives back a room of TakeReady that could not be opened in this epoch: its state stays, and
  /// any server may take it. It is not tried here again at once.
  void GiveBack(const std::string& room, std::int32_t epoch, const std::string& why);
  /// Answers a join to a room that is not here, as Hub::Elsewhere: by where it is, as far as is
  /// known; empty room: the first. At the room's standby the join may be a knock.
  std::optional<Redirect> Find(const FleetJoin& join);
  /// Returns the rooms for which this server stands by; see StandbyWatch::Behind.
  std::map<std::string, std::int64_t> StandsBy() const;
  /// True if the directory answered last.
  bool up() const { return up_; }

 private:
  void Run();
  /// Does one round: renews, reads the listing and acts on it.
  Status Round();
  Status LookAt(const FleetRoom& room);
  Status TakeHere(const FleetRoom& room, std::int32_t epoch,
                  std::unique_ptr<FollowedRoom> followed);
  /// Takes the rooms that are due from their holders.
  Status TakeDue();
  Status TakeFrom(StandbyWatch::Due due);
  /// Renews the lease, and writes the changes of this server.
  Status Renew();
  /// While it drains: appoints the standbys, and sees whether there are any.
  Status FollowDrain(const FleetListing& listing);
  bool takes() const { return config_.takes && !draining_; }
  /// Becomes the standby of a room of another server that has none.
  Status StandBy(const FleetRoom& room);
  /// A room that was taken over and could not be opened here.
  struct Unopened {
    std::string room;
    std::int32_t epoch = 0;
    std::string why;
  };
  /// Holds the rooms that were given back no longer.
  Status GiveUpUnopened();
  void NoteUnopened(const Unopened& failed);
  /// Keeps the lease while the thread does not run, and holds a room again if it had ended.
  Status KeepHeld(const std::string& room, std::int32_t epoch);
  /// Says why a room could not be claimed.
  std::string WhyNotClaimed(const std::string& room);
  bool IsOurs(const std::string& room) const;
  bool IsAnothers(const FleetRoom& room) const;
  /// Looks at the directory soon: the room of a join may be on its way here. Requires the lock.
  void LookSoon();
  /// Returns the spec and state of the rooms here: their folder.
  std::string SpecOfRooms() const;
  void NoteStandbys(const FleetListing& listing);
  void Say(const std::string& line);

  const Config config_;
  const Prepare prepare_;
  Directory directory_;
  struct Failure {
    std::int64_t again_us = 0, wait_us = 0;  // left to others until then
    std::string why;
  };
  std::map<std::string, std::int32_t> held_;     // epoch of each room that is here
  std::map<std::string, std::int32_t> coming_;   // the same of each that its holder still runs
  std::map<std::string, Failure> failed_;        // rooms that could not be opened here
  std::map<std::string, std::int32_t> to_give_;  // epoch of each that the directory has to give up
  std::map<std::string, std::string> guards_;    // address of the standby of each room that is here
  std::map<std::string, std::int64_t> unguarded_us_;  // since when a room has no standby
  std::int64_t renewed_us_ = INT64_MIN / 2;
  std::size_t left_ = 0;      // rooms that were here at the last look
  std::int64_t gone_us_ = 0;  // when one of them went, while it drains
  std::atomic<bool> draining_{false}, drains_{false};
  std::atomic<bool> up_{true};
  std::thread thread_;
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable wake_;
  bool stop_ = false, due_ = false;
  std::string drain_to_;
  std::int64_t round_us_ = 0;  // end of the last round
  FleetListing listing_;
  std::vector<RoomPlan> ready_;
  std::vector<Unopened> unopened_;
  std::vector<Redirect> lost_;
  std::vector<std::pair<std::string, std::string>> standbys_;  // not taken yet
  std::vector<std::string> news_;
  std::string refused_;  // the last value that was reported
  std::unique_ptr<StandbyWatch> watch_;  // null: it takes no rooms, or does not run
};

}  // namespace seam
