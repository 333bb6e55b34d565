#pragma once
/// A saved room in a file, with the place in the room's log up to which it goes.
///
///   magic 8 bytes | version u32 | CRC-32C u32 of all that follows | tick i64
///   | log: bytes i64, number i64, crc u32, segment u32 (0 before version 3)
///   | keyed 32 bytes (not in version 1)
///   | bytes of RoomState::Save   (this machine's byte order)

#include <cstdint>
#include <string>
#include <system_error>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/status.h"
#include "common/record/room_log.h"

namespace seam {

/// Version of the file around the room; RoomState has its own. A file has the first version that
/// can hold it, so that servers before can read it.
constexpr std::uint32_t kSnapshotVersion = 3;
/// Snapshots of a room that are kept: the newest, and the one before in case that one is damaged.
constexpr int kSnapshotsKept = 2;

struct RoomSnapshot {
  std::int64_t tick = 0;
  LogPlace log;  ///< all before it is in `room`
  Bytes room;    ///< of RoomState::Save
};

/// A snapshot's file.
struct SnapshotName {
  std::string room;
  std::int32_t epoch = 1;  ///< of the room when it was written
  std::int64_t tick = 0;
  std::string path;
};

/// Returns the beginning of the names of a room's files: "main", and from epoch 2 on "main.e2". A
/// server that does not know yet that another one has the room writes into no file of that one.
std::string StemOf(const std::string& room, std::int32_t epoch);

/// Returns the snapshots of a room in a folder, or of all (""): the latest epoch first, of each the
/// newest first. `error`: set if the folder could not be read to its end.
std::vector<SnapshotName> ListSnapshots(const std::string& folder, const std::string& room,
                                        std::error_code* error = nullptr);
/// Writes a snapshot that appears whole or not at all (a file of its own, fsync, rename), and
/// removes those older than the last kSnapshotsKept. Returns one line if it cannot.
Status WriteSnapshot(const std::string& folder, const std::string& room,
                     const RoomSnapshot& snapshot, std::int32_t epoch = 1);
/// Writes one likewise that is not on the disk yet: only a loss of power can take it away, and then
/// those before are there.
Status PlaceSnapshot(const std::string& folder, const std::string& room,
                     const RoomSnapshot& snapshot, std::int32_t epoch);
/// Waits until such a snapshot is on the disk, and removes the older ones.
Status SyncSnapshot(const std::string& folder, const std::string& room, std::int64_t tick,
                    std::int32_t epoch);
/// Reads a snapshot; trusts no byte. Returns one line if it cannot be read or is damaged.
Status ReadSnapshot(const std::string& path, RoomSnapshot* snapshot);

}  // namespace seam
