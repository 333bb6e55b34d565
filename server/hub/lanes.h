#pragma once
/// Worker threads for rooms. Each room is pinned to one; where a room holds its thread for too
/// long, the other rooms of that thread go on by another, so that none of them waits for it.

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace seam {

/// Something that runs now and then, by one thread at a time.
class Runnable {
 public:
  virtual ~Runnable() = default;
  /// Does what is due.
  virtual void Run(std::int64_t now_us) = 0;
  /// When to call Run at the latest, on the same clock; asked between calls of Run.
  virtual std::int64_t due_us() const = 0;
};

class Lanes {
 public:
  /// Runs each of `rooms`, which must outlive it, in one of `workers` (at least 1) threads, in
  /// turn. The clock is SteadyClockUs.
  Lanes(const std::vector<Runnable*>& rooms, int workers);
  /// Ends the threads; each finishes the call it is in.
  ~Lanes();
  Lanes(const Lanes&) = delete;
  Lanes& operator=(const Lanes&) = delete;

  /// Room `room` is to be run soon, whenever it is due. By any thread.
  void Wake(int room);
  /// Threads that run rooms now: as many as workers, and one for each room that was too slow.
  int lane_count() const;

  /// A call that takes longer holds up the others, us: a third of a tick at 60 Hz.
  static constexpr std::int64_t kSlowUs = 5000;
  /// A room that was not slow for so long shares a thread again, us.
  static constexpr std::int64_t kCalmUs = 10000000;

 private:
  struct Room {
    Runnable* what = nullptr;
    int index = 0;
    bool woken = false;
  };
  struct Lane {
    std::vector<Room*> rooms;
    Room* busy = nullptr;
    std::int64_t busy_since_us = 0;
    std::int64_t slow_us = 0;  // when a call was slow last
    bool over = false;         // has no rooms, and gets none
    bool ended = false;        // and its thread does no more
    std::condition_variable wake;
    std::thread thread;
  };

  void Work(Lane* lane);
  static Room* NextDue(const Lane& lane, std::int64_t now_us, std::int64_t* due_us);
  /// Every kWatchUs: parts the rooms of a lane that is held, joins what has been calm.
  void Watch();
  void Part(std::int64_t now_us, Lane* lane);
  void Join(Lane* lane);
  Lane* AddLane();
  void RemoveEnded();

  std::vector<std::unique_ptr<Room>> rooms_;
  const std::size_t workers_;
  mutable std::mutex mutex_;  // of all below, and of what the rooms and lanes say of themselves
  std::vector<std::unique_ptr<Lane>> lanes_;  // also those that are over, until they have ended
  std::condition_variable watch_;
  bool stop_ = false;
  std::thread watcher_;
};

}  // namespace seam
