#include "common/measure/screen/overlaps.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "common/measure/parts.h"
#include "common/measure/percentile.h"
#include "common/measure/screen/thresholds.h"

namespace seam {
namespace {

/// Share of the ticks of touching pairs that overlap_p99_m covers.
constexpr double kOverlapShare = 0.99;

bool ShowsAll(const View& view, const std::vector<PartId>& ids) {
  return view.id.size() == ids.size() && std::equal(ids.begin(), ids.end(), view.id.begin());
}

/// Number of successive ticks for which each pair has overlapped, on one screen.
class Lengths {
 public:
  void Begin(std::int64_t tick) {
    if (tick != tick_ + 1) ticks_.clear();
    tick_ = tick;
    now_.clear();
  }
  int Overlaps(const BodyPair& pair) {
    const auto before = ticks_.find(pair);
    return now_[pair] = before == ticks_.end() ? 1 : before->second + 1;
  }
  void End() { ticks_.swap(now_); }

 private:
  std::int64_t tick_ = -1;
  std::map<BodyPair, int> ticks_, now_;
};

/// The viewer's own bodies in a view.
std::set<PartId> OwnIn(const View& view, Screen& screen) {
  std::set<PartId> own;
  for (std::size_t i = 0; i < view.id.size(); ++i) {
    if (screen.own.Has(view, i)) own.insert(view.id[i]);
  }
  return own;
}

}  // namespace

ShownOverlaps::ShownOverlaps(const SceneRevision& revision, const Oracle& oracle)
    : revision_(revision), oracle_(oracle), meter_(revision.scene(), revision.composition()) {}

ShownOverlaps::Depths ShownOverlaps::DepthsOf(const std::vector<BodyState>& states,
                                              std::int64_t tick) const {
  Depths depths;
  if (!std::all_of(states.begin(), states.end(), [](const BodyState& s) { return IsFinite(s); })) {
    return depths;
  }
  const auto body_of = [this](PartId part) {
    const auto assembly = static_cast<std::size_t>(revision_.AssemblyOf(part));
    return revision_.moving[assembly] < 0 ? kAnchoredBody
                                          : revision_.composition().assemblies[assembly].id;
  };
  meter_.ForEachOverlap(states, tick, [&](PartId a, PartId b, double depth_m) {
    if (depth_m <= 0) return;
    const PartId one = body_of(a), other = body_of(b);
    double& deepest = depths[{std::min(one, other), std::max(one, other)}];
    deepest = std::max(deepest, depth_m);
  });
  return depths;
}

const ShownOverlaps::Depths& ShownOverlaps::Due(std::int64_t tick) {
  const auto [due, is_new] = due_.try_emplace(tick);
  if (!is_new) return due->second;
  std::vector<BodyState> states;
  for (const PartId id : revision_.ids) {
    const std::optional<BodyState> state = oracle_.At(tick, id);
    if (!state) return due->second;
    states.push_back(*state);
  }
  return due->second = DepthsOf(states, tick);
}

const std::vector<ShownOverlaps::Found>& ShownOverlaps::In(const View& view) {
  found_.clear();
  if (!ShowsAll(view, revision_.ids)) return found_;
  std::vector<BodyState> states;
  for (std::size_t i = 0; i < view.id.size(); ++i) states.push_back(StateIn(view, i));
  std::set<std::int64_t> ticks;
  for (std::size_t i = 0; i < view.id.size(); ++i) ticks.insert(TickShown(view, i));
  const Depths shown = DepthsOf(states, view.tick);
  std::set<BodyPair> pairs;
  for (const auto& [pair, depth_m] : shown) pairs.insert(pair);
  for (const std::int64_t tick : ticks) {
    for (const auto& [pair, depth_m] : Due(tick)) pairs.insert(pair);
  }
  const auto depth_in = [](const Depths& depths, const BodyPair& pair) {
    const auto found = depths.find(pair);
    return found == depths.end() ? 0 : found->second;
  };
  for (const BodyPair& pair : pairs) {
    double due_m = 0;
    for (const PartId id : {pair.first, pair.second}) {
      if (id == kAnchoredBody) continue;
      const auto i = static_cast<std::size_t>(IndexOf(view, id));
      due_m = std::max(due_m, depth_in(Due(TickShown(view, i)), pair));
    }
    const double depth_m = depth_in(shown, pair);
    if (depth_m <= 0 && due_m <= 0) continue;
    found_.push_back({pair, depth_m, std::max(0.0, depth_m - due_m)});
  }
  return found_;
}

void NoticeOverlaps(const Recording& recording, const Oracle& oracle,
                    const RevisionHistory& revisions, Screen& screen, BodySeconds* seconds,
                    Measures* measures) {
  const double h = TickSeconds(recording);
  const auto long_enough = static_cast<int>(std::ceil(kOverlapLong / h - 1e-9));
  std::map<int, std::vector<const View*>> by_revision;  // of each, peer by peer
  for (const auto& [peer, views] : recording.views) {
    if (peer < 1) continue;
    for (const auto& [tick, view] : views) {
      by_revision[revisions.Key(view.revision)].push_back(&view);
    }
  }
  std::vector<double> beyond;
  for (const auto& [key, views] : by_revision) {
    const std::shared_ptr<const SceneRevision> revision = revisions.At(key);
    if (revision->ids.empty()) continue;
    ShownOverlaps overlaps(*revision, oracle);
    std::map<int, Lengths> lengths;  // by peer
    for (const View* view : views) {
      const std::vector<ShownOverlaps::Found>& found = overlaps.In(*view);
      Lengths& length = lengths[view->peer];
      length.Begin(view->tick);
      const std::set<PartId> own = found.empty() ? std::set<PartId>() : OwnIn(*view, screen);
      for (const ShownOverlaps::Found& each : found) {
        const auto [a, b] = each.pair;
        if (a != kAnchoredBody && own.count(a) != own.count(b)) beyond.push_back(each.beyond_m);
        if (each.beyond_m <= kOverlapFloor || length.Overlaps(each.pair) < long_enough) continue;
        for (const PartId id : {a, b}) {
          if (id != kAnchoredBody) seconds->Notice(view->peer, id, view->tick);
        }
      }
      length.End();
    }
  }
  if (!beyond.empty()) measures->overlap_p99_m = Percentile(beyond, kOverlapShare);
}

}  // namespace seam
