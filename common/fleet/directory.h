#pragma once
/// The directory of a fleet: which servers there are, which of them has a room, and in which epoch.
///
///   /seam/FLEET/servers/ID       {address, version, protocol, capacity, used, draining}   leased
///   /seam/FLEET/rooms/R/epoch    a number that only grows                                 stays
///   /seam/FLEET/rooms/R/spec     of the room, for a server that takes it over             stays
///   /seam/FLEET/rooms/R/state    where its saved state is                                 stays
///   /seam/FLEET/rooms/R/holder   {server, address, epoch}                                 leased
///   /seam/FLEET/rooms/R/standby  {server, address} of the next holder, if this one dies   leased
///
/// Each change is one transaction, so that an epoch is never given twice. Nothing that is read is
/// trusted: FleetListing has only values that are as they should be.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/random.h"
#include "common/base/status.h"
#include "common/fleet/key_store.h"

namespace seam {

/// Time after which a server that does not renew is gone, with the rooms that it holds, s.
constexpr int kFleetLeaseS = 5;
/// Most bytes of a value, and most entries of a listing that are read.
constexpr std::size_t kFleetValueBytesMax = 65536, kFleetEntriesMax = 200000;

struct FleetServer {
  std::string id;       ///< 1 to 32 of [A-Za-z0-9_-]
  std::string address;  ///< under which clients reach it, as ToString(Address)
  std::string version;
  std::int32_t protocol = 0;
  std::int32_t capacity = 0, used = 0;  ///< rooms
  bool draining = false;
  std::int64_t lease = 0;  ///< in a listing
};

struct FleetHolder {
  std::string server, address;
  std::int32_t epoch = 0;
};

/// The server that takes a room over at once when its holder dies: at which its clients knock.
struct FleetStandby {
  std::string server, address;
};

struct FleetRoom {
  std::string name;
  std::int32_t epoch = 0;          ///< the last that was given; 0: none
  std::int64_t epoch_changed = 0;  ///< KeyValue::changed of it
  std::optional<FleetHolder> holder;
  std::int64_t holder_changed = 0;  ///< KeyValue::changed of it; 0: none
  std::optional<FleetStandby> standby;
  std::string spec, state;
};

struct FleetListing {
  std::vector<FleetServer> servers;  ///< by id
  std::vector<FleetRoom> rooms;      ///< by name
  std::string refused;               ///< one line about the first value that was ignored; "": none

  const FleetRoom* FindRoom(const std::string& name) const;
  const FleetServer* FindServer(const std::string& id) const;
};

/// Reads the keys below `prefix` ("/seam/FLEET/").
FleetListing ReadListing(const std::string& prefix, const std::vector<KeyValue>& keys);

/// Returns the emptier of two servers drawn from those of this protocol that are not draining, have
/// room and are not `but`; nullptr: there is none.
const FleetServer* PlaceRoom(const std::vector<FleetServer>& servers, std::int32_t protocol,
                             const std::string& but, Random& random);

class Directory {
 public:
  /// `fleet`: 1 to 32 of [A-Za-z0-9_-].
  Directory(std::unique_ptr<KeyStore> store, const std::string& fleet);

  Status List(FleetListing* listing);
  /// Waits until the listing is another than that of the last Watch or List, at most `wait_ms`.
  Status Watch(int wait_ms, FleetListing* listing);

  // For a server. Each of the following needs Register before.
  /// Puts the server into the directory, with a new lease if it has none. An error if a server of
  /// this id is there at another address.
  Status Register(const FleetServer& me);
  /// Keeps the lease. `kept` false: it has ended, and everything that went with it; Register again.
  Status Renew(bool* kept);
  /// Renews likewise, unless that was done within the last kRenewUs.
  Status RenewIfDue(bool* kept);
  /// Takes a room that nobody holds: for a new one, with its spec. `epoch`: the next, at least
  /// `least`; 0: somebody else has it or was faster.
  Status Claim(const std::string& room, const std::string& spec, std::int32_t least,
               std::int32_t* epoch);
  /// Takes rooms likewise and notes their state, unless it is empty: in transactions of as many as
  /// the store takes, between which the lease is kept. `epochs`: one of each; 0 from the first
  /// transaction on that was not done.
  Status ClaimAll(const std::vector<std::string>& rooms, const std::string& spec,
                  const std::string& state, std::int32_t least, std::vector<std::int32_t>* epochs);
  /// Takes a room that has a spec and no holder any more; else as Claim.
  Status TakeOver(const std::string& room, std::int32_t least, std::int32_t* epoch);
  /// Becomes the standby of a room that another server holds and that has none. `done` false: it
  /// has one, or is not held by another as `room` was read.
  Status StandBy(const FleetRoom& room, bool* done);
  /// Makes another server the standby of a room that is held here, in place of any other.
  Status Appoint(const std::string& room, std::int32_t epoch, const FleetServer& standby);
  /// Is no longer the standby, if it is.
  Status StandDown(const std::string& room);
  /// Takes a room from a holder that is silent, as its standby. `epoch`: the next; 0: it is not the
  /// standby, or holder or epoch are not as `room` was read.
  Status TakeFrom(const FleetRoom& room, std::int32_t* epoch);
  /// Holds the room again in the same epoch, with the present lease: after the one before had
  /// ended, if nobody has taken it, or while that of a process which is gone goes on.
  Status TakeBack(const std::string& room, std::int32_t epoch, bool* done);
  /// Puts a room back that is held here and that the directory has lost altogether.
  Status Restore(const std::string& room, std::int32_t epoch, const std::string& spec, bool* done);
  /// Gives the room to another server, in the next epoch. `next` 0: it is not ours any more, or
  /// that server is gone.
  Status Move(const std::string& room, std::int32_t epoch, const FleetServer& to,
              std::int32_t* next);
  /// Notes where the room's state is, if `epoch` is the room's.
  Status SaveState(const std::string& room, std::int32_t epoch, const std::string& state,
                   bool* done);
  /// The room has ended: removes it if we hold it in this epoch. Its epoch stays.
  Status Release(const std::string& room, std::int32_t epoch);
  /// Holds the room no longer: another server may take it over at once.
  Status GiveUp(const std::string& room, std::int32_t epoch);
  /// Leaves the directory at once, with everything that is held.
  Status Leave();

  const FleetServer& me() const { return me_; }

  /// A lease that was renewed so lately is not renewed again by RenewIfDue, us: a fifth of it.
  static constexpr std::int64_t kRenewUs = std::int64_t{kFleetLeaseS} * 200000;

 private:
  std::string RoomKey(const std::string& room, const char* what) const;
  std::string MyHolderText(std::int32_t epoch) const;
  std::string MyStandbyText() const;
  /// Conditions and writes of one Commit.
  struct Change {
    std::vector<KeyCondition> conditions;
    std::vector<KeyWrite> writes;
  };
  /// Adds to `change` that a room is taken that nobody holds. `known`: as it was read, or null.
  Status AddTake(const std::string& room, const FleetRoom* known, std::int32_t least,
                 std::int32_t* epoch, Change* change) const;

  const std::unique_ptr<KeyStore> store_;
  const std::string prefix_;
  FleetServer me_;
  std::int64_t lease_ = 0;
  std::int64_t renewed_us_ = 0;
  std::vector<KeyValue> seen_;
};

}  // namespace seam
