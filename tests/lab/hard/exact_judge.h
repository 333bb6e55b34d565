#pragma once
/// What the judges of cases with an exact answer share: things found in a scene by name, the worst
/// of a number over a run, and the pendulum's integral.

#include <string_view>

#include "tests/lab/hard/hard_case.h"

namespace seam {

/// The greater of two errors; NaN if one is.
double Worse(double a, double b);

/// Error: the greatest of what `wrong` says at tick 0 and after each tick. NaN stays NaN.
class Worst : public Judge {
 public:
  explicit Worst(std::function<double(const World&)> wrong) : wrong_(std::move(wrong)) {}
  void See(const World& world) override;
  double Error() const override { return worst_; }

 private:
  std::function<double(const World&)> wrong_;
  double worst_ = 0;
};

/// Error: what `wrong` says after the last tick.
class Last : public Judge {
 public:
  explicit Last(std::function<double(const World&)> wrong) : wrong_(std::move(wrong)) {}
  void See(const World& world) override { last_ = wrong_(world); }
  double Error() const override { return last_; }

 private:
  std::function<double(const World&)> wrong_;
  double last_ = 0;
};

template <typename T>
std::unique_ptr<Judge> MakeJudge(const Scene& scene) {
  return std::make_unique<T>(scene);
}

/// Requires that there is such a part (asserted): the judges know their scenes.
const Part& PartNamed(const Scene& scene, std::string_view name);
/// World's index of the moving assembly that this part belongs to. Asserts that there is one.
int BodyOf(const Scene& scene, PartId part);

/// s since tick 0.
double Seconds(const World& world);
/// m; of the body's root part.
Eigen::Vector2d Place(const World& world, int body);
/// m/s
Eigen::Vector2d Speed(const World& world, int body);

/// Complete elliptic integral of the first kind, modulus k in [0, 1), by the arithmetic-geometric
/// mean (Gauss 1799).
double EllipticK(double k);

/// The lists that ExactCases() joins, one for each file of judges.
std::vector<HardCase> FlightCases();
std::vector<HardCase> FrictionCases();
std::vector<HardCase> PendulumCases();
std::vector<HardCase> CollisionCases();
std::vector<HardCase> CradleCases();
std::vector<HardCase> ToppleCases();
std::vector<HardCase> ChainCases();
std::vector<HardCase> LinkageCases();
std::vector<HardCase> TunnelCases();

}  // namespace seam
