/// Dry friction: a block that slides, stops or stays, and a disc that rolls.

#include <algorithm>
#include <cmath>

#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// The chain "ground", straight and falling to the right (or level), and what lies on it.
struct Incline {
  explicit Incline(const Scene& scene, const std::string& name) {
    const Part& ground = PartNamed(scene, "ground");
    const Part& thing = PartNamed(scene, name);
    along = (ground.points.back() - ground.points.front()).cast<double>().normalized();
    pull = along.dot(scene.gravity.cast<double>());
    press = std::fabs(along.x() * static_cast<double>(scene.gravity.y()) -
                      along.y() * static_cast<double>(scene.gravity.x()));
    friction = std::sqrt(static_cast<double>(ground.material.friction) *
                         static_cast<double>(thing.material.friction));
    start = thing.position.cast<double>();
    speed = along.dot(thing.velocity.cast<double>());
    angle = static_cast<double>(thing.angle);
    body = BodyOf(scene, thing.id);
  }
  double Come(const World& world) const { return along.dot(Place(world, body) - start); }

  Eigen::Vector2d along{1, 0};  ///< downhill
  double pull = 0, press = 0;   ///< m/s^2, gravity along and into the ground
  double friction = 0;
  Eigen::Vector2d start{0, 0};  ///< m
  double speed = 0;             ///< m/s downhill, >= 0
  double angle = 0;             ///< rad, of the thing at tick 0
  int body = 0;
};

/// Coulomb: s = v0 t + (g sin - mu g cos) t^2/2 until the speed is gone, and no farther if friction
/// holds it: for ever at s = 0 when it began at rest.
double Slid(const Incline& on, double t) {
  const double a = on.pull - on.friction * on.press;
  if (a < 0) t = std::min(t, on.speed / -a);
  return on.speed * t + a * t * t / 2;
}

std::unique_ptr<Judge> SlidingBlock(const Scene& scene) {
  const Incline on(scene, "block");
  return std::make_unique<Worst>(
      [on](const World& world) { return std::fabs(on.Come(world) - Slid(on, Seconds(world))); });
}

/// A disc that rolls without slip has 2/3 of the pull: I = m r^2/2.
std::unique_ptr<Judge> RollingDisc(const Scene& scene) {
  const Incline on(scene, "disc");
  return std::make_unique<Worst>([on](const World& world) {
    const double t = Seconds(world);
    return std::fabs(on.Come(world) - on.pull / 3 * t * t);
  });
}

/// How far the turning of the disc is from the way it came: downhill is clockwise.
std::unique_ptr<Judge> DiscSlip(const Scene& scene) {
  const Incline on(scene, "disc");
  const double radius = static_cast<double>(PartNamed(scene, "disc").radius);
  return std::make_unique<Worst>([on, radius](const World& world) {
    const double turned = on.angle - static_cast<double>(world.Read(on.body).angle);
    return std::fabs(on.Come(world) - radius * turned);
  });
}

}  // namespace

std::vector<HardCase> FrictionCases() {
  const std::string coulomb = "worst distance along the ground from Coulomb's ";
  return {
      {"rolling-disc",
       "rolling-disc",
       Truth::kFormula,
       "m",
       "worst distance along the slope from g sin(theta) t^2/3",
       4,
       RollingDisc,
       {}},
      {"rolling-disc-slip",
       "rolling-disc",
       Truth::kFormula,
       "m",
       "worst difference of the way come and radius times angle turned",
       4,
       DiscSlip,
       {}},
      {"slide-flat",
       "slide-flat",
       Truth::kFormula,
       "m",
       coulomb + "v0 t - mu g t^2/2, at rest after v0^2/(2 mu g)",
       4,
       SlidingBlock,
       {}},
      {"slope-creep",
       "slope-creep",
       Truth::kFormula,
       "m",
       "creep of a block that mu > tan(theta) must hold",
       20,
       SlidingBlock,
       {}},
      {"slope-slide",
       "slope-slide",
       Truth::kFormula,
       "m",
       coulomb + "g (sin - mu cos) t^2/2",
       4,
       SlidingBlock,
       {}},
      {"slope-stop",
       "slope-stop",
       Truth::kFormula,
       "m",
       coulomb + "path, at rest after v0^2/(2 g (mu cos - sin))",
       5,
       SlidingBlock,
       {}},
  };
}

}  // namespace seam
