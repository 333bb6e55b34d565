/// Server: its room's state, for clients that join and for a server that continues the room.

#include "server/authority_source.h"
#include "server/chronicle.h"
#include "server/room_state.h"
#include "server/rules/rules.h"
#include "server/saved/log_tail.h"
#include "server/saved/saved_mark.h"
#include "server/server.h"
#include "server/server_commands.h"

namespace seam {

RoomState Server::State() {
  return RoomState({room_, epoch_, replica_, authority_, *edits_, seat_bonds_, bounds_, ladder_,
                    sessions_, clock_, settings_.table(), rule_source_.get(), rules_.get()});
}

Bytes Server::Save(std::int64_t now_us) { return State().Save(now_us); }

StateDraft Server::CopyState(std::int64_t now_us, std::size_t expected_bytes) {
  chronicle_->SumSoon();  // the log behind the snapshot has it, for a server that goes on
  StateDraft copy = State().Copy(now_us, expected_bytes);
  broadcast_.NoteAccepted(now_us, 0, -1, SavedMark(replica_.tick()));
  return copy;
}

Status Server::Resume(const SavedRoom& saved, std::int64_t now_us, const LogTail* tail) {
  std::vector<int> present;
  Status status = State().Load(saved, now_us, &present);
  if (!status.ok()) return status;
  if (tail != nullptr) present.insert(present.end(), tail->present.begin(), tail->present.end());
  if (tail != nullptr && started()) {
    ReplayTail(now_us, *tail, &present);
    clock_.GoOn(now_us, replica_.tick());
  }
  if (commands_ != nullptr) commands_->TakeSaid();  // scripts have run their code once more
  if (tail != nullptr && tail->summary) {
    chronicle_->SumKilled(now_us, *tail->summary, present, rules_.get());
  }
  chronicle_->SayResumed(now_us);
  // The loaded room is as at a barrier; a log that goes on does not have it yet.
  const bool follows = tail != nullptr && !tail->ticks.empty() && !EndsWithSavedMark(*tail);
  if (started() && !follows) broadcast_.NoteAccepted(now_us, 0, -1, SavedMark(replica_.tick()));
  for (const Meta& meta : settings_.table().Export(now_us, replica_.tick()))
    broadcast_.Publish(meta);
  // The log has all of it, so that a server that goes on from it does the same.
  TakeAllBack(now_us);
  NoteAuthority(now_us);
  for (const int player : present) {
    if (rules_ != nullptr) rules_->OnLeave(player);
    broadcast_.NoteAccepted(now_us, 0, player, Bye());
    LetGo(now_us, player, 0);
  }
  return status;
}

Status Server::Follow(const SavedRoom& saved, std::int64_t now_us) {
  broadcast_.Mute(true);
  replayed_present_.clear();
  return State().Load(saved, now_us, &replayed_present_);
}

void Server::TakeAllBack(std::int64_t now_us) {
  bool held = false, wanted = false;
  for (int m = 0; m < replica_.authority().count(); ++m) {
    held = held || replica_.authority().at(m).authority != 0;
    wanted = wanted || authority_.Wanted(m) != 0;
  }
  for (int peer = 1; held && peer < kPeersMax; ++peer) authority_.TakeBack(now_us, peer);
  if (held || wanted) authority_.PlanSoon();  // before anything is given to a peer that has gone
}

void Server::SendWorld(std::int64_t now_us, Session& session) {
  // Half a world would be another world: a client that cannot be sent all of it has to leave.
  bool sent = true;
  const auto send = [&](const auto& messages) {
    for (const auto& message : messages) {
      sent = sent && session.link.SendReliable(Encode(message));
    }
  };
  const RoomState state = State();
  const std::vector<Snapshot> edits = state.Edits(now_us);
  sent = edits.size() <= static_cast<std::size_t>(kSnapshotPartsMax);
  send(edits);
  if (input_room_ == nullptr) {  // else its world follows when the client is ready
    send(state.Authority(now_us));
    broadcast_.NoteTold(session.peer);
    send(state.Bodies(now_us));
    send(state.Resting(now_us));
  }
  send(state.Metadata(now_us));
  if (!standby_.address.empty()) send(std::vector<Redirect>{standby_});
  if (!sent) sessions_.Leave(session, "the world is more than can be sent to it");
}

void Server::SendBodies(std::int64_t now_us, Session& session) {
  if (input_room_ != nullptr) return;
  const RoomState state = State();
  for (const States& states : state.Bodies(now_us)) session.link.SendReliable(Encode(states));
  for (const Rest& rest : state.Resting(now_us)) session.link.SendReliable(Encode(rest));
}

}  // namespace seam
