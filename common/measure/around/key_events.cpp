#include "common/measure/around/key_events.h"

#include <algorithm>
#include <map>

#include "common/measure/handover_list.h"
#include "common/scene/assembly.h"

namespace seam {
namespace {

constexpr float kJumpMin = 1.0f;  ///< m/s in one tick; only a collision causes this

std::optional<std::int64_t> WatchedTick(const Scene& scene, const Oracle* oracle,
                                        const std::set<PartId>& struck) {
  if (struck.empty() || scene.watch.empty() || oracle == nullptr) return std::nullopt;
  const std::int64_t last = oracle->first_tick + static_cast<std::int64_t>(oracle->ticks.size());
  std::int64_t tick = std::max(scene.watch.front().around_tick, oracle->first_tick + 1);
  for (; tick < last; ++tick) {
    for (const PartId id : struck) {
      const auto now = oracle->At(tick, id), before = oracle->At(tick - 1, id);
      if (now && before && (now->velocity - before->velocity).norm() > kJumpMin) return tick;
    }
  }
  return std::nullopt;
}

std::optional<std::int64_t> FirstImpactTick(const Recording& recording) {
  std::optional<std::int64_t> first;
  for (const Impacts& impacts : recording.impacts) {
    for (std::size_t i = 0; i < impacts.dv.size(); ++i) {
      const bool both_move = impacts.id_a[i] >= 0 && impacts.id_b[i] >= 0;
      if (!both_move || impacts.dv[i] < kStrongImpact) continue;
      if (!first || impacts.tick < *first) first = impacts.tick;
    }
  }
  return first;
}

}  // namespace

std::optional<std::int64_t> ContactTick(const Recording& recording, const Scene& scene,
                                        const Oracle* oracle, const std::set<PartId>& struck) {
  const std::optional<std::int64_t> watched = WatchedTick(scene, oracle, struck);
  return watched ? watched : FirstImpactTick(recording);
}

std::set<PartId> StruckAssemblies(const Scene& scene) {
  std::set<PartId> ids;
  if (scene.watch.empty()) return ids;
  const Composition composition = Compose(scene);
  for (const PartId part : scene.watch.front().struck) {
    const int index = composition.assembly_of_part[static_cast<std::size_t>(part)];
    const Assembly& assembly = composition.assemblies[static_cast<std::size_t>(index)];
    if (!assembly.anchored) ids.insert(assembly.id);
  }
  return ids;
}

std::optional<FirstHandOver> FindFirstHandOver(const Recording& recording) {
  const auto views = recording.views.find(0);
  if (views == recording.views.end()) return std::nullopt;
  std::map<PartId, int> holders;
  for (const auto& [tick, view] : views->second) {
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      const int holder = view.authority[i];
      if (holder <= 0) continue;  // held by the server, or being handed over
      const auto [known, first] = holders.emplace(view.id[i], holder);
      if (!first && known->second != holder) return FirstHandOver{tick, view.id[i]};
    }
  }
  // The server's view may lack bodies held by clients (--publish own): use the clients' claims.
  for (const HandOverSeen& seen : ListHandOvers(recording)) {
    if (seen.from > 0 && seen.to > 0) return FirstHandOver{seen.tick, seen.id};
  }
  return std::nullopt;
}

}  // namespace seam
