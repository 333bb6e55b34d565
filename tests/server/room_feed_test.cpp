/// A room's scene on the bus and in the log, again and again for late listeners.

#include "server/room_feed.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

#include "common/net/memory.h"
#include "common/record/recording.h"
#include "common/sync/method.h"
#include "server/server.h"

namespace seam {
namespace room_feed_test {

/// A bus with a log: it counts what each of them gets.
class Heard : public Recorder {
 public:
  void Publish(const std::string& channel, std::int64_t, ByteView message) override {
    ++logged[channel];
    builder.Add(channel, message);
  }
  void Repeat(const std::string& channel, std::int64_t, ByteView message) override {
    ++repeated[channel];
    builder.Add(channel, message);
  }
  void EndTick(const std::string&, const LogSeal&, bool) override {}
  RecordingBuilder builder;
  std::map<std::string, int> logged, repeated;
};

/// Runs a server that waits for its players for 65 s.
std::unique_ptr<Heard> Wait(const std::string& comment) {
  Scene scene = LoadScene("scenes/crossing.toml");
  scene.text += comment;
  auto heard = std::make_unique<Heard>();
  MemoryNetwork network;
  SeededEntropy entropy(7);
  const std::unique_ptr<Net> net = network.Attach({1, 7777});
  ServerConfig config;
  config.sync = MakeSyncConfig(MethodNames{"buffer", "", ""});
  Server server(scene, config, *net, *heard, entropy);
  for (std::int64_t now_us = 0; now_us < 65000000; now_us += 10000) server.Tick(now_us, 0);
  return heard;
}

TEST(RoomFeed, TellsTheBusEachSecondAndTheLogEachThirtieth) {
  const std::unique_ptr<Heard> heard = Wait("");
  EXPECT_EQ(heard->logged["SEAM.main.scene"], 3);
  EXPECT_EQ(heard->repeated["SEAM.main.scene"], 62);
  const Recording& recording = heard->builder.recording();
  EXPECT_EQ(recording.duplicates, 0);
  EXPECT_EQ(recording.bus_gaps, 0);
  EXPECT_EQ(recording.undecodable, 0);
  EXPECT_FALSE(recording.mixed);
}

TEST(RoomFeed, LogsAllPartsOfALongSceneInOneRoundOfThirty) {
  std::string comment = "\n#";
  for (int i = 0; i < 40000; ++i) comment += std::to_string(i * 7919 % 100003);
  const std::unique_ptr<Heard> heard = Wait(comment);
  const int parts = heard->logged["SEAM.main.scene_part"] / 3;
  EXPECT_GE(parts, 2);
  EXPECT_EQ(heard->logged["SEAM.main.scene_part"], 3 * parts);
  EXPECT_EQ(heard->repeated["SEAM.main.scene_part"], 62 * parts);
  EXPECT_EQ(heard->builder.recording().room.scene_text.size(),
            LoadScene("scenes/crossing.toml").text.size() + comment.size());
}

}  // namespace room_feed_test
}  // namespace seam
