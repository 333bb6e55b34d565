#pragma once
/// Everything that a room is: scene and edits, bodies, rest, authority, metadata, places, inputs,
/// rules and scripts, and its tick. Gives it as messages to a client that joins, and as bytes to a
/// server that continues the room.
///
///   Save:  the parts --Persist--> bytes             at a barrier, between two ticks
///   Load:  bytes --SavedRoom--> scene, topology --> a new Server --Persist--> the parts
///
/// Not in it: sessions with their send queues, and the views. A loaded room continues as if every
/// client had left at that tick. It has the past as well, as far as a replay reaches: a message of
/// an earlier tick that comes later does at both the same.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/state_archive.h"
#include "common/base/status.h"
#include "common/codec/messages.h"
#include "common/scene/scene.h"
#include "common/topology/topology_fold.h"

namespace seam {

class AuthorityManager;
class AuthoritySource;
class BoundsWatch;
class EditLog;
class MetaTable;
class Replica;
class RoomClock;
class Rules;
class SeatBonds;
class SessionTable;
class TrustLadder;

/// Version of the saved bytes. Raise it with every change of them; older ones are not read.
constexpr std::uint32_t kRoomStateVersion = 7;

/// The beginning of a saved room, enough to make the server that loads it.
class SavedRoom {
 public:
  /// Reads bytes of RoomState::Save; trusts none of them. Returns nullptr, and one line in
  /// `status`, if they are damaged or of another version.
  static std::unique_ptr<const SavedRoom> Read(ByteView bytes, Status* status);

  /// Settings, scene text and name.
  const Room& room() const { return room_; }
  /// The room's epoch, 1 or more.
  std::int32_t epoch() const { return epoch_; }
  const Scene& scene() const { return scene_; }
  const Topology& topology() const { return topology_; }
  /// The edits that made the topology, for the EditLog.
  const TopologyFold& fold() const { return fold_; }
  /// The bytes that RoomState::Load reads.
  ByteView parts() const { return parts_; }

 private:
  SavedRoom(const Room& room, const Scene& scene)
      : room_(room), scene_(scene), topology_(scene_), fold_(topology_) {}

  Room room_;
  std::int32_t epoch_ = 1;
  Scene scene_;
  Topology topology_;
  TopologyFold fold_;
  Bytes parts_;
};

class RoomState {
 public:
  /// The owners of a room's state. All must outlive this; `source` and `rules` may be null.
  struct Parts {
    const Room& room;
    std::int32_t epoch;
    Replica& replica;
    AuthorityManager& authority;
    EditLog& edits;
    SeatBonds& seats;
    BoundsWatch& bounds;
    TrustLadder& ladder;
    SessionTable& sessions;
    RoomClock& clock;
    MetaTable& settings;
    AuthoritySource* source;
    Rules* rules;
  };
  explicit RoomState(const Parts& parts) : parts_(parts) {}

  // For a client that joins, in this order. `now_us` becomes their time.
  /// The edits that make the current world of the scene; empty if there are none.
  std::vector<Snapshot> Edits(std::int64_t now_us) const;
  std::vector<Grants> Authority(std::int64_t now_us) const;
  /// States of the bodies that do not rest, and of those that do; empty before tick 0.
  std::vector<States> Bodies(std::int64_t now_us) const;
  std::vector<Rest> Resting(std::int64_t now_us) const;
  std::vector<Meta> Metadata(std::int64_t now_us) const;

  /// Returns all of it as bytes, without pointers into the room: another thread may write them.
  /// Call between two ticks. Makes this tick a barrier of the world (World::Barrier), which the
  /// room that loads it has as well: both then continue with the same bits.
  Bytes Save(std::int64_t now_us);
  /// The same in two steps: a copy, which another thread finishes. `expected_bytes`: the size of
  /// the last copy, which saves moving the bytes as they grow.
  StateDraft Copy(std::int64_t now_us, std::size_t expected_bytes);
  static Bytes Finish(StateDraft copy);
  /// Loads the bytes of Save into new parts, with a world of the topology of `saved`. Returns one
  /// line if they are damaged; the parts must then not be used any more. `gone` gets the players
  /// that were in the room.
  Status Load(const SavedRoom& saved, std::int64_t now_us, std::vector<int>* gone);

 private:
  void Persist(StateArchive& a, std::int64_t now_us, std::vector<int>* present);

  const Parts parts_;
};

}  // namespace seam
