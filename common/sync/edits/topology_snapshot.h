#pragma once
/// Messages of an edited world's topology, for a peer that joins late or is repaired.

#include <cstdint>
#include <vector>

#include "common/base/status.h"
#include "common/codec/messages.h"
#include "common/topology/topology_builder.h"
#include "common/topology/topology_entry.h"

namespace seam {

/// Packs the entries in their order into as few messages as possible, at least one; utime is left
/// 0. If there are more than kSnapshotPartsMax, `part` and `parts` are invalid, and the snapshot
/// cannot be sent.
std::vector<Snapshot> ToSnapshots(int revision, const std::vector<TopologyEntry>& entries);

/// Appends the entries of one part. Trusts none of it.
Status ReadEntries(const Snapshot& part, std::vector<TopologyEntry>* entries);

/// Assembles a snapshot from its parts. Trusts none of it.
class SnapshotReader {
 public:
  /// Begins with the scene. Requires one that ParseScene accepted.
  explicit SnapshotReader(const Scene& scene) : builder_(scene) {}

  /// Takes the next part. After an error the reader must not be used further.
  Status Take(const Snapshot& part);
  bool complete() const { return taken_ > 0 && taken_ == parts_; }
  /// Requires complete().
  const Topology& topology() const { return builder_.topology(); }

 private:
  TopologyBuilder builder_;
  int taken_ = 0, parts_ = 0, revision_ = 0;
};

}  // namespace seam
