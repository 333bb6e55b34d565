/// The rocking block (Housner 1963): when it strikes the ground, and how much turning is left.

#include <cmath>
#include <limits>

#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// A box that stands tilted on one corner, released at rest. With R half its diagonal,
/// p^2 = 3g/(4R) and alpha = atan(width/height), turning about the corner obeys
/// spin^2 = 2 p^2 (cos(alpha - start) - cos(alpha - angle)), which Housner linearises.
struct Rocking {
  explicit Rocking(const Scene& scene) {
    const Part& block = PartNamed(scene, "block");
    const Eigen::Vector2d size = block.size.cast<double>();
    body = BodyOf(scene, block.id);
    start = static_cast<double>(block.angle);
    alpha = std::atan2(size.x(), size.y());
    p = std::sqrt(3 * scene.gravity.cast<double>().norm() / (2 * size.norm()));
  }
  /// (spin/p)^2/2 gained between a tilt and standing upright.
  double Fall(double tilt) const { return std::cos(alpha - tilt) - std::cos(alpha); }

  /// s from the release to upright: the integral of 1/spin over angle = start - u^2, which has no
  /// pole, by Simpson's rule. Housner: acosh(1/(1 - start/alpha))/p.
  double QuarterPeriod() const {
    const int n = 200;
    const double end = std::sqrt(start);
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      const double u = end * i / n;
      // At u = 0 the limit: the bracket is sin(alpha - start) u^2.
      const double bracket =
          i == 0 ? std::sin(alpha - start)
                 : (std::cos(alpha - start) - std::cos(alpha - start + u * u)) / (u * u);
      sum += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * 2 / (p * std::sqrt(2 * bracket));
    }
    return sum * end / n / 3;
  }

  int body = 0;
  double start = 0, alpha = 0;  ///< rad
  double p = 0;                 ///< 1/s
};

class TimeJudge : public Judge {
 public:
  explicit TimeJudge(const Scene& scene)
      : rocking_(scene), exact_(rocking_.QuarterPeriod()), before_(rocking_.start) {}

  void See(const World& world) override {
    const double now = static_cast<double>(world.Read(rocking_.body).angle);
    if (std::isinf(struck_) && now <= 0 && before_ > 0) {
      struck_ = Seconds(world) - now / (now - before_) / world.scene().solver.tick_hz;
    }
    before_ = now;
  }

  double Error() const override { return std::fabs(struck_ / exact_ - 1); }

 private:
  const Rocking rocking_;
  const double exact_;  ///< s
  double before_;
  double struck_ = std::numeric_limits<double>::infinity();  ///< s; it never came down
};

/// Housner: angular momentum about the corner that is struck leaves 1 - 1.5 sin^2(alpha) of the
/// spin. Measured by how far the block rises on the other side before it turns back: what a blow in
/// the wrong place spoils, too.
class SpinJudge : public Judge {
 public:
  explicit SpinJudge(const Scene& scene) : rocking_(scene) {}

  void See(const World& world) override {
    const double now = static_cast<double>(world.Read(rocking_.body).angle);
    if (turned_ || std::isnan(now)) return;
    if (risen_ > 0 && -now < risen_) turned_ = true;  // it was at its highest
    if (-now > risen_) risen_ = -now;
  }

  double Error() const override {
    const double left = std::sqrt(rocking_.Fall(risen_) / rocking_.Fall(rocking_.start));
    const double sine = std::sin(rocking_.alpha);
    return std::fabs(left - (1 - 1.5 * sine * sine));
  }
  std::string Failure() const override { return turned_ ? "" : "did not rock back"; }

 private:
  const Rocking rocking_;
  double risen_ = 0;  ///< rad
  bool turned_ = false;
};

/// The block ten times as large, so that the engine's slop of 5 mm is a tenth of it.
void Tenfold(Scene* scene) {
  for (Part& part : scene->parts) {
    part.position *= 10;
    part.size *= 10;
    for (Vec2& point : part.points) point *= 10;
  }
}

}  // namespace

std::vector<HardCase> ToppleCases() {
  const std::string spin =
      "share of the spin left by the first blow against 1 - 1.5 sin^2(alpha) (Housner 1963), ";
  const std::string time =
      "time to the first blow against the integral of Housner's equation, not linearised, ";
  const std::string small = "block of 0.5 x 2 m", large = "block of 5 x 20 m";
  return {
      {"dominoes",
       "dominoes",
       Truth::kConverged,
       "m",
       "RMS distance of thirty dominoes from the run at 32 times the rate",
       6,
       {},
       {}},
      {"rocking-spin",
       "rocking-block",
       Truth::kFormula,
       "1",
       spin + small,
       4,
       MakeJudge<SpinJudge>,
       {}},
      {"rocking-spin-tenfold", "rocking-block", Truth::kFormula, "1", spin + large, 12,
       MakeJudge<SpinJudge>, Tenfold},
      {"rocking-time",
       "rocking-block",
       Truth::kFormula,
       "s/s",
       time + small,
       4,
       MakeJudge<TimeJudge>,
       {}},
      {"rocking-time-tenfold", "rocking-block", Truth::kFormula, "s/s", time + large, 12,
       MakeJudge<TimeJudge>, Tenfold},
  };
}

}  // namespace seam
