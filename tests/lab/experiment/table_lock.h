#pragma once
/// One writer of a table at a time, on one machine or on several that share a file system.

#include <string>

namespace seam {

/// Holds the lock of a table from construction to destruction. The lock is an open file description
/// lock (fcntl(2), F_OFD_SETLK) on PATH.lock, which NFS 4 keeps too, and which ends with the
/// process; the file holds the name of its holder.
class TableLock {
 public:
  /// Throws OperatorError "PATH: HOST, process PID writes it" if it is held, or "PATH: cannot be
  /// written: ..." if there can be no such file.
  explicit TableLock(const std::string& table);
  ~TableLock();
  TableLock(const TableLock&) = delete;
  TableLock& operator=(const TableLock&) = delete;

 private:
  std::string path_;
  int fd_ = -1;
};

}  // namespace seam
