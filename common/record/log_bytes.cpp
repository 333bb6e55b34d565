#include "common/record/log_bytes.h"

#include <algorithm>

#include "common/record/log_file.h"

namespace seam {
namespace {

template <class T>
void PutBigEndian(Bytes* to, T value) {
  for (int shift = static_cast<int>(sizeof(T)) * 8 - 8; shift >= 0; shift -= 8) {
    to->push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

}  // namespace

void AppendEvent(Bytes* log, std::int64_t number, std::int64_t utime, const std::string& channel,
                 ByteView message) {
  PutBigEndian(log, kLogMagic);
  PutBigEndian(log, static_cast<std::uint64_t>(number));
  PutBigEndian(log, static_cast<std::uint64_t>(utime));
  PutBigEndian(log, static_cast<std::uint32_t>(channel.size()));
  PutBigEndian(log, static_cast<std::uint32_t>(message.size));
  log->insert(log->end(), channel.begin(), channel.end());
  log->insert(log->end(), message.begin(), message.end());
}

void SetEventNumber(Bytes* log, std::size_t at, std::int64_t number) {
  constexpr std::size_t kEventNumberAt = 4;
  Bytes bytes;
  PutBigEndian(&bytes, static_cast<std::uint64_t>(number));
  std::copy(bytes.begin(), bytes.end(),
            log->begin() + static_cast<std::ptrdiff_t>(at + kEventNumberAt));
}

bool FitsLog(const std::string& channel, ByteView message) {
  return !channel.empty() && channel.size() <= kChannelBytesMax && message.size <= kLogDataBytesMax;
}

}  // namespace seam
