#pragma once
/// Builds a topology from its entries, which are not trusted: the result is one that edits could
/// have made, or an error.

#include <cstddef>

#include "common/base/status.h"
#include "common/topology/topology.h"
#include "common/topology/topology_entry.h"

namespace seam {

class TopologyBuilder {
 public:
  /// Starts from the scene. Requires a scene that ParseScene accepted.
  explicit TopologyBuilder(const Scene& scene) : topology_(scene) {}

  /// Applies the next entry. After an error the builder must not be used again.
  Status Add(const TopologyEntry& entry);
  /// Completes the topology, as the state after `revision` edits. Requires revision >= 0.
  Status Finish(int revision);
  /// Requires a successful Finish.
  const Topology& topology() const { return topology_; }

 private:
  Status AddParts(const TopologyEntry& entry);
  Status AddJoints(const TopologyEntry& entry);
  Status Place(const TopologyEntry& entry);
  Status Measure(const TopologyEntry& entry);
  Status Bond(const TopologyEntry& entry);
  Status SetEnds(const TopologyEntry& entry);
  Status Insert(const TopologyEntry& entry);
  bool HasLivingJoint(std::int32_t joint) const;

  Topology topology_;
};

}  // namespace seam
