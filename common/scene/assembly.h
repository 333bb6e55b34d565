#pragma once
/// Groups a scene's parts into assemblies (welded: one body) and mechanisms (jointed: one
/// authority).

#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// Parts that are rigidly joined: one body. Its id is that of its root, the part of greatest mass
/// (ties: the lowest id).
struct Assembly {
  PartId id = 0;
  bool anchored = false;      ///< a member is anchored: never moves by contacts
  std::vector<PartId> parts;  ///< ascending
  int mechanism = -1;         ///< index into Composition::mechanisms; -1 when anchored
  int kinematic = -1;         ///< anchored, but moved by this joint (index); -1: motionless
};

/// Moving assemblies connected by non-rigid joints: never split between peers.
struct Mechanism {
  PartId id = 0;                ///< lowest assembly id among its members
  std::vector<int> assemblies;  ///< indices into Composition::assemblies, ascending
  int owner = -1;               ///< player that owns a part of it, lowest part first; -1: none
};

/// Grouping of the parts into assemblies and mechanisms. The same parts and joints give the same
/// composition, in the same order, on every peer.
struct Composition {
  std::vector<Assembly> assemblies;   ///< ascending by id; anchored ones included
  std::vector<Mechanism> mechanisms;  ///< ascending by id
  std::vector<int> assembly_of_part;  ///< by part id
  std::uint64_t hash = 0;             ///< hash of all of the above
};

/// Returns a part's mass from its shape and density, kg; 0 for anchored lines.
float PartMass(const Part& part);

/// Returns true if a joint that is present makes its parts one body: glue, or a rigid weld unless
/// the scene solves welds as the engine's joints.
inline bool IsRigid(const Joint& joint, const Solver& solver) {
  if (joint.kind == JointKind::kGlue) return true;
  return joint.kind == JointKind::kWeld && joint.frequency_hz <= 0 && !solver.weld_joints;
}

Composition Compose(const Scene& scene);

/// Returns, by assembly, the index among the moving ones; -1: anchored.
std::vector<int> BodyOfAssembly(const Composition& composition);

}  // namespace seam
