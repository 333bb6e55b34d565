#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

template <class T>
std::uint8_t* PutBigEndian(std::uint8_t* to, T value) {
  for (int shift = static_cast<int>(sizeof(T)) * 8 - 8; shift >= 0; shift -= 8) {
    *to++ = static_cast<std::uint8_t>(value >> shift);
  }
  return to;
}

[[noreturn]] void ThrowExists(const std::string& path) {
  throw OperatorError(path + ": exists (--force replaces it)");
}

[[noreturn]] void ThrowNotCreated(const std::string& path, int error) {
  throw OperatorError(path + ": cannot be created: " + std::strerror(error));
}

}  // namespace

void LogWriter::Check(const std::string& path, bool force) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status)) {
    if (!force) ThrowExists(path);
    RequirePlainFile(path);
    if (access(path.c_str(), W_OK) != 0) ThrowNotCreated(path, errno);
    return;
  }
  std::string folder = std::filesystem::path(path).parent_path().string();
  if (folder.empty()) folder = ".";
  if (access(folder.c_str(), W_OK | X_OK) != 0) ThrowNotCreated(path, errno);
}

LogWriter::LogWriter(const std::string& path, bool force) : path_(path) {
  file_ = OpenPlainFile(path, force ? FileUse::kReplace : FileUse::kCreate);
  if (file_ != nullptr) return;
  if (errno == EEXIST) ThrowExists(path);
  ThrowNotCreated(path, errno);
}

LogWriter::~LogWriter() { std::fclose(file_); }

void LogWriter::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
  if (channel.empty() || channel.size() > kChannelBytesMax || message.size > kLogDataBytesMax) {
    Fail("a message of " + std::to_string(message.size) + " bytes does not fit a log");
    return;
  }
  errno = 0;
  std::uint8_t header[kLogHeaderBytes];
  std::uint8_t* to = PutBigEndian(header, kLogMagic);
  to = PutBigEndian(to, static_cast<std::uint64_t>(number_));
  to = PutBigEndian(to, static_cast<std::uint64_t>(utime));
  to = PutBigEndian(to, static_cast<std::uint32_t>(channel.size()));
  PutBigEndian(to, static_cast<std::uint32_t>(message.size));
  const bool written = std::fwrite(header, 1, sizeof header, file_) == sizeof header &&
                       std::fwrite(channel.data(), 1, channel.size(), file_) == channel.size() &&
                       std::fwrite(message.data, 1, message.size, file_) == message.size;
  if (written) {
    ++number_;
  } else {
    Fail(std::strerror(errno));
  }
}

void LogWriter::Fail(const std::string& why) {
  ++failures_;
  if (trouble_.ok()) trouble_ = Status::Error(path_ + ": cannot be written: " + why);
}

void LogWriter::Flush() {
  if (std::fflush(file_) != 0) Fail(std::strerror(errno));
}

}  // namespace seam
