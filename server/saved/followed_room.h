#pragma once
/// A room that another server runs, followed by its saved state: the newest snapshot, and the ticks
/// of the log as they are written, done again as ReadResumedRoom's are. So this server can go on
/// with it at any time. Bounded: of one room's memory, and a log that grows faster than it is done
/// again is given up.

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "server/saved/log_tail.h"
#include "server/saved/resumed_room.h"

namespace seam {

class FollowedRoom {
 public:
  /// Opens the room's newest snapshot of this epoch. Throws OperatorError if there is none that
  /// loads. `log_key` is as for ReadResumedRoom.
  FollowedRoom(const std::string& folder, const std::string& room, std::int32_t epoch,
               std::shared_ptr<const Secret> log_key);
  ~FollowedRoom();
  FollowedRoom(const FollowedRoom&) = delete;
  FollowedRoom& operator=(const FollowedRoom&) = delete;

  /// Reads the new part of the log, and does ticks again for at most kWorkUs. Returns one line if
  /// the room cannot be followed any more: it falls behind, comes out otherwise than its log, or
  /// the log was damaged for kDamagedUs.
  Status Follow(std::int64_t now_us);
  /// Ticks that were read and not done again yet.
  std::int64_t behind() const { return static_cast<std::int64_t>(pending_.size()); }
  std::int64_t tick() const;
  /// True if the log, as it was read, ends with the end of the room at its server.
  bool ended() const { return ended_; }
  /// Returns the players that are in the room.
  const std::vector<int>& present() const;
  /// Returns the player in the room with this name and key; -1: none.
  int Player(const std::string& name, std::uint64_t key) const;
  /// Reads the log to its end, and returns the room as it is after that, to go on in `epoch`. No
  /// other call may follow. Throws OperatorError if it cannot be read.
  std::shared_ptr<ResumedRoom> Finish(std::int64_t now_us, std::int32_t epoch);

  /// CPU time of one call of Follow, us: a round of the thread, normal 1 ms a room.
  static constexpr std::int64_t kWorkUs = 30000;
  /// Most seconds of ticks that wait to be done again: twice the time between snapshots.
  static constexpr int kFollowBehindS = 12;
  /// A part of a tick is seen while it is written, for less than a ms; an error that lasts so long
  /// is damage, us.
  static constexpr std::int64_t kDamagedUs = 500000;

 private:
  struct Quiet;
  Status Read(std::int64_t now_us);
  Status DoOne(std::int64_t now_us);

  const std::string folder_, room_;
  const std::shared_ptr<const Secret> log_key_;
  std::unique_ptr<Quiet> quiet_;  // the server, which nobody hears
  std::unique_ptr<LogFollower> log_;
  std::deque<TickMessages> pending_;
  std::vector<AnyMessage> begun_;
  std::optional<Summary> summary_;
  bool ended_ = false;
  std::int64_t damaged_us_ = -1;  // since when; -1: it is not
};

}  // namespace seam
