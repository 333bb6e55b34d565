#include "server/relay/relayed_edits.h"

#include <algorithm>
#include <utility>

#include "common/sync/edits/edit_order.h"
#include "common/sync/edits/topology_snapshot.h"
#include "server/edits/edit_log.h"

namespace seam {

RelayedEdits::RelayedEdits(const Scene& scene) : scene_(scene), topology_(scene), fold_(topology_) {
  StartAnew(Topology(topology_), TopologyFold(fold_));
}

void RelayedEdits::StartAnew(const Topology& topology, const TopologyFold& fold) {
  topology_ = topology;
  fold_ = fold;
  hash_after_.clear();
  hash_after_[topology_.revision()] = topology_.composition().hash;
}

void RelayedEdits::Take(const EditOrder& order) {
  if (order.number < 0) {
    const Topology begin(scene_);
    parts_ = 0;
    return StartAnew(begin, TopologyFold(begin));
  }
  if (order.number != topology_.revision()) return;
  const Edit edit = ToEdit(order);
  (void)topology_.Apply({edit});
  fold_.Note(edit, topology_);
  hash_after_[topology_.revision()] = topology_.composition().hash;
  if (hash_after_.size() > EditLog::kHashesMax) hash_after_.erase(hash_after_.begin());
}

void RelayedEdits::Take(const Snapshot& part) {
  if (part.part == 0) {
    entries_.clear();
    parts_ = 0;
  }
  if (part.part != parts_ || !ReadEntries(part, &entries_).ok()) return;
  if (++parts_ < part.parts) return;
  parts_ = 0;
  Topology topology(scene_);
  TopologyFold fold(topology);
  const std::vector<TopologyEntry> entries = std::exchange(entries_, {});
  if (TopologyFold::FromEntries(scene_, entries, part.number, &fold, &topology).ok()) {
    StartAnew(topology, fold);
  }
}

std::vector<Snapshot> RelayedEdits::History(std::int64_t now_us) const {
  if (topology_.revision() == 0) return {};
  std::vector<Snapshot> all = ToSnapshots(topology_.revision(), fold_.Entries(topology_));
  for (Snapshot& part : all) part.utime = now_us;
  return all;
}

EditOrder RelayedEdits::BeginAnew(std::int64_t now_us, std::int64_t tick) {
  EditOrder anew;
  anew.utime = now_us;
  anew.tick = std::max<std::int64_t>(0, tick);
  return anew;
}

bool RelayedEdits::NeedsRepair(const Ping& ping, bool more_under_way) const {
  if (ping.revision < 0) return false;  // has no world yet
  const bool never = ping.revision > topology_.revision();
  const bool lost = !more_under_way && ping.revision < hash_after_.begin()->first;
  const auto known = hash_after_.find(ping.revision);
  const bool differs =
      known != hash_after_.end() && known->second != static_cast<std::uint64_t>(ping.composition);
  return never || lost || differs;
}

}  // namespace seam
