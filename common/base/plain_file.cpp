#include "common/base/plain_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "common/base/check.h"
#include "common/base/files_read.h"

namespace seam {
namespace {

/// Bytes per read.
constexpr std::size_t kReadBytes = 65536;

void RequirePlain(const std::string& path, mode_t mode) {
  if (S_ISREG(mode)) return;
  const char* kind = S_ISFIFO(mode)   ? "a FIFO"
                     : S_ISSOCK(mode) ? "a socket"
                     : S_ISDIR(mode)  ? "a folder"
                                      : "a device";
  throw OperatorError(path + ": is " + kind + ", not a regular file");
}

int FlagsOf(FileUse use) {
  switch (use) {
    case FileUse::kRead: return O_RDONLY;
    case FileUse::kReplace:
      return O_WRONLY | O_CREAT;  // emptied once it is known to be a regular file
    case FileUse::kCreate: return O_WRONLY | O_CREAT | O_EXCL;
    case FileUse::kGoOn: return O_WRONLY | O_CREAT;
    case FileUse::kAppend: return O_WRONLY | O_CREAT | O_APPEND;
  }
  SEAM_ASSERT(false);
  return 0;
}

const char* ModeOf(FileUse use) {
  return use == FileUse::kRead ? "rb" : use == FileUse::kAppend ? "ab" : "wb";
}

bool SameFile(const std::string& a, const std::string& b) {
  struct stat one {
  }, other{};
  return stat(a.c_str(), &one) == 0 && stat(b.c_str(), &other) == 0 && one.st_dev == other.st_dev &&
         one.st_ino == other.st_ino;
}

/// Owns a file descriptor; set fd to -1 to release it. Keeps errno.
struct Descriptor {
  explicit Descriptor(int number) : fd(number) {}
  ~Descriptor() {
    const int error = errno;
    if (fd >= 0) close(fd);
    errno = error;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int fd;
};

}  // namespace

void RequirePlainFile(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) RequirePlain(path, status.st_mode);
}

void RequireOutput(const std::string& path, bool force, const std::vector<std::string>& read) {
  for (const std::string& source : read) {
    if (SameFile(path, source)) throw OperatorError(path + ": is read, it cannot be written");
  }
  if (WasFileRead(path)) throw OperatorError(path + ": is read, it cannot be written");
  if (!force && access(path.c_str(), F_OK) == 0) {
    throw OperatorError(path + ": exists (--force replaces it)");
  }
  RequirePlainFile(path);
}

std::FILE* OpenPlainFile(const std::string& path, FileUse use) {
  // Check before opening: opening a device may have an effect.
  if (use != FileUse::kCreate) RequirePlainFile(path);
  // Check again after opening: the path may name another file by now. O_NONBLOCK keeps a FIFO from
  // waiting for its other end; regular files ignore it.
  Descriptor opened(open(path.c_str(), FlagsOf(use) | O_NONBLOCK | O_CLOEXEC, 0666));
  if (opened.fd < 0) return nullptr;
  struct stat status {};
  if (fstat(opened.fd, &status) != 0) return nullptr;
  RequirePlain(path, status.st_mode);
  if (use == FileUse::kReplace && ftruncate(opened.fd, 0) != 0) return nullptr;
  std::FILE* file = fdopen(opened.fd, ModeOf(use));
  if (file != nullptr) opened.fd = -1;
  return file;
}

std::string ReadPlainFile(const std::string& path, std::size_t bytes_max, const char* absent) {
  errno = 0;
  std::FILE* file = OpenPlainFile(path, FileUse::kRead);
  if (file == nullptr) {
    const bool missing = absent != nullptr && (errno == ENOENT || errno == ENOTDIR);
    throw OperatorError(path + ": " +
                        (missing ? absent : std::string("cannot be read: ") + strerror(errno)));
  }
  std::string text;
  while (text.size() < bytes_max) {
    const std::size_t before = text.size(), wanted = std::min(kReadBytes, bytes_max - before);
    text.resize(before + wanted);
    const std::size_t got = std::fread(text.data() + before, 1, wanted, file);
    text.resize(before + got);
    if (got < wanted) break;
  }
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) throw OperatorError(path + ": cannot be read");
  return text;
}

}  // namespace seam
