#pragma once
/// The edits of a room as a server has ordered them, for watchers that join a relay. Keeps only
/// their effect.

#include <cstdint>
#include <map>
#include <vector>

#include "common/codec/messages.h"
#include "common/topology/topology.h"
#include "common/topology/topology_entry.h"
#include "common/topology/topology_fold.h"

namespace seam {

class RelayedEdits {
 public:
  /// `scene`: the room's; must outlive this.
  explicit RelayedEdits(const Scene& scene);

  /// Takes an order; ignores one that is not the next. An order without a number begins anew.
  void Take(const EditOrder& order);
  /// Takes a part of a world's edits, which replace all others once the last part is there.
  void Take(const Snapshot& part);
  /// True between the first part and the last one.
  bool incomplete() const { return parts_ > 0; }
  int revision() const { return topology_.revision(); }

  /// Returns the edits that make the current world of the scene; empty if there are none.
  std::vector<Snapshot> History(std::int64_t now_us) const;
  /// Returns the order that makes a receiver start over; History follows.
  static EditOrder BeginAnew(std::int64_t now_us, std::int64_t tick);
  /// True if a receiver with this ping has to start over; see EditLog::NeedsRepair.
  bool NeedsRepair(const Ping& ping, bool more_under_way) const;

 private:
  void StartAnew(const Topology& topology, const TopologyFold& fold);

  const Scene& scene_;
  Topology topology_;
  TopologyFold fold_;
  std::map<int, std::uint64_t> hash_after_;  // composition, by number of edits
  std::vector<TopologyEntry> entries_;       // of the parts so far
  int parts_ = 0;                            // parts that have come, while some are missing
};

}  // namespace seam
