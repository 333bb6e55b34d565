#pragma once
/// For tests that make a replica's world go astray, as no caller of Replica may.

#include "common/sync/replica.h"

namespace seam {

struct ReplicaTestAccess {
  static World& world(Replica& replica) { return replica.world_; }
};

}  // namespace seam
