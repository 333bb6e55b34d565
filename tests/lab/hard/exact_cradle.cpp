/// Newton's cradle: what the first ball brings, the last takes away, and the rest hang still.

#include <cmath>

#include "common/scene/mass.h"
#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// Looks once, half a period after the release, when the last ball is at its highest. Every ball's
/// energy per mass above hanging still, as a share of what the first was released with: 1 for the
/// last, 0 for the others. Error: the greatest difference.
class CradleJudge : public Judge {
 public:
  explicit CradleJudge(const Scene& scene) {
    for (const Joint& string : scene.joints) {
      const double length = static_cast<double>(string.length);
      hooks_.push_back(string.anchor_a.cast<double>());
      lengths_.push_back(length);
      bodies_.push_back(BodyOf(scene, string.b));
    }
    const Part& first = scene.parts[static_cast<std::size_t>(scene.joints.front().b)];
    gravity_ = scene.gravity.cast<double>().norm();
    released_ = gravity_ * Height(0, first.position.cast<double>());
    // A ball without spin on a string is a simple pendulum.
    const double swing = std::acos(1 - released_ / gravity_ / lengths_.front());
    half_period_ = 2 * std::sqrt(lengths_.front() / gravity_) * EllipticK(std::sin(swing / 2));
  }

  void See(const World& world) override {
    if (seen_ || Seconds(world) < half_period_) return;
    seen_ = true;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const double energy = gravity_ * Height(i, Place(world, bodies_[i])) +
                            Speed(world, bodies_[i]).squaredNorm() / 2;
      const double truth = i + 1 == bodies_.size() ? 1 : 0;
      error_ = Worse(error_, std::fabs(energy / released_ - truth));
    }
  }

  double Error() const override { return seen_ ? error_ : std::nan(""); }

 private:
  /// m above hanging still.
  double Height(std::size_t i, const Eigen::Vector2d& ball) const {
    return ball.y() - (hooks_[i].y() - lengths_[i]);
  }

  std::vector<Eigen::Vector2d> hooks_;
  std::vector<double> lengths_;
  std::vector<int> bodies_;
  double gravity_ = 0;
  double released_ = 0;     ///< J/kg
  double half_period_ = 0;  ///< s
  bool seen_ = false;
  double error_ = 0;
};

/// The scene's gaps of 2 cm closed: ball i and its hook move i gaps to the left.
void CloseGaps(Scene* scene) {
  for (std::size_t i = 0; i < scene->joints.size(); ++i) {
    Joint& string = scene->joints[i];
    const Vec2 closing(-0.02f * static_cast<float>(i), 0);
    string.anchor_a += closing;
    string.anchor_b += closing;
    scene->parts[static_cast<std::size_t>(string.b)].position += closing;
  }
}

}  // namespace

std::vector<HardCase> CradleCases() {
  const std::string shares =
      "worst error of a ball's share of the energy at half a period: 1 for "
      "the last, 0 for the others; ";
  return {
      {"cradle-gaps",
       "newton-cradle",
       Truth::kFormula,
       "J/J",
       shares + "2 cm between the balls",
       3,
       MakeJudge<CradleJudge>,
       {}},
      {"cradle-touching", "newton-cradle", Truth::kFormula, "J/J", shares + "the balls touch", 3,
       MakeJudge<CradleJudge>, CloseGaps},
  };
}

}  // namespace seam
