#pragma once
/// Rights and plausibility of the edits that a peer may propose for its mechanisms.

#include "common/physics/world.h"
#include "common/topology/edit.h"
#include "common/topology/topology.h"

namespace seam {

/// True if physics could have found this edit in the scene: the glue can break, the parts can join.
/// Requires topology.Validate(edit).ok().
bool MayPropose(const Topology& topology, const Edit& edit);

/// True if the parts of a bond are roughly where the bond puts them, in our copy. Breaking glue is
/// always plausible: its parts are one rigid body in every copy, so there is no distance to
/// measure, and only the authority felt the impact that broke it.
bool PlausibleProposal(const World& world, const Edit& edit);

}  // namespace seam
