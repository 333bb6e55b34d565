#include "server/saved/snapshot_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <tuple>

#include "common/base/check.h"
#include "common/base/files/list_folder.h"
#include "common/base/plain_file.h"
#include "common/net/crc32c.h"
#include "common/record/segments/log_segments.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

constexpr char kSnapshotMagic[8] = {'S', 'E', 'A', 'M', 'S', 'N', 'A', 'P'};
constexpr const char* kSnapshotEnding = ".snapshot";
/// Stands in a file's name before the epoch; no room's name has a dot.
constexpr const char* kEpochMark = ".e";
/// Most bytes read of a snapshot, normal 1 MB.
constexpr std::size_t kSnapshotBytesMax = std::size_t{1} << 30;

struct FileHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t crc;
  std::int64_t tick;
  std::int64_t log_bytes, log_number;
  std::uint32_t log_crc;
  std::uint32_t log_segment;   // 0 before version 3
  KeyedChain::Hash log_keyed;  // not in version 1
};
/// The checksum is of all bytes behind itself.
constexpr std::size_t kCheckedFrom = 16;

std::uint32_t ChecksumOf(ByteView header, ByteView room) {
  return Crc32c(room, Crc32c({header.data + kCheckedFrom, header.size - kCheckedFrom}));
}

std::string SnapshotPath(const std::string& folder, const std::string& stem, std::int64_t tick) {
  char number[32];
  std::snprintf(number, sizeof number, "%012lld", static_cast<long long>(tick));
  return (fs::path(folder) / (stem + "-" + number + kSnapshotEnding)).string();
}

/// Reads up to 18 digits.
bool ReadDigits(const std::string& text, std::int64_t* number) {
  const bool digits = !text.empty() && text.size() <= 18 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  if (digits) *number = std::atoll(text.c_str());
  return digits;
}

/// Writes a file; with `sync` waits for the disk.
Status WriteWhole(const std::string& path, ByteView a, ByteView b, bool sync) {
  const auto failed = [&](int error) {
    return Status::Error(path + ": cannot be written: " + std::strerror(error));
  };
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) return failed(errno);
  int error = 0;
  for (ByteView left : {a, b}) {
    while (error == 0 && left.size > 0) {
      const ssize_t now = write(fd, left.data, left.size);
      if (now < 0 && errno == EINTR) continue;
      if (now <= 0) {
        error = now == 0 ? ENOSPC : errno;
        break;
      }
      left = {left.data + now, left.size - static_cast<std::size_t>(now)};
    }
  }
  if (error == 0 && sync && fsync(fd) != 0) error = errno;
  if (close(fd) != 0 && error == 0) error = errno;
  return error == 0 ? Status::Ok() : failed(error);
}

/// Reads "ROOM-TICK.snapshot" or "ROOM.eEPOCH-TICK.snapshot"; false if it is none.
bool ParseName(const fs::path& path, SnapshotName* file) {
  const std::string name = path.stem().string(), mark = kEpochMark;
  const std::size_t dash = name.rfind('-');
  if (path.extension() != kSnapshotEnding || dash == std::string::npos) return false;
  const std::size_t dot = std::min(name.find(mark), dash);
  std::int64_t epoch = 1;
  if (dot < dash) {
    const std::string digits = name.substr(dot + mark.size(), dash - dot - mark.size());
    if (!ReadDigits(digits, &epoch) || epoch <= 1 || epoch > INT32_MAX) return false;
  }
  file->path = path.string();
  file->room = name.substr(0, dot);
  file->epoch = static_cast<std::int32_t>(epoch);
  return IsName(file->room) && ReadDigits(name.substr(dash + 1), &file->tick);
}

}  // namespace

std::string StemOf(const std::string& room, std::int32_t epoch) {
  return epoch <= 1 ? room : room + kEpochMark + std::to_string(epoch);
}

std::vector<SnapshotName> ListSnapshots(const std::string& folder, const std::string& room,
                                        std::error_code* error) {
  std::vector<SnapshotName> all;
  std::error_code ignored;
  for (const fs::path& path : ListFolder(folder, error != nullptr ? *error : ignored)) {
    SnapshotName file;
    if (ParseName(path, &file) && (room.empty() || file.room == room)) all.push_back(file);
  }
  std::sort(all.begin(), all.end(), [](const SnapshotName& a, const SnapshotName& b) {
    return std::tie(a.epoch, a.tick) > std::tie(b.epoch, b.tick);
  });
  return all;
}

namespace {

Status Write(const std::string& folder, const std::string& room, const RoomSnapshot& snapshot,
             std::int32_t epoch, bool sync) {
  FileHeader header{};
  std::memcpy(header.magic, kSnapshotMagic, sizeof kSnapshotMagic);
  header.version = snapshot.log.segment == 0 ? kSnapshotVersion - 1 : kSnapshotVersion;
  header.tick = snapshot.tick;
  header.log_bytes = snapshot.log.bytes;
  header.log_number = snapshot.log.number;
  header.log_crc = snapshot.log.crc;
  header.log_segment = static_cast<std::uint32_t>(snapshot.log.segment);
  header.log_keyed = snapshot.log.keyed;
  const ByteView head(reinterpret_cast<const std::uint8_t*>(&header), sizeof header);
  header.crc = ChecksumOf(head, snapshot.room);
  const std::string path = SnapshotPath(folder, StemOf(room, epoch), snapshot.tick);
  const std::string unfinished = path + ".tmp";
  Status status = WriteWhole(unfinished, head, snapshot.room, sync);
  if (status.ok() && std::rename(unfinished.c_str(), path.c_str()) != 0) {
    status = Status::Error(path + ": cannot be written: " + std::strerror(errno));
  }
  if (!status.ok()) std::remove(unfinished.c_str());
  return status;
}

void RemoveOlder(const std::string& folder, const std::string& room) {
  const std::vector<SnapshotName> all = ListSnapshots(folder, room);
  for (std::size_t i = kSnapshotsKept; i < all.size(); ++i) std::remove(all[i].path.c_str());
}

}  // namespace

Status WriteSnapshot(const std::string& folder, const std::string& room,
                     const RoomSnapshot& snapshot, std::int32_t epoch) {
  Status status = Write(folder, room, snapshot, epoch, true);
  if (!status.ok()) return status;
  SyncFolderOf(SnapshotPath(folder, StemOf(room, epoch), snapshot.tick));
  RemoveOlder(folder, room);
  return status;
}

Status PlaceSnapshot(const std::string& folder, const std::string& room,
                     const RoomSnapshot& snapshot, std::int32_t epoch) {
  return Write(folder, room, snapshot, epoch, false);
}

Status SyncSnapshot(const std::string& folder, const std::string& room, std::int64_t tick,
                    std::int32_t epoch) {
  const std::string path = SnapshotPath(folder, StemOf(room, epoch), tick);
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int error = fd >= 0 && fsync(fd) == 0 ? 0 : errno;
  if (fd >= 0) close(fd);
  if (error != 0) return Status::Error(path + ": cannot be written: " + std::strerror(error));
  SyncFolderOf(path);
  RemoveOlder(folder, room);
  return Status::Ok();
}

Status ReadSnapshot(const std::string& path, RoomSnapshot* snapshot) {
  std::string bytes;
  try {
    bytes = ReadPlainFile(path, kSnapshotBytesMax);
  } catch (const OperatorError& error) {
    return Status::Error(error.what());
  }
  const auto refuse = [&](const std::string& why) { return Status::Error(path + ": " + why); };
  FileHeader header{};
  std::size_t head = offsetof(FileHeader, log_keyed);
  if (bytes.size() < head) return refuse("is damaged: it is too short");
  std::memcpy(&header, bytes.data(), head);
  if (std::memcmp(header.magic, kSnapshotMagic, sizeof kSnapshotMagic) != 0) {
    return refuse("is damaged, or no snapshot");
  }
  if (header.version < 1 || header.version > kSnapshotVersion) {
    return refuse("is of version " + std::to_string(header.version) + ", this server reads " +
                  std::to_string(kSnapshotVersion));
  }
  if (header.version > 1) head = sizeof header;
  if (bytes.size() < head) return refuse("is damaged: it is too short");
  std::memcpy(&header, bytes.data(), head);
  const ByteView all = TextBytes(bytes);
  const ByteView room(all.data + head, all.size - head);
  if (header.crc != ChecksumOf({all.data, head}, room)) return refuse("is damaged");
  snapshot->tick = header.tick;
  if (header.log_segment > INT32_MAX) return refuse("is damaged");
  snapshot->log = {header.log_bytes, header.log_number,
                   header.log_crc,   header.log_keyed,
                   header.tick,      static_cast<std::int32_t>(header.log_segment)};
  snapshot->room.assign(room.begin(), room.end());
  return Status::Ok();
}

}  // namespace seam
