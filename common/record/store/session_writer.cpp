#include "common/record/store/session_writer.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "common/base/check.h"
#include "common/base/json_text.h"
#include "common/record/events/event_text.h"

namespace seam {
namespace {

/// True if a file ends in the middle of a line: its writer was killed, or had a full disk.
bool IsCut(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || file.tellg() <= 0) return false;
  file.seekg(-1, std::ios::end);
  return file.get() != '\n';
}

}  // namespace

SessionWriter::SessionWriter(std::function<Write()> open) {
  thread_->Do([shared = shared_, open = std::move(open)] {
    try {
      shared->write = open();
    } catch (const OperatorError& error) {
      const std::lock_guard<std::mutex> lock(shared->mutex);
      shared->trouble = Status::Error(error.what());
    }
  });
}

void SessionWriter::Put(StoredSession part) {
  thread_->Do([shared = shared_, part = std::move(part)] {
    if (!shared->write) return;
    const Status status = shared->write(part);
    if (status.ok()) return;
    shared->write = nullptr;
    const std::lock_guard<std::mutex> lock(shared->mutex);
    shared->trouble = status;
  });
}

Status SessionWriter::trouble() const {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return shared_->trouble;
}

void SessionWriter::Finish() {
  thread_ = std::make_unique<DiskThread>();  // the old one does its jobs first
}

std::shared_ptr<SessionWriter> WriteIntoStore(const std::string& path) {
  return std::make_shared<SessionWriter>([path] {
    const auto store = std::make_shared<Store>(path, Store::Use::kWrite);
    return [store](const StoredSession& part) { return store->Put(part); };
  });
}

std::shared_ptr<SessionWriter> WriteEvents(const std::string& path) {
  return std::make_shared<SessionWriter>([path] {
    const bool cut = IsCut(path);
    const auto file = std::make_shared<std::ofstream>(path, std::ios::app | std::ios::binary);
    if (!*file) throw OperatorError(path + ": cannot be written: " + std::strerror(errno));
    if (cut) *file << '\n';
    return [file, path](const StoredSession& part) {
      const std::string where =
          "{\"room\":" + JsonText(part.room) + ",\"scene\":" + JsonText(part.scene) + ",";
      std::string lines;
      for (const Event& event : part.events) {
        const double time_s = static_cast<double>(event.tick) / part.tick_hz;
        lines += where + EventJson(event, time_s).substr(1) + "\n";
      }
      *file << lines << std::flush;
      return *file ? Status::Ok() : Status::Error(path + ": " + std::strerror(errno));
    };
  });
}

}  // namespace seam
