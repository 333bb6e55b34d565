/// Three parallel cranks on one coupler, driven by one motor: a loop that is held twice over.

#include <cmath>

#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// Each crank turns by the motor's speed times the time, from where it began; the coupler never
/// turns. The greatest angle by which one of the four is wrong.
std::unique_ptr<Judge> CrankAngles(const Scene& scene) {
  struct Turning {
    int body;
    double start, speed;  ///< rad, rad/s
  };
  double motor = 0;
  for (const Joint& joint : scene.joints) {
    if (joint.motor_torque > 0) motor = static_cast<double>(joint.motor_speed);
  }
  std::vector<Turning> all;
  for (const Part& part : scene.parts) {
    if (part.anchored) continue;
    const bool crank = part.name.rfind("crank", 0) == 0;
    all.push_back({BodyOf(scene, part.id), static_cast<double>(part.angle), crank ? motor : 0});
  }
  return std::make_unique<Worst>([all](const World& world) {
    double worst = 0;
    for (const Turning& one : all) {
      const double exact = one.start + one.speed * Seconds(world);
      worst = Worse(worst, std::fabs(static_cast<double>(world.Read(one.body).angle) - exact));
    }
    return worst;
  });
}

}  // namespace

std::vector<HardCase> LinkageCases() {
  return {{"motor-loop",
           "motor-loop",
           Truth::kFormula,
           "rad",
           "worst angle of three cranks on one coupler from the motor's speed times t",
           20,
           CrankAngles,
           {}}};
}

}  // namespace seam
