#pragma once
/// A world as it has become by edits, as messages, for one who joins late or is repaired.

#include <cstdint>
#include <vector>

#include "common/base/status.h"
#include "common/codec/messages.h"
#include "common/topology/topology_builder.h"
#include "common/topology/topology_entry.h"

namespace seam {

/// As few messages as hold the entries, at least one, in their order; utime is left 0. There may be
/// more than kSnapshotPartsMax: then `part` and `parts` are wrong, and nobody can be sent them.
std::vector<Snapshot> ToSnapshots(int revision, const std::vector<TopologyEntry>& entries);

/// Puts a snapshot together that comes in its parts. Distrusts all of it.
class SnapshotReader {
 public:
  /// Begins with the scene. Requires one that ParseScene accepted.
  explicit SnapshotReader(const Scene& scene) : builder_(scene) {}

  /// Takes the next part. After an error the reader is of no more use.
  Status Take(const Snapshot& part);
  bool complete() const { return taken_ > 0 && taken_ == parts_; }
  /// Requires complete().
  const Topology& topology() const { return builder_.topology(); }

 private:
  Status TakeEntries(const Snapshot& part);

  TopologyBuilder builder_;
  int taken_ = 0, parts_ = 0, revision_ = 0;
};

}  // namespace seam
