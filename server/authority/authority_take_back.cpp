/// AuthorityManager: takes mechanisms back without the holder's consent.

#include "common/sync/lease.h"
#include "server/authority/authority_manager.h"

namespace seam {

bool AuthorityManager::IsOverdue(std::int64_t now_us, int m) const {
  const Memory& memory = memory_[m];
  if (memory.hand_over != HandOver::kRevoking) return false;
  const bool answers = now_us - memory.unanswered_us <= kReleasePatienceUs ||
                       now_us - memory.revoked_us <= kAnswerPatienceUs;
  return !answers;
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
    replica_.authority().Set(m, record);
    sleeping_index_.Take(m);
    ForgetQuestions(m);
  }
  if (mechanisms.empty()) return {};
  replica_.RolesChanged();
  return table().Export(now_us, replica_.tick(), mechanisms);
}

}  // namespace seam
