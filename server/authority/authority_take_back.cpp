/// AuthorityManager: takes mechanisms back without the holder's consent; its state as bytes.

#include "common/base/state_archive.h"
#include "common/sync/lease.h"
#include "server/authority/authority_manager.h"

namespace seam {

bool AuthorityManager::IsOverdue(std::int64_t now_us, int m) const {
  const Memory& memory = memory_[m];
  if (memory.hand_over != HandOver::kRevoking) return false;
  if (memory.told_us < 0) return now_us - memory.asked_us > kTellPatienceUs;
  return now_us - memory.unanswered_us > kReleasePatienceUs &&
         now_us - memory.told_us > kAnswerPatienceUs;
}

void AuthorityManager::NoteTold(std::int64_t now_us, int m) {
  Memory& memory = memory_[m];
  const auto holder = static_cast<std::size_t>(table().at(m).authority);
  const std::int64_t sent_us = holder < sent_us_.size() ? sent_us_[holder] : now_us;
  if (memory.told_us >= 0 || sent_us <= memory.asked_us) return;
  memory.told_us = now_us;
  if (memory.unanswered_us < 0) memory.unanswered_us = now_us;
}

PeerSet AuthorityManager::OverdueHolders(std::int64_t now_us) const {
  PeerSet peers;
  for (const int m : open_) {
    if (IsOverdue(now_us, m)) peers.Add(table().at(m).authority);
  }
  return peers;
}

std::vector<Grants> AuthorityManager::TakeBack(std::int64_t now_us, int peer) {
  std::vector<int> had;
  for (int m = 0; m < table().count(); ++m) {
    if (table().at(m).authority == peer) had.push_back(m);
  }
  return TakeBack(now_us, had);
}

std::vector<Grants> AuthorityManager::TakeBack(std::int64_t now_us,
                                               const std::vector<int>& mechanisms) {
  plan_due_ = true;
  for (const int m : mechanisms) {
    AuthorityRecord record = table().at(m);
    Memory& memory = memory_[m];
    record.secondaries.Remove(record.authority);
    record.authority = 0;
    record.epoch += memory.hand_over != HandOver::kNone ? 2 : 1;  // a revocation used up one
    memory.hand_over = HandOver::kNone;
    SetRecord(m, record);
    sleeping_index_.Take(m);
    ForgetQuestions(m);
  }
  if (mechanisms.empty()) return {};
  replica_.RolesChanged();
  return table().Export(now_us, replica_.tick(), mechanisms);
}

void AuthorityManager::Assume(const Grants& own) {
  std::size_t follower = 0;
  for (std::size_t i = 0; i < own.mechanism.size(); ++i) {
    AuthorityRecord record;
    record.authority = own.authority[i];
    record.epoch = own.epoch[i];
    for (int n = 0; n < own.followers[i]; ++n) record.secondaries.Add(own.follower[follower++]);
    const int m = table().IndexOf(own.mechanism[i]);
    if (m >= 0 && record.epoch >= table().at(m).epoch) replica_.authority().Set(m, record);
  }
  replica_.RolesChanged();
}

void AuthorityManager::Persist(StateArchive& a) {
  a.Section("hand-overs");
  a.Exactly(&memory_, [&](Memory* memory) {
    a.Int(&memory->hand_over, 0, static_cast<std::int64_t>(HandOver::kOvertaken));
    a.Int(&memory->held_from, -1, INT32_MAX);
    a.Tick(&memory->keep_until_tick);
    a.Int(&memory->last_authority, 0, kPeersMax - 1);
    a.Tick(&memory->changed_tick);
    a.Tick(&memory->fell_tick);
    a.Flag(&memory->open);
    a.Real(&memory->contested);
  });
  a.List(&plan_, static_cast<std::size_t>(memory_.size()), [&](PlannedAuthority* planned) {
    a.Int(&planned->authority, 0, kPeersMax - 1);
    planned->secondaries.Persist(a);
    a.Flag(&planned->decided);
  });
  a.Int(&see_all_, 0, INT32_MAX);
  a.Flag(&plan_due_);
  a.Flag(&follows_all_);
  if (!a.reading()) return;
  const auto count = static_cast<std::size_t>(memory_.size());
  a.Require(plan_.empty() || plan_.size() == count, "a plan of other mechanisms");
  open_.clear();
  for (int m = 0; m < memory_.size(); ++m) {
    if (plan_.empty()) memory_[m].open = false;
    if (memory_[m].open) open_.push_back(m);
  }
}

/// Returns the plan of the mechanisms after an edit, until the next one is made.
AuthorityPlan AuthorityManager::PlanAfter(const BodyRemap& change) const {
  if (plan_.empty()) return {};
  AuthorityPlan after(change.mechanisms.size());
  for (std::size_t m = 0; m < after.size(); ++m) {
    for (const int before : change.mechanisms[m]) {
      const PlannedAuthority& planned = plan_[static_cast<std::size_t>(before)];
      const bool decided = after[m].decided || planned.decided;
      if (before == change.mechanisms[m].front()) after[m] = planned;
      after[m].decided = decided;
    }
  }
  return after;
}

}  // namespace seam
