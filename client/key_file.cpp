#include "client/key_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "common/base/check.h"

namespace seam {
namespace {

/// 16 hexadecimal digits and a line end.
constexpr std::size_t kFileBytes = 17;

[[noreturn]] void Refuse(const std::string& path, const std::string& why) {
  throw OperatorError("--key " + path + ": " + why);
}

}  // namespace

KeyFile::KeyFile(const std::string& path) : path_(path) {
  Open(0);
  if (fd_ >= 0) {
    try {
      Check();
      Read();
    } catch (...) {
      Close();
      throw;
    }
    return;
  }
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) {
    Refuse(path, std::strerror(errno));
  }
}

KeyFile::~KeyFile() { Close(); }

void KeyFile::Close() {
  if (fd_ >= 0) close(fd_);
  fd_ = -1;
}

/// Opens the file. A missing file is an error only with O_CREAT; anything but a file always is.
void KeyFile::Open(int more_flags) {
  // Without O_NONBLOCK a FIFO would block until it has a writer.
  fd_ = open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | more_flags, 0600);
  if (fd_ >= 0 || (errno == ENOENT && more_flags == 0)) return;
  Refuse(path_, errno == ELOOP ? "is a symbolic link" : std::strerror(errno));
}

void KeyFile::Check() const {
  struct stat info {};
  if (fstat(fd_, &info) != 0) Refuse(path_, std::strerror(errno));
  if (!S_ISREG(info.st_mode)) Refuse(path_, "is no plain file");
  if (info.st_uid != geteuid()) Refuse(path_, "belongs to somebody else");
  if ((info.st_mode & 077) != 0) Refuse(path_, "others may read or write it (chmod 600)");
}

void KeyFile::Read() {
  char text[kFileBytes + 2] = {};
  const ssize_t bytes = pread(fd_, text, kFileBytes + 1, 0);
  if (bytes < 0) Refuse(path_, std::strerror(errno));
  if (bytes == 0) return;
  std::uint64_t key = 0;
  int end = 0;
  const bool good = static_cast<std::size_t>(bytes) == kFileBytes &&
                    std::strspn(text, "0123456789abcdef") == kFileBytes - 1 &&
                    std::sscanf(text, "%16" SCNx64 "%n", &key, &end) == 1 && text[end] == '\n';
  if (!good) Refuse(path_, "does not hold a key");
  key_ = static_cast<std::int64_t>(key);
}

void KeyFile::Write(std::int64_t key) {
  if (fd_ < 0) Open(O_CREAT | O_EXCL);
  char text[kFileBytes + 1];
  std::snprintf(text, sizeof text, "%016" PRIx64 "\n", static_cast<std::uint64_t>(key));
  if (pwrite(fd_, text, kFileBytes, 0) != static_cast<ssize_t>(kFileBytes)) {
    Refuse(path_, std::strerror(errno));
  }
  key_ = key;
}

}  // namespace seam
