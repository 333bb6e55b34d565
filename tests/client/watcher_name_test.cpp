/// Clients that only look on, under the name of a player of the scene.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "client/client.h"
#include "common/net/memory.h"
#include "common/sync/method.h"
#include "server/server.h"

namespace seam {
namespace watcher_name_test {

struct Silence : Recorder {
  void Publish(const std::string&, std::int64_t, ByteView) override {}
};

/// A server of a room with the players ann and guest, and clients that join it.
struct LookedOn {
  explicit LookedOn(const std::string& mode = "buffer")
      : scene(ParseScene("[[player]]\nname = \"ann\"\n[[player]]\nname = \"guest\"\n"
                         "[[part]]\nname = \"ground\"\nchain = [[-9, 0], [9, 0]]\n",
                         "watched.toml")) {
    ServerConfig settings;
    settings.sync = MakeSyncConfig(MethodNames{mode, "", ""});
    settings.sync.tick_hz = scene.solver.tick_hz;
    server = std::make_unique<Server>(scene, settings, *net, silence, entropy);
  }
  Client& Add(const std::string& name, bool watch, bool numbers_name = false) {
    ClientConfig config;
    config.server = {1, 7777};
    config.name = name;
    config.watch = watch;
    config.numbers_name = numbers_name;
    nets.push_back(network.Attach({2, static_cast<std::uint16_t>(nets.size() + 1)}));
    clients.push_back(std::make_unique<Client>(config, *nets.back(), silence, entropy));
    return *clients.back();
  }
  void Run(std::int64_t us) {
    for (const std::int64_t until_us = now_us + us; now_us < until_us; now_us += 5000) {
      server->Tick(now_us, 0);
      for (const auto& client : clients) client->Tick(now_us, 0);
    }
  }

  MemoryNetwork network;
  std::unique_ptr<Net> net = network.Attach({1, 7777});
  Silence silence;
  const Scene scene;
  SeededEntropy entropy{5};
  std::unique_ptr<Server> server;
  std::vector<std::unique_ptr<Net>> nets;
  std::vector<std::unique_ptr<Client>> clients;
  std::int64_t now_us = 1000000;
};

TEST(WatcherName, APlayersNameEndsAWatcherAtOnceAndStaysFree) {
  LookedOn room;
  const Client& watcher = room.Add("ann", true);
  room.Run(500000);
  EXPECT_EQ(watcher.fatal(),
            "ann is a player of this room: to look on, take another name, or a token made with "
            "--watch");
  const Client& ann = room.Add("ann", false);
  room.Run(1000000);
  EXPECT_EQ(ann.fatal(), "");
  EXPECT_EQ(ann.peer(), 1);
  EXPECT_TRUE(ann.running());
}

TEST(WatcherName, AWatcherThatNumbersItsNameTakesTheNext) {
  LookedOn room;
  const Client& first = room.Add("guest", true, true);
  const Client& second = room.Add("guest", true, true);
  room.Run(2000000);
  std::vector<std::string> names{first.name(), second.name()};
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"guest-2", "guest-3"}));
  EXPECT_TRUE(first.running() && second.running());
  const Client& guest = room.Add("guest", false);
  room.Run(1000000);
  EXPECT_EQ(guest.peer(), 2) << guest.fatal();
}

}  // namespace watcher_name_test
}  // namespace seam
