/// Every scene, saved and loaded: the loaded room continues with the same bits.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "server/rules/rules.h"
#include "tests/support/lone_room.h"

namespace seam {
namespace room_state_scenes_test {

/// Not a tick at which states are sent: Save makes a barrier of its own.
constexpr std::int64_t kSavedAt = 97;
constexpr std::int64_t kOn = 90;

std::vector<std::string> ScenesIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Saves a room at a tick, continues it and a server that has loaded it.
void ExpectSameCourse(const std::string& file, std::int64_t saved_at, std::int64_t on,
                      const std::string& method = "buffer") {
  SCOPED_TRACE(file + " " + method);
  LoneRoom room(LoadScene(file), method);
  room.StepTo(saved_at);
  const Bytes bytes = room.Save();
  LoneRoom loaded(bytes, method);
  ASSERT_TRUE(loaded.server != nullptr) << loaded.status.why();
  ASSERT_EQ(loaded.server->tick(), saved_at);
  ASSERT_EQ(loaded.Hash(), room.Hash());
  for (std::int64_t i = 0; i < on; ++i) {
    room.Step();
    loaded.Step();
    ASSERT_EQ(loaded.Hash(), room.Hash()) << "in tick " << room.server->tick();
  }
  EXPECT_EQ(loaded.server->replica().revision(), room.server->replica().revision());
  if (room.server->rules() != nullptr) {
    EXPECT_EQ(loaded.server->rules()->metadata().values(),
              room.server->rules()->metadata().values());
  }
  // What is saved of both, edits and waiting times included.
  EXPECT_EQ(loaded.Save() == room.Save(), true);
}

TEST(RoomStateScenes, ALoadedRoomContinuesWithTheSameBits) {
  for (const std::string& file : ScenesIn("scenes")) ExpectSameCourse(file, kSavedAt, kOn);
}

TEST(RoomStateScenes, ALoadedHardRoomContinuesWithTheSameBits) {
  for (const std::string& file : ScenesIn("scenes/hard")) ExpectSameCourse(file, kSavedAt, kOn);
}

TEST(RoomStateScenes, ALoadedExactRoomContinuesWithTheSameBits) {
  for (const std::string& file : ScenesIn("scenes/exact")) ExpectSameCourse(file, kSavedAt, kOn);
}

TEST(RoomStateScenes, ALoadedRoomOfAnyModeContinuesWithTheSameBits) {
  for (const char* method : {"central", "strict", "buffer/fade", "buffer/snap"}) {
    for (const char* scene : {"crossing", "gluehouse", "regatta", "dockside"}) {
      ExpectSameCourse("scenes/" + std::string(scene) + ".toml", kSavedAt, kOn, method);
    }
  }
}

}  // namespace room_state_scenes_test
}  // namespace seam
