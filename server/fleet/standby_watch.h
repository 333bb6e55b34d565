#pragma once
/// The rooms for which this server stands by: a thread of its own looks whether their holders live,
/// counts the players that knock, and says when a room is to be taken over (TakeOverRule). It
/// follows a room all the time (`warm`), or opens it when its holder falls silent.

#include <sys/types.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/fleet/directory.h"
#include "server/fleet/take_over_rule.h"
#include "server/saved/followed_room.h"

namespace seam {

/// The sign of life of a holder: the newest file of its room's log. Any write changes it.
class LogPulse {
 public:
  /// `log`: its path; "": none, it never beats.
  explicit LogPulse(std::string log = "") : log_(std::move(log)) {}
  /// True if the log was written to since the last call.
  bool Beats();

 private:
  std::string log_;
  std::int32_t segment_ = 0;
  off_t bytes_ = -1;
  timespec written_{};
};

class StandbyWatch {
 public:
  struct Config {
    std::string folder;                     ///< of the rooms' states
    bool warm = false;                      ///< follows the rooms all the time
    std::shared_ptr<const Secret> log_key;  ///< of their logs; null: none
    std::function<void()> due;              ///< called by the thread: TakeDue has a room
  };
  explicit StandbyWatch(Config config);
  ~StandbyWatch();
  StandbyWatch(const StandbyWatch&) = delete;
  StandbyWatch& operator=(const StandbyWatch&) = delete;

  /// A room for which this server stands by, as the directory has it.
  struct Guarded {
    FleetRoom room;
    bool leaving = false;  ///< its holder drains: it is to be taken as soon as it can go on here
  };
  // All thread-safe:
  /// Sets the rooms for which this server stands by. One of Await stays, too.
  void Set(const std::vector<Guarded>& rooms);
  /// Answers a Due that is leaving: it was taken in this epoch (0: it was not), and is due again
  /// when its holder has stopped it.
  void Await(const std::string& room, std::int32_t epoch);
  /// Notes the knock of a client that has proved to be of the room's epoch. It counts with the key
  /// of a player in the room.
  void NoteKnock(const std::string& room, const std::string& name, std::uint64_t key);
  /// A room that is to be taken from its holder, which was as in `room`.
  struct Due {
    FleetRoom room;
    bool leaving = false;           ///< the holder runs it until it knows: Await
    std::int32_t epoch = 0;         ///< it was taken in this one, and its holder has stopped it
    int knocking = 0, present = 0;  ///< players
    std::unique_ptr<FollowedRoom> followed;
  };
  std::vector<Due> TakeDue();
  /// Gives away a room that is followed, for another reason; nullptr: it is not.
  std::unique_ptr<FollowedRoom> Take(const std::string& room);
  /// Returns each room and how many ticks it is behind its log; -1: it is not followed.
  std::map<std::string, std::int64_t> Behind() const;
  /// Returns lines for the operator since the last call.
  std::vector<std::string> TakeReports();

  /// Time between two looks at the logs, us.
  static constexpr std::int64_t kRoundUs = 50000;
  /// The same while the holder of a room drains, us: it is added to the time in which players hear
  /// no tick. Each costs one read of the end of one log.
  static constexpr std::int64_t kSoonUs = 2000;
  /// A room that cannot be followed is tried again after this, us, unless its holder falls silent.
  static constexpr std::int64_t kFollowAgainUs = 10000000;
  /// Most clients of a room with knocks that are kept; each has proved that it was there.
  static constexpr std::size_t kKnocksMax = 1024;

 private:
  struct Knock {
    std::string name;
    std::uint64_t key = 0;
    std::int64_t at_us = 0;
  };
  struct Watched {
    FleetRoom room;
    LogPulse pulse;
    TakeOverRule rule;
    std::vector<Knock> knocks;
    bool leaving = false;
    std::int32_t taken = 0;  // in this epoch, and awaited; 0: it is the holder's
    bool given = false;      // it was awaited, and is gone on with
    std::unique_ptr<FollowedRoom> followed;
    std::int64_t opened_us = INT64_MIN / 2;  // or tried to
    std::int64_t due_again_us = 0;
    std::int64_t worked_us = 0;  // CPU time of the thread at the last look
    std::string trouble;         // the last that was reported
  };
  void Run();
  void NoteTaken(const std::map<std::string, std::int32_t>& taken);
  void Adopt(const std::vector<Guarded>& rooms);
  void Look(Watched& watched);
  /// Offers a room of a holder that drains, unless one is awaited, or gives away the one that is.
  void LookAtLeaving();
  void Offer(Watched& watched);
  void LookAtAwaited(Watched& watched);
  void Give(Due due);
  static void LookAtHolder(Watched& watched);
  /// Opens the room, or does more of its ticks again. `silent`: its holder is.
  void Follow(std::int64_t now_us, bool silent, Watched& watched);
  static std::int64_t BehindOf(const Watched& watched);

  const Config config_;
  mutable std::mutex work_mutex_;  // guards watched_ while the thread works, for long
  std::map<std::string, Watched> watched_;
  mutable std::mutex mutex_;  // guards all below, for short
  std::condition_variable wake_;
  bool stop_ = false;
  std::optional<std::vector<Guarded>> wanted_;
  std::map<std::string, std::vector<Knock>> heard_;
  std::vector<Due> due_;
  std::map<std::string, std::int32_t> taken_;  // epochs by room, as of Await
  bool offers_ = false;                        // a room that is leaving, and there is no answer yet
  std::map<std::string, std::int64_t> behind_;
  std::vector<std::string> news_;
  std::thread thread_;
};

}  // namespace seam
