#pragma once
/// A thread for jobs that wait for the disk, so that no tick does.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace seam {

class DiskThread {
 public:
  DiskThread() = default;
  /// Does the jobs that are left first.
  ~DiskThread();
  DiskThread(const DiskThread&) = delete;
  DiskThread& operator=(const DiskThread&) = delete;

  /// Queues a job; never waits. The first one starts the thread. Jobs are done in order and must
  /// own what they use.
  void Do(std::function<void()> job);

 private:
  void Work();

  std::mutex mutex_;  // guards jobs_ and stop_
  std::condition_variable wake_;
  std::deque<std::function<void()>> jobs_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace seam
