#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/record/log_bytes.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

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

std::FILE* LogWriter::Open(const std::string& path, bool force) {
  std::FILE* const file = OpenPlainFile(path, force ? FileUse::kReplace : FileUse::kCreate);
  if (file != nullptr) return file;
  if (errno == EEXIST) ThrowExists(path);
  ThrowNotCreated(path, errno);
}

LogWriter::LogWriter(const std::string& path, bool force) : path_(path), file_(Open(path, force)) {}

LogWriter::~LogWriter() { std::fclose(file_); }

void LogWriter::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
  if (!FitsLog(channel, message)) {
    Fail("a message of " + std::to_string(message.size) + " bytes does not fit a log");
    return;
  }
  errno = 0;
  Bytes event;
  AppendEvent(&event, number_, utime, channel, message);
  if (std::fwrite(event.data(), 1, event.size(), file_) == event.size()) {
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
