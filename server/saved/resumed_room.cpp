#include "server/saved/resumed_room.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "common/base/check.h"
#include "common/base/names.h"
#include "server/saved/snapshot_file.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLogEnding = ".lcm";

/// Gives a log that cannot be gone on with another name. Returns a line that says so.
std::string PutAside(const std::string& log) {
  std::string to;
  for (int n = 1; to.empty() || fs::exists(to); ++n) {
    to = log + ".damaged-" + std::to_string(n);
  }
  std::error_code error;
  fs::rename(log, to, error);
  if (error) throw OperatorError(log + ": cannot be renamed: " + error.message());
  return "kept as " + to + ", a new log begins";
}

}  // namespace

std::string StateLogOf(const std::string& folder, const std::string& room) {
  return (fs::path(folder) / (room + kLogEnding)).string();
}

std::vector<std::string> RoomsIn(const std::string& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    const std::string name = path.stem().string();
    if (path.extension() == kLogEnding && IsName(name)) names.insert(name);
  }
  if (error) throw OperatorError(folder + ": cannot be read: " + error.message());
  if (names.empty()) throw OperatorError(folder + ": no room in it (--state keeps one there)");
  return {names.begin(), names.end()};
}

ResumedRoom ReadResumedRoom(const std::string& folder, const std::string& room,
                            const Secret* log_key) {
  ResumedRoom resumed;
  resumed.log = StateLogOf(folder, room);
  LogPlace from;
  for (const SnapshotName& file : ListSnapshots(folder, room)) {
    RoomSnapshot snapshot;
    Status status = ReadSnapshot(file.path, &snapshot);
    if (status.ok()) {
      resumed.saved = SavedRoom::Read(snapshot.room, &status);
      if (!status.ok()) status = Status::Error(file.path + ": " + status.why());
    }
    if (status.ok()) {
      resumed.saved_tick = snapshot.tick;
      from = snapshot.log;
      break;
    }
    resumed.notes.push_back(status.why() + "; the one before is used");
  }
  if (resumed.saved == nullptr) {
    std::string why = folder + ": room " + room + " has no snapshot that can be read";
    for (const std::string& note : resumed.notes) why += "; " + note.substr(0, note.find("; the"));
    throw OperatorError(why);
  }
  const Status read = ReadLogTail(resumed.log, room, from, log_key, &resumed.tail);
  const std::string damage = read.ok() ? resumed.tail.damage : read.why();
  if (damage.empty()) return resumed;
  const bool there = fs::exists(resumed.log);
  resumed.notes.push_back(damage + (there ? "; " + PutAside(resumed.log) : "; a new log begins"));
  resumed.new_log = true;
  return resumed;
}

void PrepareStateFolder(const std::string& folder, const std::string& room, bool force) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OperatorError(folder + ": cannot be made: " + error.message());
  const std::vector<SnapshotName> snapshots = ListSnapshots(folder, room);
  if (!force && (fs::exists(StateLogOf(folder, room)) || !snapshots.empty())) {
    throw OperatorError(folder + ": has a room " + room + ": --resume " + folder +
                        " goes on with it, --force removes it");
  }
  for (const SnapshotName& file : snapshots) fs::remove(file.path, error);
}

}  // namespace seam
