#include "client/lcm_link.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/process.h"
#include "common/codec/lcm_types.h"
#include "common/scene/lcm/lcm_tables.h"

namespace seam {
namespace {

/// Returns an axis as inputs have it.
std::int8_t AxisOf(double value) { return static_cast<std::int8_t>(std::lround(value * 127)); }

}  // namespace

LcmLink::LcmLink(Bus& bus, std::string drive)
    : bus_(bus),
      drive_(std::move(drive)),
      inbox_(kDrivesPerS, kDrivesAtOnce, [this](const std::string&, ByteView bytes) {
        LcmDrive message;
        const Status status = Decode(bytes, &message);
        if (!status.ok()) return status;
        newest_ = {AxisOf(message.drive), AxisOf(message.lift),
                   static_cast<std::int16_t>(message.buttons)};
        heard_us_ = now_us_;
        return status;
      }) {}

Status LcmLink::Open(const Scene& scene, const std::string& name) {
  const auto& players = scene.players;
  const auto found = std::find_if(players.begin(), players.end(),
                                  [&](const Player& player) { return player.name == name; });
  const int player = found == players.end() ? -2 : static_cast<int>(found - players.begin());
  poses_.emplace(bus_, player);
  std::string channel = drive_;
  for (const LcmDriving& driving : scene.lcm->drive) {
    if (channel.empty() && driving.player == player) channel = driving.channel;
  }
  if (channel.empty()) {
    return Status::Error("the scene has no [[lcm.drive]] for player " + name +
                         ": --drive lcm:CHANNEL names a channel");
  }
  inbox_.Subscribe(bus_, channel);
  return Status::Ok();
}

Status LcmLink::Follow(const Client& client) {
  const Replica* const replica = client.replica();
  if (replica == nullptr) return Status::Ok();
  const World& world = replica->world();
  if (!poses_) {
    const Status opened = Open(world.scene(), client.name());
    if (!opened.ok()) return opened;
  }
  if (!client.running() || !poses_->Publishes(world.scene())) return Status::Ok();
  std::optional<View> view;
  poses_->Publish(world, replica->tick(), client.peer(), WallClockUs(), [&](int body) {
    if (!view) view = replica->MakeView();
    const auto i = static_cast<std::size_t>(body);
    return BodyState{
        {view->x[i], view->y[i]}, view->angle[i], {view->vx[i], view->vy[i]}, view->spin[i]};
  });
  return Status::Ok();
}

void LcmLink::Report(const char* program, ProgressLine& line) {
  for (const std::string& refused : inbox_.TakeReports()) {
    line.End();
    PrintError(program, refused);
  }
}

Input LcmLink::Read(std::int64_t now_us) {
  now_us_ = now_us;
  inbox_.SetTime(now_us);
  bus_.Poll(0);
  return heard_us_ != 0 && now_us - heard_us_ <= kStaleUs ? newest_ : Input();
}

}  // namespace seam
