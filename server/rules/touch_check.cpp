#include "server/rules/touch_check.h"

#include <algorithm>
#include <vector>

#include "server/rules/impact_check.h"

namespace seam {
namespace {

/// Largest gap of the two discs, m, besides their motion in ImpactCheck::kTicksAround.
constexpr float kTouchNear = 0.5f;

const Assembly& AssemblyOfPart(const World& world, PartId part) {
  const Composition& c = world.composition();
  const int index = c.assembly_of_part[static_cast<std::size_t>(part)];
  return c.assemblies[static_cast<std::size_t>(index)];
}

/// True if the body was near the place in that tick, or its newest known state moves it there.
bool WasNear(const StateTrail::Seen& seen, const Vec2& place, std::int64_t tick, float reach,
             float dt) {
  const float moves =
      seen.state.velocity.norm() * dt * static_cast<float>(ImpactCheck::kTicksAround);
  const Vec2 way = static_cast<float>(tick - seen.tick) * dt * seen.state.velocity;
  const Vec2 apart = place - seen.state.position;
  return std::min(apart.norm(), (apart - way).norm()) <= reach + moves + kTouchNear;
}

}  // namespace

bool MayTouch(const World& world, const StateTrail& trail, const PartTouch& touch,
              std::int64_t tick) {
  const std::vector<Assembly>& all = world.composition().assemblies;
  // The place of a part on a path in that tick is not looked up.
  if (std::any_of(all.begin(), all.end(), [](const Assembly& a) { return a.kinematic >= 0; })) {
    return true;
  }
  struct Side {
    float extent = 0;
    std::vector<StateTrail::Seen> places;
  };
  const auto side = [&](PartId part) {
    const Assembly& its = AssemblyOfPart(world, part);
    const int index = world.composition().assembly_of_part[static_cast<std::size_t>(part)];
    Side found{ExtentOf(world, its), {}};
    if (!its.anchored) {
      found.places = trail.Around(world.BodyOfId(its.id), tick - ImpactCheck::kTicksAround, tick);
    }
    if (found.places.empty()) found.places.push_back({tick, world.ReadAssembly(index)});
    return found;
  };
  const Side a = side(touch.a), b = side(touch.b);
  return std::any_of(a.places.begin(), a.places.end(), [&](const StateTrail::Seen& one) {
    return std::any_of(b.places.begin(), b.places.end(), [&](const StateTrail::Seen& other) {
      return WasNear(other, one.state.position, tick, a.extent + b.extent, world.dt());
    });
  });
}

}  // namespace seam
