/// Server: does the end of a room's log again, for a room that is resumed.

#include <algorithm>
#include <type_traits>
#include <variant>

#include "common/codec/codec.h"
#include "common/record/tick_splitter.h"
#include "server/authority_source.h"
#include "server/chronicle.h"
#include "server/rules/rules.h"
#include "server/saved/log_tail.h"
#include "server/server.h"
#include "server/server_commands.h"

namespace seam {

/// Does the ticks of the log again, as they were: with the accepted inputs and states, the grants
/// and the edits of the log. What rules and scripts decide anew agrees with the log, which has the
/// last word about edits and values.
void Server::ReplayTail(std::int64_t now_us, const LogTail& tail, const std::vector<int>& players) {
  broadcast_.Mute(true);
  if (commands_ != nullptr) commands_->AssumePresent(players);
  for (const auto& [tick, log] : tail.ticks) {
    if (tick > replica_.tick()) break;
    for (const Inputs& inputs : log.inputs) replica_.RecordInputs(inputs);
  }
  const LogTick nothing;
  while (replica_.tick() < tail.last_tick) {
    const auto found = tail.ticks.find(replica_.tick() + 1);
    ReplayTick(now_us, found == tail.ticks.end() ? nothing : found->second);
  }
  if (commands_ != nullptr) {
    commands_->AssumePresent({});
    commands_->TakeSaid();
  }
  broadcast_.Mute(false);
}

void Server::ReplayTick(std::int64_t now_us, const LogTick& log) {
  for (const Inputs& inputs : log.inputs) replica_.RecordInputs(inputs);
  for (const States& states : log.states) {
    replica_.Receive(states);
    if (rule_source_ != nullptr) rule_source_->NoteStates(states);
  }
  for (const EditOrder& order : log.edits) {
    if (replica_.Queue(order)) edits_->NoteOrdered(order);
  }
  ApplyQueued(now_us);
  replica_.Step();
  ApplyQueued(now_us);
  for (const FoundEdit& found : replica_.TakeProposals()) edits_->Add(found.edit, found.tick);
  replica_.TakeDiffering();
  RunSeats(now_us);
  RemoveOutside(now_us);
  for (const Grants& grants : log.grants) {
    replica_.ApplyGrants(grants);
    replica_.TakeReleased();
  }
  replica_.TakeStates();
  replica_.rest().Take();
  RunRules(now_us);
  for (const Meta& meta : log.values) {
    if (rules_ != nullptr) rules_->Correct(meta);
  }
}

/// Takes a message of the log that precedes or follows the step of its tick.
void Server::TakeLogged(const AnyMessage& message) {
  if (const auto* inputs = std::get_if<Inputs>(&message)) {
    replica_.RecordInputs(*inputs);
  } else if (const auto* states = std::get_if<States>(&message)) {
    if (states->peer == 0) return;  // told, not taken
    replica_.Receive(*states);
    if (rule_source_ != nullptr) rule_source_->NoteStates(*states);
  } else if (const auto* order = std::get_if<EditOrder>(&message)) {
    if (replica_.Queue(*order)) edits_->NoteOrdered(*order);
  } else if (const auto* accepted = std::get_if<Accepted>(&message)) {
    TakeLogged(*accepted);
  }
}

void Server::TakeLogged(const Accepted& accepted) {
  const AnyMessage any = Decode(accepted.data);
  if (const auto* rest = std::get_if<Rest>(&any)) {
    replica_.Receive(*rest);
  } else if (const auto* exact = std::get_if<ExactStates>(&any)) {
    replica_.TakeOver(*exact);
  } else if (const auto* grants = std::get_if<Grants>(&any)) {
    authority_.Assume(*grants);
  } else if (rule_source_ == nullptr) {
    return;
  } else if (const auto* impacts = std::get_if<ImpactReport>(&any)) {
    rule_source_->NoteReport(accepted.peer, *impacts);
  } else if (const auto* touches = std::get_if<TouchReport>(&any)) {
    rule_source_->NoteReport(accepted.peer, *touches);
  } else if (accepted.player < 0) {
    return;
  } else if (std::holds_alternative<Ready>(any)) {
    replayed_present_.push_back(accepted.player);
    rules_->OnJoin(accepted.player);
  } else if (std::holds_alternative<Bye>(any)) {
    std::vector<int>& in = replayed_present_;
    in.erase(std::remove(in.begin(), in.end(), accepted.player), in.end());
    rules_->OnLeave(accepted.player);
  }
}

bool Server::Replay(const TickMessages& log) {
  broadcast_.Mute(true);
  for (const AnyMessage& message : log.before) TakeLogged(message);
  ApplyQueued(0);
  replica_.Step();
  ApplyQueued(0);
  std::vector<Meta> values;
  for (const AnyMessage& message : log.after) {
    TakeLogged(message);
    if (const auto* meta = std::get_if<Meta>(&message)) values.push_back(*meta);
  }
  for (const FoundEdit& found : replica_.TakeProposals()) edits_->Add(found.edit, found.tick);
  replica_.TakeDiffering();
  RunSeats(0);
  RemoveOutside(0);
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
