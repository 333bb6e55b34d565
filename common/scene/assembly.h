#pragma once
/// Groups a scene's parts into assemblies (welded: one body) and mechanisms (jointed: one
/// authority).

#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// Parts that are rigidly joined; one body. Its id is its root's: the part of greatest mass,
/// ties to the lowest id.
struct Assembly {
  PartId id = 0;
  bool anchored = false;      ///< a member is anchored: never moves
  std::vector<PartId> parts;  ///< ascending
  int mechanism = -1;         ///< index into Composition::mechanisms; -1 when anchored
  int kinematic = -1;         ///< anchored, but moved by this joint (index); -1: stands still
};

/// Moving assemblies connected by non-rigid joints: never split between peers.
struct Mechanism {
  PartId id = 0;                ///< lowest assembly id among its members
  std::vector<int> assemblies;  ///< indices into Composition::assemblies, ascending
  int owner = -1;               ///< player that owns a part of it, lowest part first; -1: none
};

/// Who is joined to whom. The same parts and joints give the same composition, in the same order,
/// on every peer.
struct Composition {
  std::vector<Assembly> assemblies;   ///< ascending by id; anchored ones included
  std::vector<Mechanism> mechanisms;  ///< ascending by id
  std::vector<int> assembly_of_part;  ///< by part id
  std::uint64_t hash = 0;             ///< of all of the above
};

/// Mass of one part from its shape and density, kg; 0 for lines.
float PartMass(const Part& part);

/// Whether a joint, while it is there, makes its parts one body: glue, or a rigid weld unless the
/// scene wants the engine's joints for those.
inline bool IsRigid(const Joint& joint, const Solver& solver) {
  if (joint.kind == JointKind::kGlue) return true;
  return joint.kind == JointKind::kWeld && joint.frequency_hz <= 0 && !solver.weld_joints;
}

Composition Compose(const Scene& scene);

}  // namespace seam
