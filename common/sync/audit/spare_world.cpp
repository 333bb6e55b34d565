#include "common/sync/audit/spare_world.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"

namespace seam {
namespace {

/// Position of a body's centre of mass, m.
Vec2 CentreOf(const World& world, int body, const BodyState& state) {
  const Transform2 frame{state.position.cast<double>(), double{state.angle}};
  return frame(world.mass_point(body).centre.cast<double>()).cast<float>();
}

/// Sums of a mechanism's bodies.
struct Whole {
  Vec2 position{0, 0}, velocity{0, 0};
  float mass = 0;
  void Add(const Vec2& centre, const BodyState& state, float body_mass) {
    position += body_mass * centre;
    velocity += body_mass * state.velocity;
    mass += body_mass;
  }
};

}  // namespace

SpareWorld::SpareWorld(const Topology& topology, Present present)
    : world_(topology),
      bodies_(world_.composition().mechanisms.size()),
      standings_(bodies_.size()) {
  for (int body = 0; body < world_.body_count(); ++body) {
    bodies_[static_cast<std::size_t>(world_.mechanism(body))].push_back(body);
    if (present == Present::kNone) world_.SetActivity(body, Activity::kParked);
  }
}

void SpareWorld::Put(int mechanism, int holder, const std::vector<BodyState>& states) {
  const std::vector<int>& own = bodies(mechanism);
  for (std::size_t i = 0; i < own.size(); ++i) {
    world_.SetActivity(own[i], Activity::kSimulated);
    world_.Write(own[i], states[i]);
  }
  standings_[static_cast<std::size_t>(mechanism)] = {holder, false, false, world_.tick()};
}

void SpareWorld::Take(int mechanism) {
  for (const int body : bodies(mechanism)) world_.SetActivity(body, Activity::kParked);
  standings_[static_cast<std::size_t>(mechanism)] = {};
}

void SpareWorld::Step(const std::function<void(World*)>& inputs) {
  inputs(&world_);
  world_.Step();
  for (const Touch& touch : world_.touches()) {
    Standing& a = standings_[static_cast<std::size_t>(world_.mechanism(touch.body_a))];
    Standing& b = standings_[static_cast<std::size_t>(world_.mechanism(touch.body_b))];
    if (&a == &b) continue;
    a.met = b.met = true;
    if (a.holder != b.holder || a.lost != b.lost) a.lost = b.lost = true;
  }
}

std::optional<Gain> SpareWorld::Compare(int mechanism, const ToldNow& told) const {
  const Standing& standing = standings_[static_cast<std::size_t>(mechanism)];
  if (standing.holder <= 0 || standing.lost) return std::nullopt;
  const std::vector<int>& own = bodies(mechanism);
  Whole is, would_be;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!told[i]) continue;
    const float mass = world_.mass(own[i]);
    const BodyState stepped = world_.Read(own[i]);
    is.Add(CentreOf(world_, own[i], *told[i]), *told[i], mass);
    would_be.Add(CentreOf(world_, own[i], stepped), stepped, mass);
  }
  if (is.mass <= 0) return std::nullopt;
  Gain gain;
  gain.met = standing.met;
  gain.seconds = static_cast<double>(world_.tick() - standing.put) * double{world_.dt()};
  gain.position = (is.position - would_be.position) / is.mass;
  gain.velocity = (is.velocity - would_be.velocity) / is.mass;
  gain.stepped = would_be.velocity / is.mass;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!told[i]) continue;
    const BodyState stepped = world_.Read(own[i]);
    const Vec2 moved = CentreOf(world_, own[i], *told[i]) - CentreOf(world_, own[i], stepped);
    gain.apart = std::max(gain.apart, double{(moved - gain.position).norm()});
  }
  return gain;
}

}  // namespace seam
