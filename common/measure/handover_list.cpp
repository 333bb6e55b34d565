#include "common/measure/handover_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/measure/parts.h"

namespace seam {
namespace {

/// The last claim of authority over a body.
struct Claim {
  int peer = 0;
  std::int64_t tick = 0;
};

}  // namespace

std::vector<HandOverSeen> ListHandOvers(const Recording& recording,
                                        const RevisionHistory* revisions) {
  std::vector<HandOverSeen> changes;
  std::map<PartId, Claim> claims;
  const double h = TickSeconds(recording);
  for (std::int64_t tick = recording.first_tick; tick <= recording.last_tick; ++tick) {
    std::map<int, const View*> views;
    for (const auto& [peer, of_peer] : recording.views) {
      if (const View* view = FindView(of_peer, tick)) views[peer] = view;
    }
    for (const auto& [peer, view] : views) {
      for (std::size_t i = 0; i < view->id.size(); ++i) {
        if (view->role[i] != kRoleAuthority) continue;
        const PartId id = view->id[i];
        Claim& claim = claims.emplace(id, Claim{peer, tick}).first->second;
        const auto old = views.find(claim.peer);
        if (claim.peer != peer && old != views.end()) {
          if (Claims(*old->second, id)) continue;  // both may claim it for a tick
          const View& then = *old->second;
          const int k = IndexOf(then, id);
          const bool same = k >= 0 && (revisions == nullptr ||
                                       revisions->SameBody(view->revision, then.revision, id));
          if (same) {
            const BodyState a = StateIn(*view, i), b = StateIn(then, static_cast<std::size_t>(k));
            changes.push_back({tick, id, claim.peer, peer, double{(a.position - b.position).norm()},
                               double{(a.velocity - b.velocity).norm()},
                               static_cast<double>(tick - claim.tick - 1) * h});
          }
        }
        claim = {peer, tick};
      }
    }
  }
  return changes;
}

double HandOverQuantile(const std::vector<HandOverSeen>& changes, double HandOverSeen::*field,
                        double share) {
  if (changes.empty()) return 0;
  std::vector<double> values;
  for (const HandOverSeen& change : changes) values.push_back(change.*field);
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::min(values.size() - 1, rank > 0 ? rank - 1 : 0)];
}

std::string FormatHandOvers(const std::vector<HandOverSeen>& changes) {
  if (changes.empty()) return "";
  std::string out = "  tick     body  from  to   gap m      dv m/s     without s\n";
  for (const HandOverSeen& c : changes) {
    out += fmt::format("  {:<8} {:<5} {:<5} {:<4} {:<10.4f} {:<10.4f} {:.3f}\n", c.tick, c.id,
                       c.from, c.to, c.gap_m, c.dv_mps, c.without_s);
  }
  out += fmt::format("  {} changes; 95 of 100 at most {:.4f} m, {:.4f} m/s, {:.3f} s without\n",
                     changes.size(), HandOverQuantile(changes, &HandOverSeen::gap_m, 0.95),
                     HandOverQuantile(changes, &HandOverSeen::dv_mps, 0.95),
                     HandOverQuantile(changes, &HandOverSeen::without_s, 0.95));
  return out;
}

}  // namespace seam
