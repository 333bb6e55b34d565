#include "server/saved/resumed_room.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "common/base/check.h"
#include "common/base/files/list_folder.h"
#include "common/base/names.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/room_log.h"
#include "common/record/segments/log_segments.h"
#include "server/saved/log_begin.h"
#include "server/saved/snapshot_file.h"
#include "server/saved/trial_load.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// Most events of a log before its room's description, normal 1; further ones are not read for it.
constexpr int kEventsToRoomMost = 16;

/// Gives a file that a log cannot go on with another name. Returns a line that says so.
std::string PutAside(const std::string& log) {
  std::string to;
  std::error_code error;
  for (int n = 1; to.empty() || fs::exists(to, error); ++n) {
    to = log + ".damaged-" + std::to_string(n);
  }
  if (!error) fs::rename(log, to, error);
  if (error) throw OperatorError(log + ": cannot be renamed: " + error.message());
  return "kept as " + to;
}

/// Does so with the segments of a log from a number on.
std::string PutAside(const std::string& log, std::int32_t from) {
  std::string kept;
  for (const LogSegment& segment : ListSegments(log, from)) {
    kept += "; " + PutAside(segment.path);
  }
  return kept;
}

/// True if the log beside a snapshot begins with another scene. A log without a beginning says
/// nothing, nor one whose scene came in parts.
bool IsOfAnother(const std::string& folder, const SnapshotName& file, const Room& saved) {
  const std::string log = StateLogOf(folder, file.room, file.epoch);
  std::error_code error;
  if (!fs::is_regular_file(log, error)) return false;
  try {
    LogReader reader(log);
    int read = 0;
    for (LogEvent event; read < kEventsToRoomMost && reader.Next(&event); ++read) {
      const AnyMessage any = Decode(event.data);
      const auto* room = std::get_if<Room>(&any);
      if (room != nullptr) return !room->scene_text.empty() && room->scene_text != saved.scene_text;
    }
  } catch (const OperatorError&) {  // not a log
  }
  return false;
}

/// True if a log is whole and has no tick: its room was killed while it waited for its players.
bool OnlyWaited(const std::string& log) {
  std::error_code error;
  if (fs::file_size(log, error) == 0 && !error) return true;
  try {
    LogReader reader(log);
    for (LogEvent event; reader.Next(&event);) {
      const AnyMessage any = Decode(event.data);
      const auto* seal = std::get_if<LogSeal>(&any);
      if (seal != nullptr && seal->tick > 0) return false;
    }
    return reader.skipped_bytes() == 0 && reader.damage().empty();
  } catch (const OperatorError&) {  // not a log
    return false;
  }
}

/// True if the room has gone on in a later epoch than that of its first log.
bool WentOnLater(const std::string& folder, const std::string& room) {
  bool later = false;
  for (const SnapshotName& file : ListSnapshots(folder, room)) later = later || file.epoch > 1;
  const std::string second = StemOf(room, 2), stem = second.substr(0, second.size() - 1);
  std::error_code error;
  for (const fs::path& path : ListFolder(folder, error)) {
    const bool of_room = path.stem().string().rfind(stem, 0) == 0;
    later = later || (of_room && path.extension() == kLogEnding);
  }
  return later;
}

}  // namespace

std::string StateLogOf(const std::string& folder, const std::string& room, std::int32_t epoch) {
  return (fs::path(folder) / (StemOf(room, epoch) + kLogEnding)).string();
}

std::vector<std::string> RoomsIn(const std::string& folder, bool may_none) {
  std::set<std::string> names;
  std::error_code error;
  for (const fs::path& path : ListFolder(folder, error)) {
    const std::string stem = path.stem().string();
    const std::string name = stem.substr(0, stem.find('.'));
    if (path.extension() == kLogEnding && IsName(name)) names.insert(name);
  }
  for (const SnapshotName& file : ListSnapshots(folder, "")) names.insert(file.room);
  if (error) throw OperatorError(folder + ": cannot be read: " + error.message());
  if (names.empty() && !may_none)
    throw OperatorError(folder + ": no room in it (--state keeps one there)");
  return {names.begin(), names.end()};
}

namespace {

/// Opens the newest snapshot that is of this version and loads. Returns false if there is none.
/// `notes` gets a line for each that does not.
bool FindSnapshot(const std::string& folder, const std::string& room,
                  std::vector<std::string>* notes, NewestSnapshot* newest) {
  const std::vector<SnapshotName> files = ListSnapshots(folder, room);
  for (const SnapshotName& file : files) {
    RoomSnapshot snapshot;
    Status status = ReadSnapshot(file.path, &snapshot);
    if (status.ok()) {
      newest->saved = SavedRoom::Read(snapshot.room, &status);
      std::int64_t tick = 0;
      if (newest->saved != nullptr) status = CanLoad(*newest->saved, &tick);
      if (status.ok() && (tick != file.tick || snapshot.tick != file.tick)) {
        status = Status::Error("is of tick " + std::to_string(tick) + ", its name says " +
                               std::to_string(file.tick));
      }
      if (status.ok() && IsOfAnother(folder, file, newest->saved->room())) {
        status = Status::Error("is of another scene than the room's log");
      }
      if (!status.ok()) status = Status::Error(file.path + ": " + status.why());
    }
    if (status.ok()) {
      newest->tick = snapshot.tick;
      newest->log = snapshot.log;
      newest->epoch = file.epoch;
      return true;
    }
    const bool last = &file == &files.back();
    notes->push_back(status.why() + (last ? "" : "; the one before is used"));
  }
  return false;
}

OperatorError NoSnapshot(const std::string& folder, const std::string& room,
                         const std::vector<std::string>& notes) {
  std::string why = folder + ": room " + room + " has no snapshot that can be read";
  for (const std::string& note : notes) why += "; " + note.substr(0, note.find("; the"));
  return OperatorError(why);
}

/// Returns the room before the first tick of its log. Throws OperatorError if that cannot be had.
NewestSnapshot AtLogBegin(const std::string& folder, const std::string& room,
                          std::vector<std::string>* notes) {
  NewestSnapshot begin;
  Status status = Status::Error("its first log is of an earlier epoch");
  if (!WentOnLater(folder, room)) {
    begin.saved = RoomAtLogBegin(StateLogOf(folder, room), room, &status);
  }
  if (begin.saved == nullptr) {
    notes->push_back(status.why());
    throw NoSnapshot(folder, room, *notes);
  }
  notes->push_back("room " + room + ": no snapshot can be read; its whole log is done again");
  return begin;
}

}  // namespace

NewestSnapshot OpenNewestSnapshot(const std::string& folder, const std::string& room) {
  std::vector<std::string> notes;
  NewestSnapshot newest;
  if (!FindSnapshot(folder, room, &notes, &newest)) throw NoSnapshot(folder, room, notes);
  return newest;
}

ResumedRoom ReadResumedRoom(const std::string& folder, const std::string& room,
                            const Secret* log_key, std::int32_t epoch) {
  ResumedRoom resumed;
  NewestSnapshot newest;
  if (!FindSnapshot(folder, room, &resumed.notes, &newest)) {
    newest = AtLogBegin(folder, room, &resumed.notes);
  }
  resumed.saved = std::move(newest.saved);
  resumed.saved_tick = newest.tick;
  const LogPlace from = newest.log;
  const std::int32_t log_epoch = newest.epoch;
  resumed.log = StateLogOf(folder, room, log_epoch);
  resumed.epoch = std::max({epoch, resumed.saved->epoch(), log_epoch});
  const Status read =
      ReadLogTail(resumed.log, room, from, resumed.saved_tick, log_key, &resumed.tail);
  const std::string damage = read.ok() ? resumed.tail.damage : read.why();
  LogTail& tail = resumed.tail;
  if (resumed.epoch > log_epoch) {
    if (!damage.empty()) resumed.notes.push_back(damage);
    resumed.log = StateLogOf(folder, room, resumed.epoch);
    resumed.new_log = true;
    tail.end = LogPlace();
    return resumed;
  }
  if (damage.empty()) {
    const std::string next = SegmentPath(resumed.log, tail.end.segment + 1);
    std::error_code none;
    const fs::file_status status = fs::symlink_status(next, none);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
      resumed.notes.push_back(next + ": not a file of this log; " + PutAside(next));
    }
    // Nothing of a later file belongs to the log; an empty one is a segment that was not begun.
    for (const LogSegment& other : ListSegments(resumed.log, tail.end.segment + 1)) {
      std::error_code error;
      if (fs::file_size(other.path, error) == 0 || error) continue;
      RequireUnused(other.path);
      resumed.notes.push_back(other.path + ": not a whole tick of this log is in it; " +
                              PutAside(other.path));
    }
    return resumed;
  }
  std::string note = damage + PutAside(resumed.log, tail.damaged_segment);
  if (read.ok() && tail.damaged_segment > tail.end.segment) {
    resumed.notes.push_back(note);  // the segment before is whole up to its end
    return resumed;
  }
  resumed.notes.push_back(note + "; a new log begins");
  resumed.new_log = true;
  // A later segment begins where the undamaged part of the one that it replaces has ended.
  tail.end.bytes = 0;
  if (tail.end.segment == 0) tail.end = LogPlace();
  return resumed;
}

void PrepareStateFolder(const std::string& folder, const std::string& room, bool force) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OperatorError(folder + ": cannot be made: " + error.message());
  const std::vector<SnapshotName> snapshots = ListSnapshots(folder, room);
  std::vector<fs::path> logs;
  for (const fs::path& path : ListFolder(folder, error)) {
    const std::string name = path.filename().string();
    if (name.rfind(room + ".", 0) == 0 && path.extension() == kLogEnding) logs.push_back(path);
  }
  if (error) throw OperatorError(folder + ": cannot be read: " + error.message());
  for (const fs::path& log : logs) RequireUnused(log);
  // Without a snapshot there is nothing to go on with: it was killed before it began.
  if (!force && !snapshots.empty()) {
    throw OperatorError(folder + ": has a room " + room + ": --resume " + folder +
                        " goes on with it, --force removes it");
  }
  for (const SnapshotName& file : snapshots) fs::remove(file.path, error);
  for (const fs::path& log : logs) {
    if (force || OnlyWaited(log.string())) {
      fs::remove(log, error);
    } else {
      PutAside(log);
    }
  }
}

}  // namespace seam
