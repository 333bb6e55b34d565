#include "server/sessions/account_book.h"

#include <algorithm>

namespace seam {

void ClientAccount::Read(std::int64_t read_rtt_us, std::int64_t read_loss_ppm) {
  if (read_rtt_us < 0) return;
  ++readings;
  rtt_us_sum += read_rtt_us;
  rtt_us_max = std::max(rtt_us_max, read_rtt_us);
  loss_ppm_sum += read_loss_ppm;
}

void ClientAccount::NotePresent(std::int64_t tick, int change) {
  present_ticks_ = PresentTicks(tick);
  present_since_ = std::max<std::int64_t>(0, tick);
  present_ = std::max(0, present_ + change);
}

std::int64_t ClientAccount::PresentTicks(std::int64_t tick) const {
  return present_ticks_ + present_ * std::max<std::int64_t>(0, tick - present_since_);
}

ClientAccount& AccountBook::Of(const std::string& name) {
  const bool known = accounts_.count(name) != 0;
  const std::string kept = known || accounts_.size() + 1 < kAccountsMax ? name : "others";
  ClientAccount& account = accounts_[kept];
  account.name = kept;
  return account;
}

std::vector<ClientAccount> AccountBook::List() const {
  std::vector<ClientAccount> list;
  for (const auto& [name, account] : accounts_) list.push_back(account);
  std::stable_sort(list.begin(), list.end(),
                   [](const ClientAccount& a, const ClientAccount& b) { return a.peer < b.peer; });
  return list;
}

}  // namespace seam
