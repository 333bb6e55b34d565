/// Server: does the end of a room's log again, for a room that is resumed.

#include <algorithm>
#include <type_traits>
#include <variant>

#include "common/base/state_archive.h"
#include "common/codec/codec.h"
#include "server/authority_source.h"
#include "server/chronicle.h"
#include "server/rules/rules.h"
#include "server/saved/log_tail.h"
#include "server/saved/saved_mark.h"
#include "server/server.h"
#include "server/server_commands.h"

namespace seam {

void Server::ReplayTail(std::int64_t now_us, const LogTail& tail, std::vector<int>* present) {
  replayed_present_ = *present;
  for (const TickMessages& tick : tail.ticks) {
    Replay(now_us, tick);
    const auto hash = static_cast<std::uint16_t>(replica_.world().Hash());
    if (unlike_log_ < 0 && tick.hash && hash != *tick.hash) unlike_log_ = tick.tick;
  }
  for (const AnyMessage& message : tail.begun) TakeLogged(now_us, message);
  *present = replayed_present_;
  if (commands_ != nullptr) commands_->AssumePresent({});
  broadcast_.Mute(false);
}

void Server::TakeLogged(std::int64_t now_us, const AnyMessage& message) {
  if (const auto* inputs = std::get_if<Inputs>(&message)) {
    replica_.RecordInputs(*inputs);
  } else if (const auto* states = std::get_if<States>(&message)) {
    if (states->peer == 0) return;  // told, not taken
    replica_.Receive(*states);
    if (rule_source_ != nullptr) rule_source_->NoteStates(*states);
  } else if (const auto* order = std::get_if<EditOrder>(&message)) {
    if (replica_.Queue(*order)) edits_->NoteOrdered(*order);
  } else if (const auto* accepted = std::get_if<Accepted>(&message)) {
    TakeLogged(now_us, *accepted);
  }
}

void Server::TakeLogged(std::int64_t now_us, const Accepted& accepted) {
  if (LcmHeard heard; rules_ != nullptr && Decode(accepted.data, &heard).ok()) {
    rules_->OnMessage(std::move(heard));
    return;
  }
  if (IsSavedMark(accepted)) {
    ApplyQueued(now_us);
    StateArchive copy;  // writing it makes the barrier
    if (replica_.tick() > 0) replica_.Persist(copy, Replica::Past::kAll);
    return;
  }
  const AnyMessage any = Decode(accepted.data);
  if (const auto* rest = std::get_if<Rest>(&any)) {
    replica_.Receive(*rest);
  } else if (const auto* exact = std::get_if<ExactStates>(&any)) {
    replica_.TakeOver(*exact);
  } else if (const auto* grants = std::get_if<Grants>(&any)) {
    authority_.Assume(*grants);
  } else if (const auto* owner = std::get_if<Join>(&any)) {
    sessions_.places().Assume(now_us, accepted.peer, owner->name,
                              static_cast<std::uint64_t>(owner->token));
  } else if (std::holds_alternative<Ready>(any)) {
    sessions_.places().NoteBack(accepted.peer, now_us);
    if (accepted.player < 0) return;
    replayed_present_.push_back(accepted.player);
    if (rules_ != nullptr) rules_->OnJoin(accepted.player);
  } else if (std::holds_alternative<Bye>(any)) {
    std::vector<int>& in = replayed_present_;
    in.erase(std::remove(in.begin(), in.end(), accepted.player), in.end());
    if (rules_ != nullptr && accepted.player >= 0) rules_->OnLeave(accepted.player);
  } else if (rule_source_ == nullptr) {
    return;
  } else if (const auto* impacts = std::get_if<ImpactReport>(&any)) {
    rule_source_->NoteReport(accepted.peer, *impacts);
  } else if (const auto* touches = std::get_if<TouchReport>(&any)) {
    rule_source_->NoteReport(accepted.peer, *touches);
  }
}

bool Server::Replay(std::int64_t now_us, const TickMessages& log) {
  broadcast_.Mute(true);
  for (const AnyMessage& message : log.before) TakeLogged(now_us, message);
  ApplyQueued(now_us);
  replica_.Step();
  ApplyQueued(now_us);
  std::vector<Meta> values;
  for (const AnyMessage& message : log.after) {
    TakeLogged(now_us, message);
    const auto* meta = std::get_if<Meta>(&message);
    if (meta != nullptr && HoldsSettings(*meta)) {
      settings_.table().Announce(*meta);
    } else if (meta != nullptr) {
      values.push_back(*meta);
    }
  }
  for (const FoundEdit& found : replica_.TakeProposals()) edits_->Add(found.edit, found.tick);
  replica_.TakeDiffering();
  RunSeats(now_us);
  RemoveOutside(now_us);
  replica_.TakeStates();
  replica_.rest().Take();
  return rules_ == nullptr || RunRulesAgain(values);
}

void Server::Republish(const TickMessages& log) {
  std::int64_t now_us = 0;
  const auto publish = [&](const AnyMessage& any) {
    std::visit(
        [&](const auto& message) {
          using Message = std::decay_t<decltype(message)>;
          if constexpr (!std::is_same_v<Message, std::monostate>) {
            constexpr bool seals =
                std::is_same_v<Message, LogSeal> || std::is_same_v<Message, TickChain>;
            constexpr bool scene =
                std::is_same_v<Message, Room> || std::is_same_v<Message, ScenePart>;
            if constexpr (MessageTraits<Message>::kTravels != Travels::kEdge && !seals && !scene) {
              now_us = std::max(now_us, message.utime);
              broadcast_.Publish(message);
            } else if constexpr (std::is_same_v<Message, Room>) {
              room_feed_.Publish(message.utime, broadcast_);
            }
          }
        },
        any);
  };
  broadcast_.Mute(false);
  for (const AnyMessage& message : log.before) publish(message);
  broadcast_.NoteStep();
  for (const AnyMessage& message : log.after) publish(message);
  broadcast_.NoteTick();
  broadcast_.EndTick(now_us, true);
  broadcast_.Mute(true);
}

void Server::GoOn(std::int64_t now_us) {
  broadcast_.Mute(false);
  clock_.GoOn(now_us, replica_.tick());
  TakeAllBack(now_us);
  chronicle_->SayResumed(now_us);
}

void Server::TakeInputs(std::int64_t now_us, const Inputs& inputs) {
  const Inputs fresh = TakeFresh(now_us, inputs);
  if (!fresh.drive.empty()) broadcast_.Publish(fresh);
}

/// Returns false if the values are not those of the log.
bool Server::RunRulesAgain(const std::vector<Meta>& values) {
  commands_->AssumePresent(replayed_present_);
  rule_source_->NoteTick(replica_.TakeTouches());
  rules_->AfterTick();
  if (rules_->WantTouches()) replica_.WatchTouches();
  commands_->TakeSaid();
  bool same = true;
  const std::vector<Meta> again = rules_->TakeChanges(0);
  same = again.size() == values.size();
  for (std::size_t i = 0; same && i < values.size(); ++i) {
    same = again[i].kind == values[i].kind && again[i].id == values[i].id &&
           again[i].key == values[i].key && again[i].value == values[i].value;
  }
  for (const Meta& meta : values) rules_->Correct(meta);
  return same;
}

}  // namespace seam
