/// Client: inputs and settings of its next tick.

#include <algorithm>

#include "client/client.h"
#include "common/sync/inputs/input_source.h"

namespace seam {

void Client::RecordOwnInput() {
  if (player_ < 0) return;
  const std::int64_t next = replica_->tick() + 1;
  Input input;
  switch (config_.drive) {
    case Drive::kNone: break;
    case Drive::kScript: {
      for (std::size_t p = 0; p < scene_->players.size(); ++p) {
        if (scene_->players[p].name == config_.script_of) {
          input = ScriptedInput(*scene_, static_cast<int>(p), next);
        }
      }
      break;
    }
    case Drive::kBot: input = BotInput(room_.seed, player_, next, room_.tick_hz); break;
    case Drive::kLive: input = live_; break;
  }
  // An input read for this tick acts in a later one; before the first of those, input is neutral.
  // After a change of the delay the newest input is held, or ticks that have one keep it.
  const std::int64_t acts =
      next + settings_.At(kMetaInputDelay, next).value_or(room_.input_delay_ticks);
  const InputTrack& track = replica_->inputs(player_);
  const Input held = track.newest() + 1 >= next ? track.At(track.newest()) : Input{};
  for (std::int64_t tick = std::max(next, track.newest() + 1); tick < acts; ++tick) {
    replica_->RecordInput(player_, tick, held);
  }
  replica_->RecordInput(player_, acts, input);
  if (!(input == Input{})) idle_since_ = next;
}

void Client::FollowSettings() {
  const std::int64_t next = replica_->tick() + 1;
  settings_.Forget(next);
  if (const std::optional<int> age = settings_.At(kMetaShowAge, next)) replica_->ShowAtMost(*age);
}

void Client::RecordKnownInputs() {
  const std::int64_t next = replica_->tick() + 1;
  const auto all = policy_->KnownInputs(*scene_, next, room_.input_delay_ticks);
  for (const Inputs& inputs : all) replica_->RecordInputs(inputs);
}

}  // namespace seam
