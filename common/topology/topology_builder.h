#pragma once
/// A topology from its entries. Everything in them is distrusted: what comes out is as good as what
/// edits could have made, or nothing does.

#include <cstddef>

#include "common/base/status.h"
#include "common/topology/topology.h"
#include "common/topology/topology_entry.h"

namespace seam {

class TopologyBuilder {
 public:
  /// Begins with the scene. Requires one that ParseScene accepted.
  explicit TopologyBuilder(const Scene& scene) : topology_(scene) {}

  /// Takes the next entry. After an error the builder is of no more use.
  Status Add(const TopologyEntry& entry);
  /// After the last entry: what it is after so many edits. Requires revision >= 0.
  Status Finish(int revision);
  /// Requires that Finish was good.
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
