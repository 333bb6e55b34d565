#include "server/hub/lcm_bridge.h"

#include <utility>

#include "common/base/process.h"
#include "common/scene/lcm/lcm_tables.h"
#include "server/rules/rules.h"

namespace seam {

LcmBridge::LcmBridge(Server& server, Bus& bus)
    : server_(server),
      bus_(bus),
      inbox_(kMessagesPerS, kMessagesAtOnce,
             [this](const std::string& channel, ByteView bytes) {
               LcmHeard heard{channel, {}};
               const Status status = Decode(bytes, &heard.message);
               if (!status.ok() || server_.rules()->Queue(std::move(heard))) return status;
               return Status::Error("is one too many for this tick");
             }),
      poses_(bus, -1) {
  for (const std::string& channel : server.scene().lcm->message) inbox_.Subscribe(bus, channel);
}

void LcmBridge::Listen(std::int64_t now_us) {
  inbox_.SetTime(now_us);
  bus_.Poll(0);
}

void LcmBridge::Publish() {
  const World& world = server_.replica().world();
  if (!poses_.Publishes(world.scene())) return;
  poses_.Publish(world, server_.tick(), 0, WallClockUs(),
                 [&](int body) { return world.Read(body); });
}

}  // namespace seam
