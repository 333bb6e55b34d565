#include <cerrno>
#include <cstring>

#include "common/base/check.h"
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

}  // namespace

LogWriter::LogWriter(const std::string& path, bool force) {
  file_ = std::fopen(path.c_str(), force ? "wb" : "wbx");
  if (file_ != nullptr) return;
  if (errno == EEXIST) {
    throw OperatorError(path + ": exists; choose another name, remove it, or allow overwriting");
  }
  throw OperatorError(path + ": cannot be created: " + std::strerror(errno));
}

LogWriter::~LogWriter() { std::fclose(file_); }

void LogWriter::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
  if (channel.empty() || channel.size() > kChannelBytesMax || message.size > kLogDataBytesMax) {
    ++failures_;
    return;
  }
  std::uint8_t header[kLogHeaderBytes];
  std::uint8_t* to = PutBigEndian(header, kLogMagic);
  to = PutBigEndian(to, static_cast<std::uint64_t>(number_));
  to = PutBigEndian(to, static_cast<std::uint64_t>(utime));
  to = PutBigEndian(to, static_cast<std::uint32_t>(channel.size()));
  PutBigEndian(to, static_cast<std::uint32_t>(message.size));
  const bool written =
      std::fwrite(header, 1, sizeof header, file_) == sizeof header &&
      std::fwrite(channel.data(), 1, channel.size(), file_) == channel.size() &&
      std::fwrite(message.data, 1, message.size, file_) == message.size;
  if (written) {
    ++number_;
  } else {
    ++failures_;
  }
}

void LogWriter::Flush() {
  if (std::fflush(file_) != 0) ++failures_;
}

}  // namespace seam
