/// Changes of authority: the jump of a displayed body, and the difference of the two authorities'
/// states.

#include <algorithm>
#include <cmath>
#include <set>

#include "common/measure/parts.h"
#include "common/measure/percentile.h"

namespace seam {
namespace {

/// Calls `act(tick, before, k, now, i)` for each body whose authority differs from the tick before.
template <class Action>
void ForEachChange(const std::map<std::int64_t, View>& views, const Action& act) {
  for (auto now = views.begin(); now != views.end(); ++now) {
    const auto before = views.find(now->first - 1);
    if (before == views.end()) continue;
    for (std::size_t i = 0; i < now->second.id.size(); ++i) {
      const int found = IndexOf(before->second, now->second.id[i]);
      if (found < 0) continue;
      const auto k = static_cast<std::size_t>(found);
      if (before->second.authority[k] == now->second.authority[i]) continue;
      act(now->first, before->second, k, now->second, i);
    }
  }
}

/// Differences of the two authorities, one entry for each hand-over.
struct Gaps {
  std::vector<double> positions, velocities;  // m, m/s
};

/// Appends the distance of a body's position and velocity in two views.
void Compare(const View& one, const View& other, PartId id, Gaps* gaps) {
  const int i = IndexOf(one, id), k = IndexOf(other, id);
  if (i < 0 || k < 0) return;
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(k);
  const double gap =
      std::hypot(double{one.x[a]} - double{other.x[b]}, double{one.y[a]} - double{other.y[b]});
  const double dv =
      std::hypot(double{one.vx[a]} - double{other.vx[b]}, double{one.vy[a]} - double{other.vy[b]});
  gaps->positions.push_back(gap);
  gaps->velocities.push_back(dv);
}

/// Compares the views of the old and the new authority at the first tick at which another peer than
/// before claims a body.
void MeasureGaps(const Recording& recording, const RevisionHistory* revisions, Measures* measures) {
  Gaps gaps;
  std::map<PartId, int> holders;
  for (std::int64_t tick = recording.first_tick; tick <= recording.last_tick; ++tick) {
    std::map<int, const View*> views;
    for (const auto& [peer, of_peer] : recording.views) {
      const auto found = of_peer.find(tick);
      if (found != of_peer.end()) views[peer] = &found->second;
    }
    for (const auto& [peer, view] : views) {
      for (std::size_t i = 0; i < view->id.size(); ++i) {
        if (view->role[i] != kRoleAuthority) continue;
        const PartId id = view->id[i];
        const int before = holders.emplace(id, peer).first->second;
        const auto old = views.find(before);
        if (before == peer || (old != views.end() && Claims(*old->second, id))) continue;
        const bool same =
            old != views.end() && (revisions == nullptr ||
                                   revisions->SameBody(view->revision, old->second->revision, id));
        if (same) Compare(*view, *old->second, id, &gaps);
        holders[id] = peer;
      }
    }
  }
  if (gaps.positions.empty()) return;
  measures->handover_gap_m = Percentile(gaps.positions, 1);
  measures->handover_dv_mps = Percentile(gaps.velocities, 1);
  measures->handover_gap_p95_m = Percentile(gaps.positions, 0.95);
  measures->handover_dv_p95_mps = Percentile(gaps.velocities, 0.95);
}

}  // namespace

bool Claims(const View& view, PartId id) {
  const int i = IndexOf(view, id);
  return i >= 0 && view.role[static_cast<std::size_t>(i)] == kRoleAuthority;
}

void MeasureHandover(const Recording& recording, const std::map<PartId, int>& mechanisms,
                     Measures* measures, const RevisionHistory* revisions) {
  const double h = TickSeconds(recording);
  for (const auto& [peer, views] : recording.views) {
    ForEachChange(views, [&](std::int64_t, const View& before, std::size_t k, const View& now,
                             std::size_t i) {
      // A body with other parts than before jumps because of that.
      if (revisions != nullptr && !revisions->SameBody(before.revision, now.revision, now.id[i]))
        return;
      const double dx = double{now.x[i]} - double{before.x[k]} - double{now.vx[i]} * h;
      const double dy = double{now.y[i]} - double{before.y[k]} - double{now.vy[i]} * h;
      measures->handover_jump_m = std::max(measures->handover_jump_m, std::hypot(dx, dy));
    });
  }
  MeasureGaps(recording, revisions, measures);
  if (recording.views.empty()) return;
  // By the server's views, or those of the lowest peer; a mechanism's bodies change together.
  std::set<std::pair<std::int64_t, int>> changes;
  ForEachChange(recording.views.begin()->second,
                [&](std::int64_t tick, const View&, std::size_t, const View& now, std::size_t i) {
                  int mechanism = -1 - now.id[i];
                  const auto known = mechanisms.find(now.id[i]);
                  if (known != mechanisms.end()) mechanism = known->second;
                  if (revisions != nullptr) {
                    const auto revision = revisions->At(now.revision);
                    const int of = revision->AssemblyOf(now.id[i]);
                    const auto& all = revision->composition().assemblies;
                    if (of >= 0) mechanism = all[static_cast<std::size_t>(of)].mechanism;
                  }
                  changes.insert({tick, mechanism});
                });
  measures->handovers = static_cast<std::int64_t>(changes.size());
}

}  // namespace seam
