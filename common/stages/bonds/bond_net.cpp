#include "common/stages/bonds/bond_net.h"

#include <algorithm>
#include <cmath>

#include "common/base/spatial/disjoint_sets.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

/// Residual at which the iteration stops, relative to the forces.
constexpr double kResidual = 1e-10;

int PlaceOf(const std::vector<PartId>& parts, PartId part) {
  const auto at = std::lower_bound(parts.begin(), parts.end(), part);
  return at != parts.end() && *at == part ? static_cast<int>(at - parts.begin()) : -1;
}

/// Returns the Laplacian of the network times `shifts`: the spring forces.
std::vector<double> SpringForces(const BondNet& net, const std::vector<double>& shifts) {
  std::vector<double> forces(shifts.size(), 0.0);
  for (const BondNet::Bond& bond : net.bonds) {
    const auto a = static_cast<std::size_t>(bond.a), b = static_cast<std::size_t>(bond.b);
    const double apart = shifts[a] - shifts[b];
    forces[a] += apart;
    forces[b] -= apart;
  }
  return forces;
}

double Dot(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

/// Returns the displacements, by conjugate gradients (Hestenes and Stiefel 1952). The network is
/// connected and the forces sum to zero, so a solution exists, up to a common displacement.
std::vector<double> Shifts(const BondNet& net, const std::vector<double>& forces) {
  std::vector<double> shifts(forces.size(), 0.0), rest = forces, way = forces;
  const double enough = kResidual * kResidual * Dot(forces, forces);
  double left = Dot(rest, rest);
  for (int i = 0; i < 2 * net.nodes + 50 && left > enough; ++i) {
    const std::vector<double> cost = SpringForces(net, way);
    const double steep = Dot(way, cost);
    if (!(steep > 0)) break;
    const double step = left / steep;
    for (std::size_t n = 0; n < shifts.size(); ++n) {
      shifts[n] += step * way[n];
      rest[n] -= step * cost[n];
    }
    const double next = Dot(rest, rest), keep = next / left;
    for (std::size_t n = 0; n < way.size(); ++n) way[n] = rest[n] + keep * way[n];
    left = next;
  }
  return shifts;
}

}  // namespace

int BondNet::NodeOf(PartId part) const {
  const int place = PlaceOf(parts, part);
  return place < 0 ? -1 : node_of[static_cast<std::size_t>(place)];
}

BondNet NetOf(const Scene& scene, const Assembly& assembly, const std::vector<int>& joints) {
  BondNet net;
  net.parts = assembly.parts;
  DisjointSets nodes(net.parts.size());
  int anchored = -1;
  for (std::size_t i = 0; i < net.parts.size(); ++i) {
    if (!scene.parts[static_cast<std::size_t>(net.parts[i])].anchored) continue;
    if (anchored >= 0) nodes.Unite(anchored, static_cast<int>(i));
    anchored = static_cast<int>(i);
  }
  std::vector<BondNet::Bond> bonds;
  for (const int j : joints) {
    const Joint& joint = scene.joints[static_cast<std::size_t>(j)];
    if (joint.gone || !IsRigid(joint, scene.solver)) continue;
    const int a = PlaceOf(net.parts, joint.a), b = PlaceOf(net.parts, joint.b);
    if (a < 0 || b < 0) continue;
    if (IsBreakableGlue(joint)) {
      bonds.push_back({a, b, j, static_cast<double>(joint.strength)});
    } else {
      nodes.Unite(a, b);
    }
  }
  net.node_of.resize(net.parts.size());
  for (std::size_t i = 0; i < net.parts.size(); ++i) {
    const auto first = static_cast<std::size_t>(nodes.Find(static_cast<int>(i)));
    net.node_of[i] = first == i ? net.nodes++ : net.node_of[first];
  }
  if (anchored >= 0) net.anchor = net.node_of[static_cast<std::size_t>(anchored)];
  for (BondNet::Bond bond : bonds) {
    bond.a = net.node_of[static_cast<std::size_t>(bond.a)];
    bond.b = net.node_of[static_cast<std::size_t>(bond.b)];
    if (bond.a == bond.b) continue;  // bypassed by an unbreakable connection
    if (net.bonds.empty() || bond.strength < net.weakest) net.weakest = bond.strength;
    net.bonds.push_back(bond);
  }
  return net;
}

std::vector<double> BondLoads(const BondNet& net, const std::vector<Eigen::Vector2d>& forces) {
  std::vector<double> loads(net.bonds.size(), 0.0);
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> pull;
    double sum = 0;
    for (const Eigen::Vector2d& force : forces) {
      pull.push_back(force[axis]);
      sum += force[axis];
    }
    if (net.anchor >= 0) pull[static_cast<std::size_t>(net.anchor)] -= sum;
    const std::vector<double> shifts = Shifts(net, pull);
    for (std::size_t b = 0; b < loads.size(); ++b) {
      const BondNet::Bond& bond = net.bonds[b];
      const double load =
          shifts[static_cast<std::size_t>(bond.a)] - shifts[static_cast<std::size_t>(bond.b)];
      loads[b] += load * load;
    }
  }
  for (double& load : loads) load = std::sqrt(load);
  return loads;
}

}  // namespace seam
