#include "tests/lab/hard/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/scene/mass.h"

namespace seam {

int CommonHz(int tick_hz) { return std::gcd(tick_hz, 30); }

Trajectory::Trajectory(const Scene& scene) {
  const Composition composition = Compose(scene);
  for (const Part& part : scene.parts) {
    if (part.gone) continue;
    const int index = composition.assembly_of_part[static_cast<std::size_t>(part.id)];
    const Assembly& assembly = composition.assemblies[static_cast<std::size_t>(index)];
    if (assembly.anchored) continue;
    const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
    tracked_.push_back({assembly.id, ToRootFrame(part, root, Eigen::Vector2d(0, 0))});
  }
}

void Trajectory::See(const World& world) {
  const int tick_hz = world.scene().solver.tick_hz;
  const int ticks = tick_hz / CommonHz(tick_hz);
  if (world.tick() % ticks != 0) return;
  samples_.resize(static_cast<std::size_t>(world.tick() * 30 / tick_hz + 1));
  std::vector<Eigen::Vector2d>& sample = samples_.back();
  sample.reserve(tracked_.size());
  for (const Tracked& tracked : tracked_) {
    const BodyState state = world.Read(world.BodyOfId(tracked.assembly));
    const Transform2 placed{state.position.cast<double>(), static_cast<double>(state.angle)};
    sample.push_back(placed(tracked.local));
  }
}

double Distance(const Trajectory& a, const Trajectory& b) {
  SEAM_ASSERT(a.parts() == b.parts());
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 1; k < std::min(a.samples(), b.samples()); ++k) {
    if (a.At(k).empty() || b.At(k).empty()) continue;
    for (std::size_t i = 0; i < a.parts(); ++i) sum += (a.At(k)[i] - b.At(k)[i]).squaredNorm();
    count += a.parts();
  }
  return count == 0 ? std::numeric_limits<double>::infinity()
                    : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace seam
