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
