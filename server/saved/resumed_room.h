#pragma once
/// Finds the rooms in a folder of --state, and all that a server needs to go on with them.

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "server/room_state.h"
#include "server/saved/log_tail.h"

namespace seam {

struct ResumedRoom {
  std::unique_ptr<const SavedRoom> saved;
  std::int32_t epoch = 1;  ///< in which the room goes on
  std::int64_t saved_tick = 0;
  LogTail tail;
  std::string log;                 ///< path; it goes on at tail.end
  /// It goes on without the ticks since the snapshot: the old log, or its damaged segment and all
  /// later ones, cannot be gone on with and were put aside.
  bool new_log = false;
  std::vector<std::string> notes;  ///< lines for the operator: what is damaged, what is lost

  /// Returns the last tick that is known of it.
  std::int64_t tick() const { return std::max(saved_tick, tail.end.tick); }
};

/// A room's newest snapshot, and where its log goes on.
struct NewestSnapshot {
  std::unique_ptr<const SavedRoom> saved;
  std::int64_t tick = 0;
  LogPlace log;
  std::int32_t epoch = 1;  ///< of the log
};
/// Opens the newest snapshot that is of this version and loads. Throws OperatorError if there is
/// none.
NewestSnapshot OpenNewestSnapshot(const std::string& folder, const std::string& room);

/// Returns the path of a room's log in such a folder, for one epoch.
std::string StateLogOf(const std::string& folder, const std::string& room, std::int32_t epoch = 1);
/// Returns the names of the rooms in it. Throws OperatorError if there are none, unless `may_none`.
std::vector<std::string> RoomsIn(const std::string& folder, bool may_none = false);
/// Reads a room: of its snapshots the newest that is of this version and loads, and its log from
/// there on; without one its whole log. Throws OperatorError if it has neither. Renames a log that
/// is damaged behind that, or was not written with `log_key` (nullptr: need not be). `epoch`: in
/// which it is to go on, 0: as saved; in a later one than that of the log it gets a log of its own.
ResumedRoom ReadResumedRoom(const std::string& folder, const std::string& room,
                            const Secret* log_key = nullptr, std::int32_t epoch = 0);
/// Makes the folder if there is none. Throws OperatorError if that cannot be, or if it holds this
/// room and `force` is not given; with `force` removes the room.
void PrepareStateFolder(const std::string& folder, const std::string& room, bool force);

}  // namespace seam
