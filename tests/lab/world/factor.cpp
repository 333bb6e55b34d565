/// Why the exact joints have a factorisation of their own: Skyline beside Eigen's SimplicialLDLT,
/// whose analysis is kept, on the rows of a hanging chain of hinges.

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "common/base/random.h"
#include "common/physics/exact/skyline.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// J M^-1 J' of `links` rods of 1 m and 1 kg, each hinged to the one before it at any angle, the
/// first to a post: two rows a hinge.
Eigen::MatrixXd ChainMatrix(int links) {
  Random random(1);
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(2 * links, 3 * links);
  Eigen::VectorXd inverse_mass(3 * links);
  double before = 0;
  for (int i = 0; i < links; ++i) {
    const double angle = random.Uniform(-3, 3), ax = std::cos(angle) / 2, ay = std::sin(angle) / 2;
    inverse_mass.segment<3>(3 * i) << 1, 1, 12;
    // The hinge at its beginning: -(ax, ay) from its centre; at the end of the one before.
    j.block<2, 3>(2 * i, 3 * i) << 1, 0, ay, 0, 1, -ax;
    if (i > 0) {
      const double bx = std::cos(before) / 2, by = std::sin(before) / 2;
      j.block<2, 3>(2 * i, 3 * i - 3) << -1, 0, by, 0, -1, -bx;
    }
    before = angle;
  }
  return j * inverse_mass.asDiagonal() * j.transpose();
}

/// The same system for both; each Solve fills in the numbers, factors and solves.
class Ours {
 public:
  explicit Ours(const Eigen::MatrixXd& a) : in_(static_cast<std::size_t>(a.rows()), 1) {
    std::vector<int> first;
    for (int i = 0; i < a.rows(); ++i) {
      int begin = i;
      while (begin > 0 && (a.row(i).head(begin).array() != 0).any()) --begin;
      first.push_back(begin);
    }
    matrix_.SetShape(first);
    for (int i = 0; i < a.rows(); ++i) {
      for (int k = first[static_cast<std::size_t>(i)]; k <= i; ++k) {
        entries_.emplace_back(matrix_.Place(i, k), a(i, k));
      }
    }
  }
  void Solve(std::vector<double>* x) {
    for (const auto& [place, value] : entries_) matrix_.At(place) = value;
    matrix_.Factor(in_, 0);
    x->assign(in_.size(), 1.0);
    matrix_.Solve(x);
  }

 private:
  Skyline matrix_;
  std::vector<char> in_;
  std::vector<std::pair<int, double>> entries_;
};

class Eigens {
 public:
  explicit Eigens(const Eigen::MatrixXd& a)
      : matrix_(Eigen::MatrixXd(a.triangularView<Eigen::Lower>()).sparseView()),
        side_(Eigen::VectorXd::Ones(a.rows())) {
    matrix_.makeCompressed();
    values_.assign(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros());
    solver_.analyzePattern(matrix_);
  }
  void Solve(Eigen::VectorXd* x) {
    std::copy(values_.begin(), values_.end(), matrix_.valuePtr());
    solver_.factorize(matrix_);
    *x = solver_.solve(side_);
  }

 private:
  Sparse matrix_;
  Eigen::VectorXd side_;
  std::vector<double> values_;
  Eigen::SimplicialLDLT<Sparse> solver_;
};

}  // namespace

TextTable FactorBench(bool quick) {
  TextTable table;
  table.name = "world-factor";
  table.title = "A mechanism's rows factored and solved: Eigen beside the own skyline";
  table.header = {"rows", "skyline, us", "Eigen, us", "Eigen / skyline", "largest difference"};
  for (const int rows : {22, 62, 122}) {
    const Eigen::MatrixXd a = ChainMatrix(rows / 2);
    Ours ours(a);
    Eigens eigens(a);
    std::vector<double> x;
    Eigen::VectorXd y;
    const int times = (quick ? 100000 : 1000000) / rows;
    double us = 1e300;
    const auto run_ours = [&] {
      const double begin = CpuSeconds();
      for (int i = 0; i < times; ++i) ours.Solve(&x);
      us = std::min(us, 1e6 * (CpuSeconds() - begin) / times);
    };
    const auto run_eigens = [&] {
      for (int i = 0; i < times; ++i) eigens.Solve(&y);
    };
    const double ratio = CostRatio(run_ours, run_eigens, quick ? 5 : 15);
    double difference = 0;
    for (int i = 0; i < rows; ++i) {
      difference = std::max(difference, std::fabs(x[static_cast<std::size_t>(i)] - y(i)));
    }
    table.rows.push_back({std::to_string(rows), Digits(us), Digits(us * ratio),
                          fmt::format("{:.2f} x", ratio),
                          fmt::format("{:.1e}", difference / y.cwiseAbs().maxCoeff())});
  }
  table.note =
      "A chain of 11, 31, 61 hinged rods; both fill in the numbers, factor and solve; Eigen 3's "
      "SimplicialLDLT with its analysis kept. The difference is relative.";
  table.command = "seam-lab world factor";
  return table;
}

}  // namespace seam
