#include "common/sync/audit/divergences.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace seam {

void Divergences::Note(std::int32_t id, std::int64_t tick, int holder, const BodyState& off,
                       int missing) {
  const Greatest found{tick, holder, missing, off.position.norm(), off.velocity.norm()};
  const auto [greatest, is_first] = greatest_.try_emplace(id, found);
  if (!is_first && found.size() > greatest->second.size()) greatest->second = found;
}

std::optional<Divergence> Divergences::Take(std::int64_t now_us, int peer, std::int64_t tick) {
  if (greatest_.empty()) return std::nullopt;
  using Entry = std::pair<std::int32_t, Greatest>;
  std::vector<Entry> all(greatest_.begin(), greatest_.end());
  greatest_.clear();
  const std::size_t count = std::min(all.size(), kDivergenceMax);
  std::nth_element(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count) - 1, all.end(),
      [](const Entry& a, const Entry& b) { return a.second.size() > b.second.size(); });
  Divergence out;
  out.utime = now_us;
  out.peer = peer;
  out.tick = tick;
  out.more = static_cast<std::int32_t>(all.size() - count);
  all.resize(count);
  std::sort(all.begin(), all.end(),
            [](const Entry& a, const Entry& b) { return a.first < b.first; });
  for (const auto& [id, greatest] : all) {
    out.body.push_back(id);
    out.at.push_back(greatest.tick);
    out.holder.push_back(static_cast<std::int16_t>(greatest.holder));
    out.missing.push_back(static_cast<std::int16_t>(greatest.missing));
    out.apart.push_back(greatest.apart);
    out.kick.push_back(greatest.kick);
  }
  return out;
}

}  // namespace seam
