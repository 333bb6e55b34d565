#include "server/input_room.h"

#include <algorithm>
#include <utility>

#include "common/base/state_archive.h"
#include "common/sync/inputs/world_pieces.h"
#include "common/sync/settings/live_settings.h"

namespace seam {

InputRoom::InputRoom(const SyncConfig& config, Replica& replica, SessionTable& sessions,
                     Broadcast& broadcast)
    : config_(config),
      replica_(replica),
      sessions_(sessions),
      broadcast_(broadcast),
      present_(replica.world().scene().players.size(), 0),
      delays_(config.input_delay_ticks),
      chooser_(config.tick_hz, present_.size()) {}

void InputRoom::Write(std::int64_t now_us, int player, std::int64_t up_to) {
  while (replica_.inputs(player).newest() < up_to) {
    Inputs neutral;
    neutral.utime = now_us;
    neutral.player = player;
    neutral.first_tick = std::max<std::int64_t>(0, replica_.inputs(player).newest()) + 1;
    const auto count = static_cast<std::size_t>(std::min<std::int64_t>(
        up_to - neutral.first_tick + 1, static_cast<std::int64_t>(kInputsMax)));
    neutral.drive.assign(count, 0);
    neutral.lift.assign(count, 0);
    neutral.buttons.assign(count, 0);
    replica_.RecordInputs(neutral);
    broadcast_.Publish(neutral);
  }
}

void InputRoom::NoteLeft(int player) {
  present_[static_cast<std::size_t>(player)] = 0;
  chooser_.Forget(static_cast<std::size_t>(player));
}

void InputRoom::WriteAbsent(std::int64_t now_us) {
  for (std::size_t p = 0; p < present_.size(); ++p) {
    if (present_[p] == 0) Write(now_us, static_cast<int>(p), replica_.tick() + 1 + kAhead);
  }
}

void InputRoom::GiveWorlds(std::int64_t now_us, const EditLog& edits) {
  const bool barrier = replica_.tick() % BarrierEvery(config_.tick_hz) == 0;
  if (awaits_world_.empty() || !barrier || replica_.edits_pending()) return;
  for (const int peer : std::exchange(awaits_world_, {})) {
    Session* const session = sessions_.Find(peer);
    if (session == nullptr || session->stage != SessionStage::kReady) continue;
    const int player = session->player;
    if (player >= 0 && present_[static_cast<std::size_t>(player)] == 0) {
      Write(now_us, player, replica_.tick() + delays_.newest());
      present_[static_cast<std::size_t>(player)] = 1;
    }
    if (!GiveWorld(now_us, edits, *session)) {
      sessions_.Leave(*session, "the world is more than can be sent to it");
    }
  }
}

bool InputRoom::GiveWorld(std::int64_t now_us, const EditLog& edits, Session& session) {
  StateArchive archive;
  replica_.Persist(archive, Replica::Past::kNone);
  const Bytes world = archive.Take();
  bool sent = true;
  const auto send = [&](const auto& message) {
    sent = sent && session.link.SendReliable(Encode(message));
  };
  for (const Snapshot& part : edits.History(now_us)) send(part);
  const std::vector<Chunk> pieces = ToWorldPieces(ByteView(world.data(), world.size()), now_us);
  for (const Chunk& piece : pieces) send(piece);
  return sent && !pieces.empty();
}

void InputRoom::NoteDue(std::int64_t now_us, const RoomClock& clock) {
  if (!config_.policy->AdaptsInputDelay()) return;
  for (; clock.DueUs(due_tick_ + 1) <= now_us; ++due_tick_) {
    due_us_[static_cast<std::size_t>((due_tick_ + 1) % kDueKept)] = clock.DueUs(due_tick_ + 1);
  }
}

void InputRoom::NoteArrived(std::int64_t now_us, const Inputs& fresh) {
  if (!config_.policy->AdaptsInputDelay()) return;
  // Clients that waited under an earlier delay read inputs late, for a moment longer.
  const std::int64_t first = delays_.newest_from() + SettingLead(config_.tick_hz);
  for (std::size_t i = 0; i < fresh.drive.size(); ++i) {
    const std::int64_t read = delays_.ReadTick(fresh.first_tick + static_cast<std::int64_t>(i));
    if (read < first || read > due_tick_ || read <= due_tick_ - kDueKept) continue;
    const std::int64_t read_us = due_us_[static_cast<std::size_t>(read % kDueKept)];
    chooser_.Note(static_cast<std::size_t>(fresh.player), now_us - read_us);
  }
}

std::optional<int> InputRoom::ChooseDelay() {
  // Not before the last change counts: until then its inputs are on their way.
  const std::int64_t due = chosen_tick_ + 2 * SettingLead(config_.tick_hz);
  if (!config_.policy->AdaptsInputDelay() || replica_.tick() < due) return std::nullopt;
  chosen_tick_ = replica_.tick();
  return chooser_.Choose(delays_.newest());
}

void InputRoom::NoteDelay(int ticks) {
  delays_.Change(replica_.tick() + 1 + SettingLead(config_.tick_hz), ticks);
  chooser_.ForgetAll();
}

bool InputRoom::HasParted(const Ping& ping) const {
  const std::int64_t tick = ping.rest_part;
  if (tick <= 0 || ping.revision != replica_.revision()) return false;
  const std::optional<std::uint64_t> hash = replica_.PastHash(tick);
  return hash && static_cast<std::int64_t>(*hash) != ping.rest;
}

}  // namespace seam
