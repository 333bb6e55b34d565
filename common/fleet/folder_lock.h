#pragma once
/// The lock of a folder that several programs change: flock of a file. Who waits for it stands in
/// the system's queue, so that those who came first have it first, however busy the machine is.

#include <sys/types.h>

#include <functional>
#include <memory>
#include <string>

#include "common/base/status.h"

namespace seam {

class FolderLock {
 public:
  /// `path`: of the file, which is made when it is needed.
  explicit FolderLock(std::string path);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Runs `act` with the lock and returns its status. An error, without `act`, if the file cannot
  /// be opened or somebody keeps the lock for 2 s. `mode`: of the file, when it is made. One call
  /// at a time.
  Status With(mode_t mode, const std::function<Status()>& act);

 private:
  struct Queue;
  static void WaitInQueue(const std::string& path, int fd, Queue& queue);

  const std::string path_;
  const std::shared_ptr<Queue> queue_;  // outlives this while a thread waits in it
};

}  // namespace seam
