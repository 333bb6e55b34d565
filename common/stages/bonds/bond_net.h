#pragma once
/// Computes the forces in the glue within one body, by a network of equal springs between its
/// parts. Pure arithmetic.

#include <Eigen/Core>
#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// Nodes are groups of parts: parts that are welded, or glued without a limit, form one node, and
/// so do all anchored parts.
struct BondNet {
  struct Bond {
    int a = 0, b = 0;     ///< nodes, different
    int joint = 0;        ///< index into Scene::joints
    double strength = 0;  ///< N
  };
  std::vector<PartId> parts;  ///< of the assembly, ascending
  std::vector<int> node_of;   ///< node of each part, by index in `parts`
  int nodes = 0;
  int anchor = -1;          ///< the anchored node; -1: none
  std::vector<Bond> bonds;  ///< ascending by joint
  double weakest = 0;       ///< N; least strength of the bonds

  /// Returns the node of a part; -1 if it is not of this assembly.
  int NodeOf(PartId part) const;
};

/// Builds the network from the joints (indices, ascending) that lie within the assembly. Without
/// bonds if nothing in the assembly can break.
BondNet NetOf(const Scene& scene, const Assembly& assembly, const std::vector<int>& joints);

/// Returns the force in each bond, N, under `forces` (N, by node), from which the common
/// acceleration is already subtracted: they sum to zero, or else the anchored node takes the
/// remainder. All bonds are equal springs: with u the nodes' displacements, the sum of (u_i - u_j)
/// over the bonds of node i is its force (the random fuse model; de Arcangelis, Redner, Herrmann
/// 1985, for x and y alike). Exact for trees of bonds; parallel bonds share equally. Bending and
/// the bonds' positions are ignored: a long arm breaks no sooner than a short one.
std::vector<double> BondLoads(const BondNet& net, const std::vector<Eigen::Vector2d>& forces);

}  // namespace seam
