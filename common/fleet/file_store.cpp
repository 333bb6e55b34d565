/// A KeyStore in one JSON file: FOLDER/directory.json. Who changes it holds the flock of
/// FOLDER/directory.lock and replaces the file as a whole, so that who reads it needs no lock.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "common/base/check.h"
#include "common/base/entropy.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/fleet/folder_lock.h"
#include "common/fleet/key_store.h"

namespace seam {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Most writes of one change: all of a fleet's keys. Each change writes the whole file.
constexpr std::size_t kFleetWritesMost = 200000;

struct FileLease {
  std::int64_t ttl_us = 0, until_us = 0;  // until: since 1970
};

struct FileState {
  /// Of the last change, and the number of the last lease. A new file begins at a random one: then
  /// nobody takes a lease for the one that had its number in a file that was lost.
  std::int64_t revision = 0;
  std::map<std::int64_t, FileLease> leases;
  std::map<std::string, KeyValue> keys;
};

bool FromJson(const Json& all, FileState* state) {
  const auto whole = [](const Json& object, const char* name, std::int64_t* value) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number_integer()) return false;
    *value = found->get<std::int64_t>();
    return *value >= 0;
  };
  if (!all.is_object() || !whole(all, "revision", &state->revision)) return false;
  const auto leases = all.find("leases"), keys = all.find("keys");
  if (leases == all.end() || keys == all.end() || !leases->is_array() || !keys->is_object()) {
    return false;
  }
  for (const Json& each : *leases) {
    std::int64_t id = 0;
    FileLease lease;
    if (!each.is_object() || !whole(each, "id", &id) || !whole(each, "ttl_us", &lease.ttl_us) ||
        !whole(each, "until_us", &lease.until_us)) {
      return false;
    }
    state->leases[id] = lease;
  }
  for (const auto& [key, each] : keys->items()) {
    KeyValue entry;
    entry.key = key;
    const auto value = each.find("value");
    if (!each.is_object() || value == each.end() || !value->is_string() ||
        !whole(each, "changed", &entry.changed) || !whole(each, "lease", &entry.lease)) {
      return false;
    }
    entry.value = value->get<std::string>();
    state->keys[key] = entry;
  }
  return true;
}

std::string ToText(const FileState& state) {
  Json all{{"revision", state.revision}};
  all["leases"] = Json::array();
  all["keys"] = Json::object();
  for (const auto& [id, lease] : state.leases) {
    all["leases"].push_back({{"id", id}, {"ttl_us", lease.ttl_us}, {"until_us", lease.until_us}});
  }
  for (const auto& [key, entry] : state.keys) {
    all["keys"][key] = {{"value", entry.value}, {"changed", entry.changed}, {"lease", entry.lease}};
  }
  return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Removes the leases that have ended, with their keys.
void EndLeases(std::int64_t now_us, FileState* state) {
  for (auto lease = state->leases.begin(); lease != state->leases.end();) {
    lease = lease->second.until_us <= now_us ? state->leases.erase(lease) : std::next(lease);
  }
  for (auto key = state->keys.begin(); key != state->keys.end();) {
    const std::int64_t lease = key->second.lease;
    const bool ended = lease != 0 && state->leases.count(lease) == 0;
    key = ended ? state->keys.erase(key) : std::next(key);
  }
}

class FileStore : public KeyStore {
 public:
  explicit FileStore(const std::string& folder)
      : folder_(folder),
        path_((fs::path(folder) / "directory.json").string()),
        lock_((fs::path(folder) / "directory.lock").string()) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw OperatorError("--directory file:" + folder + ": " + error.message());
  }

  Status List(const std::string& prefix, std::vector<KeyValue>* found) override {
    FileState state;
    const Status status = Read(&state);
    for (auto key = state.keys.lower_bound(prefix);
         status.ok() && key != state.keys.end() && key->first.rfind(prefix, 0) == 0; ++key) {
      found->push_back(key->second);
    }
    return status;
  }

  Status Commit(const std::vector<KeyCondition>& conditions, const std::vector<KeyWrite>& writes,
                bool* done) override {
    *done = false;
    return Change([&](FileState* state, bool* changed) {
      for (const KeyCondition& condition : conditions) {
        if (!Holds(*state, condition)) return Status::Ok();
      }
      for (const KeyWrite& write : writes) {
        if (write.value && write.lease != 0 && state->leases.count(write.lease) == 0) {
          return Status::Error(path_ + ": the lease has ended");
        }
      }
      ++state->revision;
      for (const KeyWrite& write : writes) {
        state->keys.erase(write.key);
        if (write.value) {
          state->keys[write.key] = {write.key, *write.value, state->revision, write.lease};
        }
      }
      *done = *changed = true;
      return Status::Ok();
    });
  }

  std::size_t writes_most() const override { return kFleetWritesMost; }

  Status Grant(int ttl_s, std::int64_t* lease) override {
    return Change([&](FileState* state, bool* changed) {
      *changed = true;
      *lease = ++state->revision;
      const std::int64_t ttl_us = std::int64_t{ttl_s} * 1000000;
      state->leases[*lease] = {ttl_us, WallClockUs() + ttl_us};
      return Status::Ok();
    });
  }

  Status KeepAlive(std::int64_t lease, bool* alive) override {
    return Change([&](FileState* state, bool* changed) {
      const auto found = state->leases.find(lease);
      *alive = *changed = found != state->leases.end();
      if (*alive) found->second.until_us = WallClockUs() + found->second.ttl_us;
      return Status::Ok();
    });
  }

  Status Revoke(std::int64_t lease) override {
    return Change([&](FileState* state, bool* changed) {
      *changed = state->leases.erase(lease) > 0;
      EndLeases(WallClockUs(), state);
      return Status::Ok();
    });
  }

 private:
  static bool Holds(const FileState& state, const KeyCondition& condition) {
    const auto found = state.keys.find(condition.key);
    const bool there = found != state.keys.end();
    switch (condition.is) {
      case KeyCondition::Is::kAbsent: return !there;
      case KeyCondition::Is::kPresent: return there;
      case KeyCondition::Is::kValue: return there && found->second.value == condition.value;
      case KeyCondition::Is::kChangedAt:
        return (there ? found->second.changed : 0) == condition.changed;
    }
    return false;
  }

  /// Reads the file under the lock, lets `act` change it, and writes it if `changed` is set.
  template <class Act>
  Status Change(const Act& act) {
    return lock_.With(LockMode(), [&] {
      FileState state;
      Status status = Read(&state);
      if (!status.ok()) return status;
      bool changed = false;
      status = act(&state, &changed);
      return status.ok() && changed ? Replace(ToText(state)) : status;
    });
  }

  /// The file's mode: read and written by those who may read and write the folder; the umask takes
  /// its part from it.
  mode_t FileMode() const {
    struct stat status {};
    return stat(folder_.c_str(), &status) == 0 ? status.st_mode & 0666 : 0600;
  }
  /// Only those who may write the folder may hold its lock.
  mode_t LockMode() const {
    const mode_t writes = FileMode() & 0222;
    return writes | (writes << 1);
  }

  /// Reads the file, without the leases that have ended.
  Status Read(FileState* state) const {
    std::error_code unknown;
    const bool there = fs::exists(path_, unknown);
    if (unknown) return Status::Error(path_ + ": cannot be read: " + unknown.message());
    if (!there) {
      state->revision = static_cast<std::int64_t>(OsEntropy().Next() >> 2);
      return Status::Ok();
    }
    std::string text;
    try {
      text = ReadPlainFile(path_, kStoreBytesMax);
    } catch (const OperatorError& error) {
      return Status::Error(error.what());
    }
    const Json all = Json::parse(text, nullptr, false);
    if (!FromJson(all, state)) return Status::Error(path_ + ": is damaged");
    EndLeases(WallClockUs(), state);
    return Status::Ok();
  }

  Status Replace(const std::string& text) const {
    const std::string unfinished = path_ + ".tmp";
    unlink(unfinished.c_str());  // of another user, who was killed
    const int fd = open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, FileMode());
    bool good = fd >= 0;
    for (std::size_t at = 0; good && at < text.size();) {
      const ssize_t now = write(fd, text.data() + at, text.size() - at);
      if (now < 0 && errno == EINTR) continue;
      good = now > 0;
      at += good ? static_cast<std::size_t>(now) : 0;
    }
    good = good && fdatasync(fd) == 0;
    if (fd >= 0) close(fd);
    good = good && std::rename(unfinished.c_str(), path_.c_str()) == 0;
    if (good) return Status::Ok();
    return Status::Error(path_ + ": cannot be written: " + std::strerror(errno));
  }

  const std::string folder_, path_;
  FolderLock lock_;
};

}  // namespace

std::unique_ptr<KeyStore> OpenFileStore(const std::string& folder) {
  return std::make_unique<FileStore>(folder);
}

}  // namespace seam
