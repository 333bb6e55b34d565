#include "tests/lab/hard/exact_judge.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"

namespace seam {

double Worse(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

void Worst::See(const World& world) { worst_ = Worse(worst_, wrong_(world)); }

const Part& PartNamed(const Scene& scene, std::string_view name) {
  const auto found = std::find_if(scene.parts.begin(), scene.parts.end(),
                                  [&](const Part& part) { return part.name == name; });
  SEAM_ASSERT(found != scene.parts.end());
  return *found;
}

int BodyOf(const Scene& scene, PartId part) {
  const Composition composition = Compose(scene);
  const int wanted = composition.assembly_of_part[static_cast<std::size_t>(part)];
  SEAM_ASSERT(!composition.assemblies[static_cast<std::size_t>(wanted)].anchored);
  const auto end = composition.assemblies.begin() + wanted;
  return static_cast<int>(std::count_if(composition.assemblies.begin(), end,
                                        [](const Assembly& a) { return !a.anchored; }));
}

double Seconds(const World& world) {
  return static_cast<double>(world.tick()) / world.scene().solver.tick_hz;
}

Eigen::Vector2d Place(const World& world, int body) {
  return world.Read(body).position.cast<double>();
}

Eigen::Vector2d Speed(const World& world, int body) {
  return world.Read(body).velocity.cast<double>();
}

double EllipticK(double k) {
  double a = 1, b = std::sqrt(1 - k * k);
  for (int i = 0; i < 60 && std::fabs(a - b) > 1e-15; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::acos(-1.0) / (2 * a);
}

}  // namespace seam
