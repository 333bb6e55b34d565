/// Pendulums: the period of one from 90 degrees, and the energy that one and two links keep.

#include <cmath>
#include <limits>

#include "common/scene/mass.h"
#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// The physical pendulum that hangs from the scene's first joint.
struct Pendulum {
  explicit Pendulum(const Scene& scene)
      : hinge(scene.joints.front().anchor_a.cast<double>()),
        body(BodyOf(scene, scene.joints.front().b)) {
    const Part& bar = scene.parts[static_cast<std::size_t>(scene.joints.front().b)];
    const MassProperties own = PartProperties(bar);
    const double arm = (bar.position.cast<double>() - hinge).norm();
    start = Swing(bar.position.cast<double>());
    const double inertia = own.inertia + own.mass * arm * arm;
    const double g = scene.gravity.cast<double>().norm();
    period =
        4 * std::sqrt(inertia / (own.mass * g * arm)) * EllipticK(std::fabs(std::sin(start / 2)));
  }
  /// rad from straight down.
  double Swing(const Eigen::Vector2d& centre) const {
    return std::atan2(centre.x() - hinge.x(), hinge.y() - centre.y());
  }

  Eigen::Vector2d hinge;  ///< m
  int body;
  double start = 0;   ///< rad
  double period = 0;  ///< s, T = 4 sqrt(I/(m g d)) K(sin(start/2))
};

/// The first whole period, between the first and the third passage of the lowest point; passages
/// lie on straight lines between ticks.
class PeriodJudge : public Judge {
 public:
  explicit PeriodJudge(const Scene& scene) : pendulum_(scene), before_(pendulum_.start) {}

  void See(const World& world) override {
    const double now = pendulum_.Swing(Place(world, pendulum_.body));
    if (passages_ < 3 && (before_ < 0) != (now < 0)) {
      const double at = Seconds(world) - now / (now - before_) / world.scene().solver.tick_hz;
      if (++passages_ == 1) first_ = at;
      if (passages_ == 3) measured_ = at - first_;
    }
    before_ = now;
  }

  double Error() const override { return std::fabs(measured_ / pendulum_.period - 1); }

 private:
  const Pendulum pendulum_;
  double before_;
  int passages_ = 0;
  double first_ = 0;
  double measured_ = std::numeric_limits<double>::infinity();  // three passages never came
};

/// What began level and at rest has sum m g |x - hinge| to fall, and keeps its energy. The share
/// of that which it lost or gained, at worst.
std::unique_ptr<Judge> EnergyKept(const Scene& scene) {
  const double hinge = static_cast<double>(scene.joints.front().anchor_a.x());
  const double g = scene.gravity.cast<double>().norm();
  double fall = 0;
  for (const Part& part : scene.parts) {
    if (part.anchored) continue;
    const double arm = std::fabs(static_cast<double>(part.position.x()) - hinge);
    fall += PartProperties(part).mass * g * arm;
  }
  const double first = World(scene).Energy();
  return std::make_unique<Worst>(
      [fall, first](const World& world) { return std::fabs(world.Energy() - first) / fall; });
}

}  // namespace

std::vector<HardCase> PendulumCases() {
  const std::string energy = "worst change of energy over 60 s, of what there is to fall";
  return {
      {"pendulum-double",
       "double-pendulum",
       Truth::kFormula,
       "J/J",
       energy,
       60,
       EnergyKept,
       {},
       {1, 2, 3}},
      {"pendulum-energy", "pendulum", Truth::kFormula, "J/J", energy, 60, EnergyKept, {}},
      {"pendulum-period",
       "pendulum",
       Truth::kFormula,
       "s/s",
       "the first period from 90 degrees against 4 sqrt(I/(m g d)) K(sin 45)",
       4,
       MakeJudge<PeriodJudge>,
       {}},
  };
}

}  // namespace seam
