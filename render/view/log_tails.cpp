#include "render/view/log_tails.h"

#include <sys/stat.h>

#include <cstdio>
#include <utility>

#include "common/base/check.h"

namespace seam {

namespace {

/// True if the file begins with an event's magic; it may be cut behind that, while it is written.
bool BeginsAsLog(const std::string& path) {
  std::FILE* const file = std::fopen(path.c_str(), "rbe");
  if (file == nullptr) return false;
  std::uint8_t magic[4] = {};
  const bool read = std::fread(magic, 1, sizeof magic, file) == sizeof magic;
  std::fclose(file);
  std::uint32_t value = 0;
  for (const std::uint8_t byte : magic) value = value << 8 | byte;
  return read && value == kLogMagic;
}

}  // namespace

LogTails::LogTails(const std::vector<std::string>& paths) {
  for (const std::string& named : paths) {
    const std::string path = LogNamed(named);
    struct stat status = {};
    if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
      throw OperatorError(path + ": is no regular file");
    }
    if (status.st_size >= 4 && !BeginsAsLog(path)) LogReader check(path);  // throws if it is none
    tails_.push_back({path, {}, nullptr, std::nullopt});
    const std::vector<LogSegment> segments = ListSegments(path);
    if (!segments.empty()) tails_.back().place.segment = segments.front().number;
  }
}

/// Reads a log's next event, if it is whole. A reader knows the file as it was when opened.
void LogTails::Fill(Tail* tail) {
  struct stat status = {};
  LogPlace& place = tail->place;
  if (tail->next || stat(SegmentPath(tail->path, place.segment).c_str(), &status) != 0) return;
  if (status.st_size < place.bytes) {
    place.bytes = 0;
    tail->reader.reset();
  }
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (tail->reader == nullptr) {
      const bool all_read = status.st_size == place.bytes;
      if (all_read && ListSegments(tail->path, place.segment + 1).empty()) return;
      tail->reader = std::make_unique<LogReader>(tail->path, place);
    }
    LogEvent event;
    if (tail->reader->Next(&event)) {
      place.bytes = tail->reader->place_bytes();
      place.segment = tail->reader->segment();
      tail->next = std::move(event);
      return;
    }
    tail->reader.reset();
  }
}

bool LogTails::Next(LogEvent* event) {
  Tail* first = nullptr;
  for (Tail& tail : tails_) {
    Fill(&tail);
    if (!tail.next) continue;
    if (first == nullptr || tail.next->timestamp_us < first->next->timestamp_us) first = &tail;
  }
  if (first == nullptr) return false;
  *event = std::move(*first->next);
  first->next.reset();
  return true;
}

}  // namespace seam
