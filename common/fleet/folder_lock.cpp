#include "common/fleet/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

namespace seam {
namespace {

/// Longest wait for the lock: everybody holds it for milliseconds, and one that does not must not
/// hold up a server's end.
constexpr std::chrono::seconds kLockWait{2};

/// Opens a file to lock it; -1 with errno. flock takes a file that may only be read, too.
int OpenToLock(const std::string& path, mode_t mode) {
  constexpr int kAlways = O_CLOEXEC | O_NONBLOCK;
  int fd = open(path.c_str(), O_RDWR | kAlways);
  if (fd < 0 && errno == ENOENT) fd = open(path.c_str(), O_RDWR | O_CREAT | kAlways, mode);
  if (fd < 0 && errno == EACCES) fd = open(path.c_str(), O_RDONLY | kAlways);
  return fd;
}

/// True if the open file is still the one of that name.
bool IsNamed(const std::string& path, int fd) {
  struct stat named {
  }, opened{};
  return stat(path.c_str(), &named) == 0 && fstat(fd, &opened) == 0 &&
         named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

}  // namespace

/// A caller and the thread that waits for it. After a caller that gave up, the thread waits on for
/// the next one: there is never more than one.
struct FolderLock::Queue {
  enum class Is { kIdle, kWaiting, kRunning, kDone };
  std::mutex mutex;
  std::condition_variable changed;
  bool thread_waits = false;
  Is is = Is::kIdle;
  const std::function<Status()>* act = nullptr;
  Status status = Status::Ok();
};

FolderLock::FolderLock(std::string path)
    : path_(std::move(path)), queue_(std::make_shared<Queue>()) {}

FolderLock::~FolderLock() = default;

Status FolderLock::With(mode_t mode, const std::function<Status()>& act) {
  const auto failed = [this](const char* what) {
    return Status::Error(path_ + ": cannot be " + what + ": " + std::strerror(errno));
  };
  const int fd = OpenToLock(path_, mode);
  if (fd < 0) return failed("opened");
  if (flock(fd, LOCK_EX | LOCK_NB) == 0) {
    const Status status = act();
    close(fd);
    return status;
  }
  if (errno != EWOULDBLOCK && errno != EINTR) {
    const Status status = failed("locked");
    close(fd);
    return status;
  }
  Queue& queue = *queue_;
  std::unique_lock<std::mutex> lock(queue.mutex);
  queue.is = Queue::Is::kWaiting;
  queue.act = &act;
  if (queue.thread_waits) {
    close(fd);
  } else {
    queue.thread_waits = true;
    std::thread([path = path_, fd, shared = queue_] { WaitInQueue(path, fd, *shared); }).detach();
  }
  queue.changed.wait_for(lock, kLockWait, [&] { return queue.is != Queue::Is::kWaiting; });
  if (queue.is == Queue::Is::kWaiting) {
    queue.is = Queue::Is::kIdle;
    return Status::Error(path_ + ": cannot be locked; another program holds it");
  }
  queue.changed.wait(lock, [&] { return queue.is == Queue::Is::kDone; });
  queue.is = Queue::Is::kIdle;
  return queue.status;
}

void FolderLock::WaitInQueue(const std::string& path, int fd, Queue& queue) {
  int error = 0;
  while (flock(fd, LOCK_EX) != 0) {
    if (errno == EINTR) continue;
    error = errno;
    break;
  }
  if (error == 0 && !IsNamed(path, fd)) error = ESTALE;
  std::unique_lock<std::mutex> lock(queue.mutex);
  queue.thread_waits = false;
  if (queue.is == Queue::Is::kWaiting) {
    queue.is = Queue::Is::kRunning;
    lock.unlock();
    Status status = error == 0 ? (*queue.act)()
                               : Status::Error(path + ": cannot be locked: " + strerror(error));
    lock.lock();
    queue.status = std::move(status);
    queue.is = Queue::Is::kDone;
    queue.changed.notify_all();
  }
  lock.unlock();
  close(fd);
}

}  // namespace seam
