#include "common/topology/join.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/scene/connectors.h"

namespace seam {
namespace {

/// Two connectors within this of each other count as joined: m, rad.
constexpr float kJoinedAt = 0.005f, kJoinedAngle = 0.02f;
/// Permitted error of a proposal's relative pose of the parts: m and rad.
constexpr float kExact = 1e-3f;

/// Rotates in double precision, then rounds.
Vec2 TurnedExactly(const Vec2& v, double angle) {
  return Turned(v.cast<double>(), angle).cast<float>();
}

void AddConnectors(const Part& part, bool inlet, std::vector<FreeConnector>* all) {
  const std::vector<Connector>& own = inlet ? part.connectors->inlets : part.connectors->outlets;
  for (std::size_t i = 0; i < own.size(); ++i) {
    all->push_back({part.id, inlet, static_cast<int>(i),
                    part.position + TurnedExactly(own[i].at, static_cast<double>(part.angle)),
                    part.angle + own[i].angle});
  }
}

bool Joined(const FreeConnector& x, const FreeConnector& y) {
  const double apart = static_cast<double>(x.angle) - static_cast<double>(y.angle) - kPi;
  return x.inlet != y.inlet && x.part != y.part && (x.at - y.at).norm() < kJoinedAt &&
         std::fabs(WrapAngle(apart)) < static_cast<double>(kJoinedAngle);
}

}  // namespace

bool HasConnectors(const Scene& scene) {
  return std::any_of(scene.parts.begin(), scene.parts.end(),
                     [](const Part& part) { return !part.gone && !part.connectors->empty(); });
}

std::vector<FreeConnector> FreeConnectors(const Scene& scene, const Composition& composition) {
  std::vector<FreeConnector> free;
  for (const Assembly& assembly : composition.assemblies) {
    std::vector<FreeConnector> all;
    for (const PartId id : assembly.parts) {
      AddConnectors(scene.parts[static_cast<std::size_t>(id)], true, &all);
      AddConnectors(scene.parts[static_cast<std::size_t>(id)], false, &all);
    }
    for (const FreeConnector& one : all) {
      const bool taken = std::any_of(
          all.begin(), all.end(), [&](const FreeConnector& other) { return Joined(one, other); });
      if (!taken) free.push_back(one);
    }
  }
  std::stable_sort(free.begin(), free.end(),
                   [](const FreeConnector& x, const FreeConnector& y) { return x.part < y.part; });
  return free;
}

BondEdit JoinOf(const Part& a, int outlet, const Part& b, int inlet) {
  const Connector& out = a.connectors->outlets[static_cast<std::size_t>(outlet)];
  const Connector& in = b.connectors->inlets[static_cast<std::size_t>(inlet)];
  const double turn =
      WrapAngle(static_cast<double>(out.angle) + kPi - static_cast<double>(in.angle));
  const Vec2 place = out.at - TurnedExactly(in.at, turn);
  BondEdit edit;
  edit.cause = BondCause::kConnectors;
  edit.a = a.id;
  edit.b = b.id;
  edit.position = place;
  edit.angle = static_cast<float>(turn);
  const float one = a.connectors->strength, other = b.connectors->strength;
  edit.strength = one > 0 && other > 0 ? std::min(one, other) : std::max(one, other);
  return edit;
}

bool IsJoin(const Scene& scene, const Composition& composition, const BondEdit& bond) {
  if (bond.cause != BondCause::kConnectors) return false;
  const Part& a = scene.parts[static_cast<std::size_t>(bond.a)];
  const Part& b = scene.parts[static_cast<std::size_t>(bond.b)];
  const std::vector<FreeConnector> free = FreeConnectors(scene, composition);
  for (const FreeConnector& out : free) {
    if (out.part != a.id || out.inlet) continue;
    for (const FreeConnector& in : free) {
      if (in.part != b.id || !in.inlet) continue;
      const BondEdit exact = JoinOf(a, out.index, b, in.index);
      const Vec2 off = (exact.position - bond.position).cwiseAbs();
      const bool same = off.x() < kExact && off.y() < kExact &&
                        std::fabs(exact.angle - bond.angle) < kExact &&
                        exact.strength == bond.strength;
      if (same) return true;
    }
  }
  return false;
}

}  // namespace seam
