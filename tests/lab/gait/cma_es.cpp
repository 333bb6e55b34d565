#include "tests/lab/gait/cma_es.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/base/check.h"

namespace seam {

CmaEs::CmaEs(const Point& mean, double sigma, int lambda, std::uint64_t seed)
    : n_(mean.size()), mean_(mean), sigma_(sigma), random_(seed) {
  const auto n = static_cast<double>(n_);
  lambda_ = lambda > 0 ? lambda : 4 + static_cast<int>(3 * std::log(n));
  SEAM_ASSERT(n_ > 0 && lambda_ >= 2 && sigma > 0);
  mu_ = lambda_ / 2;
  weights_.resize(mu_);
  for (int i = 0; i < mu_; ++i) weights_[i] = std::log(0.5 * (lambda_ + 1)) - std::log(i + 1);
  weights_ /= weights_.sum();
  // The tutorial's default parameters, its table 1.
  mu_eff_ = 1 / weights_.squaredNorm();
  c_sigma_ = (mu_eff_ + 2) / (n + mu_eff_ + 5);
  d_sigma_ = 1 + 2 * std::max(0.0, std::sqrt((mu_eff_ - 1) / (n + 1)) - 1) + c_sigma_;
  c_c_ = (4 + mu_eff_ / n) / (n + 4 + 2 * mu_eff_ / n);
  c_1_ = 2 / ((n + 1.3) * (n + 1.3) + mu_eff_);
  c_mu_ =
      std::min(1 - c_1_, 2 * (0.25 + mu_eff_ + 1 / mu_eff_ - 2) / ((n + 2) * (n + 2) + mu_eff_));
  chi_ = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
  path_sigma_ = path_c_ = Point::Zero(n_);
  covariance_ = Eigen::MatrixXd::Identity(n_, n_);
  Decompose();
}

/// Of the standard normal distribution (Box and Muller).
double CmaEs::Normal() {
  const double radius = std::sqrt(2 * random_.Exponential(1));
  return radius * std::cos(2 * 3.14159265358979323846 * random_.Uniform());
}

void CmaEs::Decompose() {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance_);
  axes_ = solver.eigenvectors();
  lengths_ = solver.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
}

std::vector<CmaEs::Point> CmaEs::Ask() {
  steps_.clear();
  std::vector<Point> points;
  for (int k = 0; k < lambda_; ++k) {
    Point z(n_);
    for (double& component : z) component = Normal();
    steps_.push_back(axes_ * lengths_.cwiseProduct(z));
    points.push_back(mean_ + sigma_ * steps_.back());
  }
  return points;
}

void CmaEs::Tell(const std::vector<double>& values) {
  SEAM_ASSERT(values.size() == steps_.size() && !values.empty());
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto worth = [&](std::size_t i) {
    return std::isnan(values[i]) ? std::numeric_limits<double>::infinity() : values[i];
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return worth(a) < worth(b); });
  Point step = Point::Zero(n_);
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(n_, n_);
  for (int i = 0; i < mu_; ++i) {
    const Point& y = steps_[order[static_cast<std::size_t>(i)]];
    step += weights_[i] * y;
    spread += weights_[i] * y * y.transpose();
  }
  mean_ += sigma_ * step;
  ++generation_;
  const Point whitened =
      axes_ * (axes_.transpose() * step).cwiseQuotient(lengths_);  // C^-1/2 times the step
  path_sigma_ =
      (1 - c_sigma_) * path_sigma_ + std::sqrt(c_sigma_ * (2 - c_sigma_) * mu_eff_) * whitened;
  const double length = path_sigma_.norm();
  const double begun = std::sqrt(1 - std::pow(1 - c_sigma_, 2 * generation_));
  const bool slow = length / begun < (1.4 + 2 / (static_cast<double>(n_) + 1)) * chi_;
  path_c_ *= 1 - c_c_;
  if (slow) path_c_ += std::sqrt(c_c_ * (2 - c_c_) * mu_eff_) * step;
  const double held = slow ? 0 : c_1_ * c_c_ * (2 - c_c_);
  covariance_ = (1 + held - c_1_ - c_mu_) * covariance_ + c_1_ * path_c_ * path_c_.transpose() +
                c_mu_ * spread;
  sigma_ *= std::exp(c_sigma_ / d_sigma_ * (length / chi_ - 1));
  Decompose();
}

}  // namespace seam
