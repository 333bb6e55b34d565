#include <utility>

#include "common/base/check.h"
#include "common/record/store/store.h"

namespace seam {

StoreWriter::StoreWriter(std::string path) : path_(std::move(path)) {
  thread_->Do([shared = shared_, file = path_] {
    try {
      shared->store = std::make_unique<Store>(file, Store::Use::kWrite);
    } catch (const OperatorError& error) {
      const std::lock_guard<std::mutex> lock(shared->mutex);
      shared->trouble = Status::Error(error.what());
    }
  });
}

void StoreWriter::Put(StoredSession part) {
  thread_->Do([shared = shared_, part = std::move(part)] {
    if (shared->store == nullptr) return;
    const Status status = shared->store->Put(part);
    if (status.ok()) return;
    shared->store.reset();
    const std::lock_guard<std::mutex> lock(shared->mutex);
    shared->trouble = status;
  });
}

Status StoreWriter::trouble() const {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return shared_->trouble;
}

void StoreWriter::Finish() {
  thread_ = std::make_unique<DiskThread>();  // the old one does its jobs first
}

}  // namespace seam
