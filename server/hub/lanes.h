#pragma once
/// Worker threads for rooms. Each room is pinned to one thread. When a room holds its thread for
/// too long, the other rooms of that thread move to a new one, so that none waits for it.

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace seam {

/// Interface of a task that is run repeatedly, by one thread at a time.
class Runnable {
 public:
  virtual ~Runnable() = default;
  /// Does the work that is due.
  virtual void Run(std::int64_t now_us) = 0;
  /// Returns the latest time of the next Run, on the same clock; called only between calls of Run.
  virtual std::int64_t due_us() const = 0;
};

class Lanes {
 public:
  /// Runs `rooms`, which must outlive it, distributed over `workers` (at least 1) threads in turn.
  /// The clock is SteadyClockUs.
  Lanes(const std::vector<Runnable*>& rooms, int workers);
  /// Ends the threads; each finishes its current call.
  ~Lanes();
  Lanes(const Lanes&) = delete;
  Lanes& operator=(const Lanes&) = delete;

  /// Thread-safe: runs another one, the next in number, which must outlive it.
  void Add(Runnable* room);
  /// Thread-safe: makes a room run soon, even if it is not due.
  void Wake(int room);
  /// Thread-safe: returns when no thread runs the room; none does until Free. Other rooms run on.
  void Hold(int room);
  void Free(int room);
  /// Returns the number of threads that run rooms now: the workers, and one for each slow room.
  int lane_count() const;

  /// A call that takes longer holds up other rooms, us: a third of a tick at 60 Hz.
  static constexpr std::int64_t kSlowUs = 5000;
  /// A slow room shares a thread again after so long without a slow call, us.
  static constexpr std::int64_t kCalmUs = 10000000;

 private:
  struct Room {
    Runnable* what = nullptr;
    int index = 0;
    bool woken = false;
    bool held = false;
  };
  struct Lane {
    std::vector<Room*> rooms;
    Room* busy = nullptr;
    std::int64_t busy_since_us = 0;
    std::int64_t slow_us = 0;  // time of the last slow call
    bool over = false;         // has no rooms, and gets none
    bool ended = false;        // over, and the thread is finished
    std::condition_variable wake;
    std::thread thread;
  };

  void Work(Lane* lane);
  static Room* NextDue(const Lane& lane, std::int64_t now_us, std::int64_t* due_us);
  /// Every kWatchUs: moves the other rooms off a held lane, and rejoins calm rooms.
  void Watch();
  void Part(std::int64_t now_us, Lane* lane);
  void Join(Lane* lane);
  Lane* AddLane();
  void RemoveEnded();

  std::vector<std::unique_ptr<Room>> rooms_;
  const std::size_t workers_;
  mutable std::mutex mutex_;                  // guards all below, and the fields of rooms and lanes
  std::vector<std::unique_ptr<Lane>> lanes_;  // also lanes that are over, until ended
  std::condition_variable watch_;
  std::condition_variable rests_;  // a held room was run, and is not any more
  bool stop_ = false;
  std::thread watcher_;
};

}  // namespace seam
