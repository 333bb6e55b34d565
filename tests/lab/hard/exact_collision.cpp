/// Blows of two smooth discs: head on and glancing, elastic and not.

#include <algorithm>
#include <cmath>

#include "common/scene/mass.h"
#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// A disc that meets one at rest, and the velocities that both must leave with.
struct Blow {
  int a = 0, b = 0;
  double speed = 0;  ///< m/s before
  Eigen::Vector2d after_a{0, 0}, after_b{0, 0};
};

/// Newton: along the line of centres at the touch the impulse is (1 + e) m1 m2/(m1 + m2) times the
/// speed of approach; across it nothing, for there is no friction. Momentum is kept, and the
/// energy is if e = 1. Head on: v1' = (m1 - e m2)/(m1 + m2) v, v2' = (1 + e) m1/(m1 + m2) v.
Blow Exact(const Scene& scene, const Part& a, const Part& b) {
  Blow blow{BodyOf(scene, a.id), BodyOf(scene, b.id), 0, {0, 0}, {0, 0}};
  const Eigen::Vector2d v = a.velocity.cast<double>();
  blow.speed = v.norm();
  const Eigen::Vector2d way = v / blow.speed;
  const Eigen::Vector2d apart = (b.position - a.position).cast<double>();
  const Eigen::Vector2d aside = apart - apart.dot(way) * way;
  const double reach = static_cast<double>(a.radius) + static_cast<double>(b.radius);
  const double ahead = std::sqrt(reach * reach - aside.squaredNorm());
  const Eigen::Vector2d normal = (ahead * way + aside) / reach;
  const double e = static_cast<double>(std::max(a.material.restitution, b.material.restitution));
  const double m1 = PartProperties(a).mass, m2 = PartProperties(b).mass;
  const double impulse = (1 + e) * m1 * m2 / (m1 + m2) * v.dot(normal);
  blow.after_a = v - impulse / m1 * normal;
  blow.after_b = impulse / m2 * normal;
  return blow;
}

/// The scene's parts are pairs: who strikes, who is struck.
std::unique_ptr<Judge> Blows(const Scene& scene) {
  std::vector<Blow> blows;
  for (std::size_t i = 0; i + 1 < scene.parts.size(); i += 2) {
    blows.push_back(Exact(scene, scene.parts[i], scene.parts[i + 1]));
  }
  return std::make_unique<Last>([blows](const World& world) {
    double worst = 0;
    for (const Blow& blow : blows) {
      const double a = (Speed(world, blow.a) - blow.after_a).norm();
      const double b = (Speed(world, blow.b) - blow.after_b).norm();
      worst = Worse(worst, Worse(a / blow.speed, b / blow.speed));
    }
    return worst;
  });
}

}  // namespace

std::vector<HardCase> CollisionCases() {
  const std::string newton = "worst error of a velocity after the blow, of the speed before: ";
  return {
      {"collision-elastic",
       "collision-elastic",
       Truth::kFormula,
       "1",
       newton + "v1' = (m1 - m2)/(m1 + m2) v, v2' = 2 m1/(m1 + m2) v, masses 1:10 to 10:1",
       1,
       Blows,
       {}},
      {"collision-glancing",
       "collision-glancing",
       Truth::kFormula,
       "1",
       newton + "only the part along the line of centres is exchanged",
       1,
       Blows,
       {}},
      {"collision-inelastic",
       "collision-inelastic",
       Truth::kFormula,
       "1",
       newton + "v1' = (m1 - e m2)/(m1 + m2) v, v2' = (1 + e) m1/(m1 + m2) v",
       1,
       Blows,
       {}},
  };
}

}  // namespace seam
