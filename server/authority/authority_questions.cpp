/// AuthorityManager: who may what, for those who ask.

#include "server/authority/authority_manager.h"

namespace seam {

int AuthorityManager::Wanted(int mechanism) const {
  const auto m = static_cast<std::size_t>(mechanism);
  return m < plan_.size() ? plan_[m].authority : table().at(mechanism).authority;
}

bool AuthorityManager::Follows(int peer, int body) const {
  return table().at(replica_.world().mechanism(body)).secondaries.Has(peer);
}

bool AuthorityManager::InOneHand(const std::vector<int>& mechanisms) const {
  for (const int m : mechanisms) {
    if (memory_[static_cast<std::size_t>(m)].hand_over != HandOver::kNone) return false;
    if (table().at(m).authority != table().at(mechanisms.front()).authority) return false;
  }
  return true;
}

AuthorityManager::Right AuthorityManager::RightToMove(int peer, int body,
                                                      std::int32_t epoch) const {
  const AuthorityRecord& record = table().at(replica_.world().mechanism(body));
  if (record.authority == peer) {
    const auto m = static_cast<std::size_t>(replica_.world().mechanism(body));
    const std::int32_t from = memory_[m].held_from < 0 ? record.epoch : memory_[m].held_from;
    // Each question took one, in which nobody had it.
    const bool held = epoch >= from && epoch <= record.epoch && (record.epoch - epoch) % 2 == 0;
    return held ? Right::kYes : Right::kStale;
  }
  return epoch < record.epoch ? Right::kStale : Right::kNo;
}

}  // namespace seam
