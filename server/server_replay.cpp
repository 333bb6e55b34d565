/// Server: does the end of a room's log again, for a room that is resumed.

#include "server/authority_source.h"
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

}  // namespace seam
