#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <variant>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

/// Least bytes per read of the file.
constexpr std::size_t kLogReadBytes = 256 * 1024;

template <class T>
T GetBigEndian(const std::uint8_t* from) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value = value << 8 | from[i];
  return static_cast<T>(value);
}

}  // namespace

struct LogReader::Header {
  std::int64_t number, timestamp_us;
  std::size_t channel_bytes, data_bytes;
  std::int64_t end;  ///< end of the event in the file
};

void LogReader::Open(std::size_t segment) {
  const std::string& path = segments_[segment].path;
  std::FILE* const file = OpenPlainFile(path, FileUse::kRead);
  if (file == nullptr) throw OperatorError(path + ": cannot be opened: " + std::strerror(errno));
  if (file_ != nullptr) std::fclose(file_);
  file_ = file;
  struct stat status = {};
  size_bytes_ = fstat(fileno(file_), &status) == 0 ? static_cast<std::int64_t>(status.st_size) : 0;
  segment_ = segment;
  window_.clear();
}

LogReader::LogReader(const std::string& path, const Secret* key) : check_(LogPlace(), key) {
  const std::string log = LogNamed(path);
  segments_ = ListSegments(log);
  if (segments_.empty()) segments_ = {{0, log}};
  Open(0);
  if (FindHeader(0, size_bytes_) == size_bytes_ && segments_.size() == 1) {
    std::fclose(file_);
    throw OperatorError(path + ": not an LCM log: no event in it");
  }
}

LogReader::LogReader(const std::string& path, const LogPlace& from, const Secret* key)
    : segments_(ListSegments(path, from.segment)), at_(from.bytes), check_(from, key) {
  const LogSegment first = {from.segment, SegmentPath(path, from.segment)};
  if (segments_.empty() || segments_[0].number != first.number) {
    segments_.insert(segments_.begin(), first);
  }
  Open(0);
  if (from.bytes <= size_bytes_) return;
  std::fclose(file_);
  throw OperatorError(first.path + ": is shorter than it was");
}

LogReader::~LogReader() { std::fclose(file_); }

/// Returns the `bytes` bytes at `at`, valid until the next call; null when the file ends before or
/// cannot be read. Reading a header outside the window does not move the window.
const std::uint8_t* LogReader::Peek(std::int64_t at, std::size_t bytes) {
  if (at < 0 || at > size_bytes_ || bytes > static_cast<std::size_t>(size_bytes_ - at)) return {};
  const std::int64_t inside = at - window_at_;
  if (inside >= 0 && static_cast<std::size_t>(inside) + bytes <= window_.size()) {
    return window_.data() + inside;
  }
  if (bytes <= sizeof peeked_header_) {
    return ReadAt(at, peeked_header_, bytes) == bytes ? peeked_header_ : nullptr;
  }
  const auto left = static_cast<std::size_t>(size_bytes_ - at);
  window_.resize(std::min(left, std::max(bytes, kLogReadBytes)));
  window_at_ = at;
  window_.resize(ReadAt(at, window_.data(), window_.size()));
  return window_.size() >= bytes ? window_.data() : nullptr;
}

std::size_t LogReader::ReadAt(std::int64_t at, std::uint8_t* to, std::size_t bytes) {
  const ssize_t got = pread(fileno(file_), to, bytes, static_cast<off_t>(at));
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

/// Returns true if an event may begin at `at`: magic (if it matters), lengths in bounds, a
/// printable channel, and all of it within the file.
bool LogReader::ReadHeader(std::int64_t at, bool magic_matters, Header* header) {
  const std::uint8_t* bytes = Peek(at, kLogHeaderBytes);
  if (bytes == nullptr) return false;
  if (magic_matters && GetBigEndian<std::uint32_t>(bytes) != kLogMagic) return false;
  const auto channel_bytes = GetBigEndian<std::uint32_t>(bytes + 20);
  const auto data_bytes = GetBigEndian<std::uint32_t>(bytes + 24);
  if (channel_bytes < 1 || channel_bytes > kChannelBytesMax) return false;
  if (data_bytes > kLogDataBytesMax) return false;
  header->number = GetBigEndian<std::int64_t>(bytes + 4);
  header->timestamp_us = GetBigEndian<std::int64_t>(bytes + 12);
  header->channel_bytes = channel_bytes;
  header->data_bytes = data_bytes;
  header->end = at + static_cast<std::int64_t>(kLogHeaderBytes + channel_bytes + data_bytes);
  if (header->end > size_bytes_) return false;
  const std::int64_t channel_at = at + static_cast<std::int64_t>(kLogHeaderBytes);
  const std::uint8_t* channel = Peek(channel_at, channel_bytes);
  return channel != nullptr && std::all_of(channel, channel + channel_bytes,
                                           [](std::uint8_t c) { return c >= 0x20 && c < 0x7f; });
}

/// Returns the first position in [from, to) at which an event may begin; `to` if there is none.
std::int64_t LogReader::FindHeader(std::int64_t from, std::int64_t to) {
  constexpr std::uint8_t kMagicFirst = kLogMagic >> 24;
  while (from < to) {
    // A stretch that is in the window or fits into it, and never goes beyond `to`.
    const auto left = static_cast<std::size_t>(to - from);
    const std::size_t stretch = std::min(left, kLogReadBytes / 2);
    const std::uint8_t* bytes = Peek(from, stretch);
    if (bytes == nullptr) return to;
    const std::uint8_t* hit = std::find(bytes, bytes + stretch, kMagicFirst);
    from += hit - bytes;
    Header header;
    if (hit == bytes + stretch) continue;
    if (ReadHeader(from, true, &header)) return from;
    ++from;
  }
  return to;
}

/// Returns true if the bytes at `end` confirm that an event ends there: the end of the file, a
/// magic, or a header with only its magic damaged (its own event is followed by another).
bool LogReader::FollowedByEvent(std::int64_t end) {
  const auto good_end = [this](std::int64_t at) {
    if (at == size_bytes_) return true;
    const std::uint8_t* magic = Peek(at, 4);
    return magic != nullptr && GetBigEndian<std::uint32_t>(magic) == kLogMagic;
  };
  Header next;
  return good_end(end) || (ReadHeader(end, false, &next) && good_end(next.end));
}

/// Returns true if the lengths in the header at `at` are wrong because another event begins within
/// this one. If an event follows at this one's end, the inner one must have the next number (a
/// message may contain a piece of another log); if none follows, any inner event will do. If there
/// is neither, the damage lies after this event.
bool LogReader::ContainsNextEvent(std::int64_t at, const Header& header) {
  const std::int64_t inner_at = FindHeader(at + 1, header.end);
  if (inner_at == header.end) return false;
  Header inner;
  const bool next = ReadHeader(inner_at, true, &inner) && header.number < inner.number &&
                    header.number + 1 == inner.number;
  return next || !FollowedByEvent(header.end);
}

bool LogReader::Next(LogEvent* event) {
  for (;;) {
    if (NextInSegment(event)) {
      if (keyframe_seals_ == 0) return true;
      if (event->channel.find(".chain") == std::string::npos) continue;
      const AnyMessage any = Decode(event->data);
      if (std::holds_alternative<LogSeal>(any)) --keyframe_seals_;
      continue;
    }
    if (segment_ + 1 == segments_.size()) return false;
    try {
      Open(segment_ + 1);
    } catch (const OperatorError&) {  // it has gone since
      check_.NoteSkipped();
      return false;
    }
    at_ = 0;
    check_.BeginSegment();
    keyframe_seals_ = 2;  // it stands between two seals
  }
}

bool LogReader::NextInSegment(LogEvent* event) {
  const std::int64_t expected = at_;
  Header header;
  for (;; ++at_) {
    at_ = FindHeader(at_, size_bytes_);
    if (at_ == size_bytes_ || !ReadHeader(at_, true, &header)) break;
    if (!ContainsNextEvent(at_, header)) break;
  }
  if (at_ != expected) {
    ++damaged_places_;
    check_.NoteSkipped();
    skipped_bytes_ += at_ - expected;
  }
  if (at_ == size_bytes_) return false;
  const std::int64_t start = at_;
  Bytes head(kLogHeaderBytes);
  if (const std::uint8_t* bytes = Peek(start, kLogHeaderBytes))
    head.assign(bytes, bytes + kLogHeaderBytes);
  event->number = header.number;
  event->timestamp_us = header.timestamp_us;
  const std::int64_t body = at_ + static_cast<std::int64_t>(kLogHeaderBytes);
  const std::uint8_t* bytes = Peek(body, header.channel_bytes + header.data_bytes);
  if (bytes == nullptr) return false;  // the file has shrunk meanwhile
  event->channel.assign(reinterpret_cast<const char*>(bytes), header.channel_bytes);
  event->data.assign(bytes + header.channel_bytes,
                     bytes + header.channel_bytes + header.data_bytes);
  check_.Note(head, *event);
  at_ = header.end;
  return true;
}

}  // namespace seam
