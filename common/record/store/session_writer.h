#pragma once
/// Writes parts of sessions somewhere, in a thread of its own: no tick waits. All of it is
/// thread-safe.

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "common/base/status.h"
#include "common/record/disk_thread.h"
#include "common/record/store/store.h"

namespace seam {

class SessionWriter {
 public:
  /// Writes a part, or returns one line.
  using Write = std::function<Status(const StoredSession&)>;
  /// `open`: called once, in the thread; throws OperatorError.
  explicit SessionWriter(std::function<Write()> open);

  /// Queues a part.
  void Put(StoredSession part);
  /// Returns the first failure; nothing is written after it.
  Status trouble() const;
  /// Waits until everything queued is written.
  void Finish();

 private:
  struct Shared {
    mutable std::mutex mutex;  // guards trouble
    Status trouble;
    Write write;  // used by the thread alone; empty after a failure
  };
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::unique_ptr<DiskThread> thread_ = std::make_unique<DiskThread>();
};

/// Returns a writer into the database at `path` (Store).
std::shared_ptr<SessionWriter> WriteIntoStore(const std::string& path);
/// Returns a writer that appends each event to `path` as a line of JSON, with its room and scene.
std::shared_ptr<SessionWriter> WriteEvents(const std::string& path);

}  // namespace seam
