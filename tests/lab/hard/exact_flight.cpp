/// Projectile: against the integrator's own sum, and against the parabola.

#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// Where a thrown body is after n steps of h: the engine changes the velocity first and moves by
/// the new one, so y_n = y0 + n v0 h + g h^2 n (n + 1)/2 (symplectic Euler in closed form).
Eigen::Vector2d Summed(const Part& thrown, const Scene& scene, double steps, double h) {
  const Eigen::Vector2d speed = thrown.velocity.cast<double>();
  return thrown.position.cast<double>() + steps * h * speed +
         h * h * steps * (steps + 1) / 2 * scene.gravity.cast<double>();
}

std::unique_ptr<Judge> AgainstSum(const Scene& scene) {
  const Part thrown = PartNamed(scene, "ball");
  const int body = BodyOf(scene, thrown.id);
  return std::make_unique<Worst>([thrown, body](const World& world) {
    const Solver& solver = world.scene().solver;
    const double h = 1.0 / (solver.tick_hz * solver.substeps);
    const double steps = static_cast<double>(world.tick()) * solver.substeps;
    return (Place(world, body) - Summed(thrown, world.scene(), steps, h)).norm();
  });
}

std::unique_ptr<Judge> AgainstParabola(const Scene& scene) {
  const Part thrown = PartNamed(scene, "ball");
  const int body = BodyOf(scene, thrown.id);
  return std::make_unique<Worst>([thrown, body](const World& world) {
    const double t = Seconds(world);
    const Eigen::Vector2d exact = thrown.position.cast<double>() +
                                  t * thrown.velocity.cast<double>() +
                                  t * t / 2 * world.scene().gravity.cast<double>();
    return (Place(world, body) - exact).norm();
  });
}

}  // namespace

std::vector<HardCase> FlightCases() {
  return {
      {"projectile",
       "projectile",
       Truth::kFormula,
       "m",
       "worst distance from y0 + n v0 h + g h^2 n (n + 1)/2, the integrator's own sum",
       4,
       AgainstSum,
       {}},
      {"projectile-parabola",
       "projectile",
       Truth::kFormula,
       "m",
       "worst distance from y0 + v0 t + g t^2/2; the integrator's own share is g h t/2",
       4,
       AgainstParabola,
       {}},
  };
}

}  // namespace seam
