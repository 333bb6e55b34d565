/// Client: the own player's inputs, and the server's world; in modes in which peers send inputs
/// alone, the check that all worlds are the same.

#include <algorithm>
#include <optional>

#include "client/client.h"
#include "common/base/compress.h"
#include "common/base/state_archive.h"
#include "common/sync/inputs/input_source.h"
#include "common/sync/inputs/world_pieces.h"

namespace seam {

Input Client::ReadInput(std::int64_t tick) const {
  switch (config_.drive) {
    case Drive::kNone: break;
    case Drive::kScript: {
      for (std::size_t p = 0; p < scene_->players.size(); ++p) {
        if (scene_->players[p].name != config_.script_of) continue;
        return ScriptedInput(*scene_, static_cast<int>(p), tick);
      }
      break;
    }
    case Drive::kBot: return BotInput(room_.seed, player_, tick, room_.tick_hz);
    case Drive::kLive: return live_;
  }
  return {};
}

void Client::RecordOwnInput() {
  if (player_ < 0) return;
  const std::int64_t next = replica_->tick() + 1;
  const Input input = ReadInput(next);
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

bool Client::MayStep() {
  if (policy_->InputsOnly()) RecordOwnInput();
  return replica_->MayStep();
}

void Client::OnWorldPiece(const Chunk& chunk) {
  if (chunk.offset_bytes == 0) world_bytes_.clear();
  const bool next = static_cast<std::size_t>(chunk.offset_bytes) == world_bytes_.size();
  if (replica_ == nullptr || (policy_->InputsOnly() && started_) || !next) {
    ++stats_.dropped_stale;
    return;
  }
  world_bytes_.insert(world_bytes_.end(), chunk.data.begin(), chunk.data.end());
  if (!IsWholeWorld(world_bytes_)) return;
  const Bytes world = WorldOf(std::exchange(world_bytes_, {})).value_or(Bytes());
  if (policy_->InputsOnly()) {
    BeginWith(world);
  } else if (!started_) {
    held_.AddWorld(world);
  } else if (!released_) {
    EndUnlessGood(replica_->TakeWorld(world));
  }
}

void Client::EndUnlessGood(const Status& world) {
  if (!world.ok()) fatal_ = "cannot use the server's world: " + world.why();
}

void Client::BeginWith(ByteView world) {
  StateArchive archive(world);
  // Inputs that came before the world, of later ticks: acknowledged ones do not come again.
  std::vector<Inputs> came;
  for (int p = 0; p < static_cast<int>(scene_->players.size()); ++p) {
    came.push_back(replica_->inputs(p).Export(p, static_cast<int>(kInputsMax)));
  }
  MakeReplica(&replica_->world().topology());
  replica_->Persist(archive, Replica::Past::kNone);
  if (archive.ok() && archive.left() > 0) archive.Fail("there is more than the world");
  EndUnlessGood(archive.status());
  if (!archive.ok()) return;
  for (const Inputs& inputs : came) {
    for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
      const std::int64_t tick = inputs.first_tick + static_cast<std::int64_t>(i);
      if (tick <= replica_->tick()) continue;
      replica_->RecordInput(inputs.player, tick,
                            {inputs.drive[i], inputs.lift[i], inputs.buttons[i]});
    }
  }
  world_given_ = true;
  world_tick_ = replica_->tick();
}

void Client::AddWorldHash(Ping* ping) const {
  const std::int64_t tick = replica_->newest_past() / room_.tick_hz * room_.tick_hz;
  const std::optional<std::uint64_t> hash = replica_->PastHash(tick);
  if (!hash || tick <= world_tick_) return;
  ping->rest_blocks = ping->rest_block = 0;
  ping->rest = static_cast<std::int64_t>(*hash);
  ping->rest_part = static_cast<std::int32_t>(tick);
}

}  // namespace seam
