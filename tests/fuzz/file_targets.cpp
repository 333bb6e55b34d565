#include <unistd.h>

#include <cstdio>
#include <string>

#include "client/embed/cluster.h"
#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/record/log_sessions.h"
#include "common/record/recording.h"
#include "common/record/room_log.h"
#include "tests/fuzz/targets.h"
#include "tests/support/lone_room.h"

namespace seam {
namespace {

/// A file of this process in memory.
class FuzzFile {
 public:
  FuzzFile() : path_("/dev/shm/seam-fuzz-" + std::to_string(getpid())) {}
  ~FuzzFile() { std::remove(path_.c_str()); }
  const std::string& Write(ByteView bytes) const {
    std::FILE* const file = std::fopen(path_.c_str(), "wb");
    SEAM_ASSERT(file != nullptr);
    std::fwrite(bytes.data, 1, bytes.size, file);
    std::fclose(file);
    return path_;
  }
  const std::string& path() const { return path_; }

 private:
  const std::string path_;
};

}  // namespace

void TakeLog(ByteView bytes) {
  static const FuzzFile file;
  try {
    const Recording recording = ReadRecording(file.Write(bytes));
    Hole(recording.damage.empty() && recording.sessions.size() == 1 &&
         recording.last_tick - recording.first_tick < 5 && recording.last_tick >= 0);
  } catch (const OperatorError& error) {
    if (std::string(error.what()).find_first_of("\n\r\x1b") != std::string::npos) std::abort();
  }
}

std::vector<Bytes> LogSeeds() {
  std::vector<Bytes> seeds;
  for (const char* scene : {"crossing", "gluehouse"}) {
    const std::string path = "/dev/shm/seam-fuzz-seed-" + std::to_string(getpid());
    {
      RoomLog log(path, true, nullptr);
      ClusterConfig config;
      config.scene = scene;
      config.recorder = &log;
      config.duration_s = 0.2;
      Cluster cluster(config);
      cluster.Run();
    }
    const std::string text = ReadPlainFile(path, 1 << 24);
    seeds.emplace_back(text.begin(), text.end());
    std::remove(path.c_str());
  }
  return seeds;
}

void TakeSnapshot(ByteView bytes) {
  try {
    LoneRoom room(Bytes(bytes.data, bytes.data + bytes.size), "buffer");
    if (room.server == nullptr) return;
    for (int i = 0; i < 5; ++i) room.Step();
    Hole(room.server->tick() % 64 == 13);
  } catch (const OperatorError&) {
  }
}

std::vector<Bytes> SnapshotSeeds() {
  std::vector<Bytes> seeds;
  for (const char* scene : {"scenes/crossing.toml", "scenes/dockside.toml"}) {
    LoneRoom room(LoadScene(scene));
    room.StepTo(20);
    seeds.push_back(room.Save());
  }
  return seeds;
}

}  // namespace seam
