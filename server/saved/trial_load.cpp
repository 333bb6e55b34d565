#include "server/saved/trial_load.h"

#include "common/net/memory.h"
#include "common/scene/scene.h"
#include "common/sync/method.h"

namespace seam {
namespace {

class Unheard : public Recorder {
 public:
  void Publish(const std::string&, std::int64_t, ByteView) override {}
  bool listening() const override { return false; }
};

}  // namespace

ServerConfig ConfigOf(const Room& room) {
  ServerConfig config;
  config.sync = MakeSyncConfig(MethodNames{room.mode, room.reconcile, room.predict});
  config.sync.input_delay_ticks = room.input_delay_ticks;
  config.sync.tick_hz = room.tick_hz;
  config.sync.send_hz = room.send_hz;
  config.sync.seed = config.seed = room.seed;
  config.room = room.room;
  return config;
}

Status CanLoad(const SavedRoom& saved, std::int64_t* tick) {
  ServerConfig config = ConfigOf(saved.room());
  config.publish = Publish::kNone;
  MemoryNetwork network;
  const std::unique_ptr<Net> net = network.Attach({1, 1});
  Unheard unheard;
  SeededEntropy entropy(1);
  Server server(saved, config, *net, unheard, entropy);
  const Status status = server.Resume(saved, 1000000);
  if (status.ok() && tick != nullptr) *tick = server.tick();
  return status;
}

Bytes SaveUnbegun(const Room& room) {
  ServerConfig config = ConfigOf(room);
  config.publish = Publish::kNone;
  MemoryNetwork network;
  const std::unique_ptr<Net> net = network.Attach({1, 1});
  Unheard unheard;
  SeededEntropy entropy(1);
  Server server(ParseScene(room.scene_text, room.scene_name), config, *net, unheard, entropy);
  server.GoOn(0);
  return server.Save(0);
}

}  // namespace seam
