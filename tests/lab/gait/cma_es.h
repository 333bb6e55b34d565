#pragma once
/// CMA-ES, a search of the minimum of a function without derivatives: samples of a normal
/// distribution whose mean, width and covariance follow the better half of them. After Hansen, "The
/// CMA Evolution Strategy: A Tutorial", arXiv 1604.00772, figure 6, without negative weights.

#include <Eigen/Core>
#include <vector>

#include "common/base/random.h"

namespace seam {

class CmaEs {
 public:
  using Point = Eigen::VectorXd;

  /// Begins at `mean` with the deviation `sigma` in each direction. `lambda` samples a generation;
  /// 0: 4 + 3 ln n. The same seed gives the same samples.
  CmaEs(const Point& mean, double sigma, int lambda, std::uint64_t seed);

  /// The samples of the next generation.
  std::vector<Point> Ask();
  /// The function's values at the samples that Ask returned, in their order. Smaller is better;
  /// values that are no numbers count as the worst.
  void Tell(const std::vector<double>& values);

  const Point& mean() const { return mean_; }
  double sigma() const { return sigma_; }
  int lambda() const { return lambda_; }

 private:
  double Normal();
  void Decompose();

  int lambda_ = 0, mu_ = 0;
  Eigen::Index n_ = 0;
  Eigen::VectorXd weights_;
  double mu_eff_ = 0, c_sigma_ = 0, d_sigma_ = 0, c_c_ = 0, c_1_ = 0, c_mu_ = 0, chi_ = 0;
  Point mean_, path_sigma_, path_c_;
  double sigma_ = 1;
  Eigen::MatrixXd covariance_, axes_;  // axes_: eigenvectors in columns
  Eigen::VectorXd lengths_;            // square roots of the eigenvalues
  std::vector<Point> steps_;           // of the samples, in units of sigma
  int generation_ = 0;
  Random random_;
};

}  // namespace seam
