#include "server/rules/impact_check.h"

#include <algorithm>
#include <cmath>

#include "common/scene/mechanism_ids.h"

namespace seam {
namespace {

/// Speeds are taken from this many ticks before the impact: an authority sends a state every second
/// tick. A longer time could explain an impact by the speed before an earlier one; the tick itself
/// would let the impact explain itself.
constexpr std::int64_t kTicksBefore = 4;
/// Allowed change of velocity beyond the momentum's, m/s: for rounding, weight, and the impulse of
/// motors in one tick.
constexpr float kSlack = 1.0f;
/// Largest distance of the point from the bodies, m, besides their motion in kTicksBefore.
constexpr float kNear = 0.5f;

/// Returns the distance from the root of an assembly to its farthest point, m.
float ExtentOf(const World& world, const Assembly& assembly) {
  const std::vector<Part>& parts = world.scene().parts;
  const Part& root = parts[static_cast<std::size_t>(assembly.id)];
  float reach = 0;
  for (const PartId id : assembly.parts) {
    const Part& part = parts[static_cast<std::size_t>(id)];
    float own = std::max(part.radius, part.kind == ShapeKind::kBox ? part.size.norm() / 2 : 0.0f);
    for (const Vec2& point : part.points) own = std::max(own, point.norm() + part.radius);
    reach = std::max(reach, (part.position - root.position).norm() + own);
  }
  return reach;
}

const Assembly& AssemblyOf(const World& world, PartId part) {
  const Composition& c = world.composition();
  const int index = c.assembly_of_part[static_cast<std::size_t>(part)];
  return c.assemblies[static_cast<std::size_t>(index)];
}

float ExtentOf(const World& world, int body) {
  return ExtentOf(world, AssemblyOf(world, world.id(body)));
}

float LargestRestitution(const World& world, int body) {
  const Composition& c = world.composition();
  const int index = c.assembly_of_part[static_cast<std::size_t>(world.id(body))];
  float largest = 0;
  for (const PartId id : c.assemblies[static_cast<std::size_t>(index)].parts) {
    const Part& part = world.scene().parts[static_cast<std::size_t>(id)];
    largest = std::max(largest, part.material.restitution);
  }
  return largest;
}

float MechanismMass(const World& world, int body) {
  float mass = 0;
  EachIdOf(world.composition(), world.mechanism(body), [&](PartId id) {
    mass += world.mass(world.BodyOfId(id));
  });
  return mass;
}

/// True if any anchored part moves. Its speed at impact is not looked up.
bool HasMovers(const World& world) {
  const std::vector<Assembly>& all = world.composition().assemblies;
  return std::any_of(all.begin(), all.end(), [](const Assembly& a) { return a.kinematic >= 0; });
}

using Trail = std::vector<StateTrail::Seen>;

/// True if the body was at the point in that tick, or its newest known state moves it there: where
/// inputs come late, states arrive later than impacts.
bool IsNear(const Trail& trail, const Vec2& point, std::int64_t tick, float reach, float dt) {
  return std::any_of(trail.begin(), trail.end(), [&](const StateTrail::Seen& seen) {
    const float moves = seen.state.velocity.norm() * dt * static_cast<float>(kTicksBefore);
    const Vec2 way = static_cast<float>(tick - seen.tick) * dt * seen.state.velocity;
    const Vec2 apart = point - seen.state.position;
    return std::min(apart.norm(), (apart - way).norm()) <= reach + moves + kNear;
  });
}

/// Returns the largest relative speed of any two states, rotation of both included, m/s.
float RelativeSpeed(const Trail& one, float reach_one, const Trail& other, float reach_other) {
  float largest = 0;
  for (const StateTrail::Seen& a : one) {
    const float own = std::fabs(a.state.spin) * reach_one;
    if (other.empty()) largest = std::max(largest, a.state.velocity.norm() + own);
    for (const StateTrail::Seen& b : other) {
      const float turning = own + std::fabs(b.state.spin) * reach_other;
      largest = std::max(largest, (a.state.velocity - b.state.velocity).norm() + turning);
    }
  }
  return largest;
}

}  // namespace

bool Possible(const World& world, const StateTrail& trail, const Blow& blow, std::int64_t tick) {
  const std::int64_t from = tick - kTicksBefore, to = tick - 1;
  const Trail struck = trail.Between(blow.body, from, to);
  if (struck.empty()) return false;
  const float reach = ExtentOf(world, blow.body);
  if (!IsNear(struck, blow.point, tick, reach, world.dt())) return false;
  Trail striker;
  float reach_by = 0, restitution = LargestRestitution(world, blow.body);
  if (blow.by >= 0) {
    striker = trail.Between(blow.by, from, to);
    reach_by = ExtentOf(world, blow.by);
    if (striker.empty() || !IsNear(striker, blow.point, tick, reach_by, world.dt())) return false;
    restitution = std::max(restitution, LargestRestitution(world, blow.by));
  } else {
    if (HasMovers(world)) return true;
    restitution = 1;  // not looked up for anchored parts
  }
  // A free body gains at most (1 + e) times the relative speed. A body held by another at the same
  // time can pass on all the incoming momentum, however heavy its source.
  const float bringing = MechanismMass(world, blow.by >= 0 ? blow.by : blow.body);
  const float ratio = std::max(1.0f, bringing / world.mass(blow.body));
  const float speed = RelativeSpeed(struck, reach, striker, reach_by);
  return blow.dv <= (1 + restitution) * speed * ratio + kSlack;
}

bool MayTouch(const World& world, const StateTrail& trail, const PartTouch& touch,
              std::int64_t tick) {
  if (HasMovers(world)) return true;
  struct Side {
    float extent = 0;
    Trail places;
  };
  const auto side = [&](PartId part) {
    const Assembly& its = AssemblyOf(world, part);
    const int index = world.composition().assembly_of_part[static_cast<std::size_t>(part)];
    Side found{ExtentOf(world, its), {}};
    if (!its.anchored) {
      found.places = trail.Between(world.BodyOfId(its.id), tick - kTicksBefore, tick);
    }
    if (found.places.empty()) found.places.push_back({tick, world.ReadAssembly(index)});
    return found;
  };
  const Side a = side(touch.a), b = side(touch.b);
  return std::any_of(a.places.begin(), a.places.end(), [&](const StateTrail::Seen& seen) {
    return IsNear(b.places, seen.state.position, tick, a.extent + b.extent, world.dt());
  });
}

}  // namespace seam
