#include "tests/lab/experiment/table_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "common/base/check.h"
#include "common/base/plain_file.h"

namespace seam {
namespace {

/// True if `path` still names the open file: a holder removes it as it ends.
bool IsAt(const std::string& path, int fd) {
  struct stat open {
  }, named{};
  return fstat(fd, &open) == 0 && stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

std::string ThisProcess() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  return std::string(host.data()) + ", process " + std::to_string(getpid());
}

}  // namespace

TableLock::TableLock(const std::string& table) : path_(table + ".lock") {
  RequirePlainFile(path_);
  do {
    if (fd_ >= 0) close(fd_);
    fd_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd_ < 0) throw OperatorError(table + ": cannot be written: " + std::strerror(errno));
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    if (fcntl(fd_, F_OFD_SETLK, &whole) != 0) {
      std::array<char, 300> holder{};
      const ssize_t bytes = pread(fd_, holder.data(), holder.size() - 1, 0);
      close(fd_);
      throw OperatorError(table + ": " + (bytes > 0 ? holder.data() : "another process") +
                          " writes it");
    }
  } while (!IsAt(path_, fd_));
  const std::string holder = ThisProcess();
  if (ftruncate(fd_, 0) != 0 || pwrite(fd_, holder.data(), holder.size(), 0) < 0) {
    const int error = errno;
    close(fd_);
    throw OperatorError(table + ": cannot be written: " + std::strerror(error));
  }
}

TableLock::~TableLock() {
  unlink(path_.c_str());
  close(fd_);
}

}  // namespace seam
