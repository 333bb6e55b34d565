#include "common/net/secret_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/base/check.h"
#include "common/base/hex.h"

namespace seam {
namespace {

constexpr std::size_t kKeyDigits = 2 * Secret::kSecretBytes;

/// A file descriptor that is closed at its end.
struct OpenedFile {
  OpenedFile(const std::string& flag, const std::string& path, int flags)
      : name(flag + " " + path), fd(open(path.c_str(), flags | O_NOFOLLOW | O_CLOEXEC, 0600)) {
    if (fd < 0) Refuse(errno == ELOOP ? "is a symbolic link" : std::strerror(errno));
  }
  ~OpenedFile() { close(fd); }
  OpenedFile(const OpenedFile&) = delete;
  OpenedFile& operator=(const OpenedFile&) = delete;
  [[noreturn]] void Refuse(const std::string& why) const { throw OperatorError(name + ": " + why); }

  const std::string name;
  const int fd;
};

}  // namespace

Secret ReadSecretFile(const std::string& flag, const std::string& path) {
  // Without O_NONBLOCK a FIFO would block until it has a writer.
  const OpenedFile file(flag, path, O_RDONLY | O_NONBLOCK);
  struct stat info {};
  if (fstat(file.fd, &info) != 0) file.Refuse(std::strerror(errno));
  if (!S_ISREG(info.st_mode)) file.Refuse("is no plain file");
  if (info.st_uid != geteuid()) file.Refuse("belongs to somebody else");
  if ((info.st_mode & 077) != 0) file.Refuse("others may read or write it (chmod 600)");
  std::string text(kKeyDigits + 2, 0);
  const ssize_t bytes = pread(file.fd, &text[0], text.size(), 0);
  if (bytes < 0) file.Refuse(std::strerror(errno));
  text.resize(static_cast<std::size_t>(bytes));
  if (!text.empty() && text.back() == '\n') text.pop_back();
  Secret secret;
  const bool good = FromHex(text, secret.data(), Secret::kSecretBytes);
  Wipe(&text[0], text.size());
  if (!good) file.Refuse("does not hold a key of 64 digits (seam-token --make-key makes one)");
  return secret;
}

Secret KeepSecretFile(const std::string& flag, const std::string& path, Entropy& entropy) {
  struct stat info {};
  if (lstat(path.c_str(), &info) == 0 || errno != ENOENT) return ReadSecretFile(flag, path);
  const Secret secret(entropy);
  MakeSecretFile(flag, path, secret);
  return secret;
}

void MakeSecretFile(const std::string& flag, const std::string& path, const Secret& secret) {
  const OpenedFile file(flag, path, O_WRONLY | O_CREAT | O_EXCL);
  std::string text = ToHex(secret.data(), Secret::kSecretBytes) + "\n";
  const bool whole = write(file.fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  Wipe(&text[0], text.size());
  if (!whole) file.Refuse("cannot be written");
}

}  // namespace seam
