#pragma once
/// Which edits a peer may propose for what it has authority over, and whether they are likely.

#include "common/physics/world.h"
#include "common/topology/edit.h"
#include "common/topology/topology.h"

namespace seam {

/// Whether physics could have found this edit, by what the scene says: glue that can break, parts
/// that can join. Requires topology.Validate(edit).ok().
bool MayPropose(const Topology& topology, const Edit& edit);

/// Whether the parts of a bond are about where it puts them, in our copy. Glue that breaks is
/// always likely: its parts are one rigid body in every copy, so there is no distance between them
/// to be measured, and the blow that broke it was felt by the authority alone.
bool PlausibleProposal(const World& world, const Edit& edit);

}  // namespace seam
