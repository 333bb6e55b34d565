#pragma once
/// The forces through the glue within one body, found by a network of equal springs between its
/// parts. Pure arithmetic.

#include <Eigen/Core>
#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// Nodes are parts; those that are welded, or glued without a limit, are one node, and so are all
/// that are anchored.
struct BondNet {
  struct Bond {
    int a = 0, b = 0;     ///< nodes, different ones
    int joint = 0;        ///< index into Scene::joints
    double strength = 0;  ///< N
  };
  std::vector<PartId> parts;  ///< of the assembly, ascending
  std::vector<int> node_of;   ///< by index in `parts`
  int nodes = 0;
  int anchor = -1;          ///< the node that is anchored; -1: none
  std::vector<Bond> bonds;  ///< ascending by joint
  double weakest = 0;       ///< N; of the bonds

  /// The node of a part; -1 if it is not of this assembly.
  int NodeOf(PartId part) const;
};

/// Of those of the scene's `joints` (indices, ascending) that are within the assembly. Without
/// bonds if nothing in it can break.
BondNet NetOf(const Scene& scene, const Assembly& assembly, const std::vector<int>& joints);

/// The force through each bond, N, when `forces` (N, by node) act and their sum is what accelerates
/// the whole, already taken off: they sum to zero, or else the anchored node takes the rest. All
/// bonds are equal springs: with u the nodes' shifts, the sum of (u_i - u_j) over the bonds of node
/// i is its force (the random fuse model; de Arcangelis, Redner, Herrmann 1985, for x and y alike).
/// Exact where bonds form a tree; parallel bonds share alike. Bending and the bonds' positions do
/// not count: a long arm breaks no sooner than a short one.
std::vector<double> BondLoads(const BondNet& net, const std::vector<Eigen::Vector2d>& forces);

}  // namespace seam
