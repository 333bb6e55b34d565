/// The factorisation of the exact joints against Eigen's.

#include "common/physics/exact/skyline.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstdint>

#include "common/base/random.h"

namespace seam {
namespace skyline_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A seeded number, -1..1.
double Any(Random* random) { return random->Uniform(-1, 1); }

/// A symmetric positive matrix whose rows begin at `first`.
struct Sample {
  std::vector<int> first;
  MatrixXd a;
};

/// L L' of a random L with that envelope has the same envelope.
Sample RandomSample(int n, int reach, Random* random) {
  Sample out;
  MatrixXd l = MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    const int back = static_cast<int>(random->Uniform() * (reach + 1));
    out.first.push_back(std::max(0, i - back));
    for (int k = out.first.back(); k < i; ++k) l(i, k) = Any(random);
    l(i, i) = 1.5 + Any(random);
  }
  out.a = l * l.transpose();
  return out;
}

void Put(const Sample& sample, Skyline* to) {
  to->SetShape(sample.first);
  to->Clear();
  for (int i = 0; i < to->size(); ++i) {
    for (int k = sample.first[static_cast<std::size_t>(i)]; k <= i; ++k) {
      to->At(to->Place(i, k)) = sample.a(i, k);
    }
  }
}

std::vector<double> AnySide(int n, const std::vector<char>& in, Random* random) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(in[static_cast<std::size_t>(i)] ? Any(random) : 0);
  return x;
}

/// Eigen's answer, rows that are out being those of the identity.
VectorXd EigensAnswer(const MatrixXd& a, const std::vector<char>& in,
                      const std::vector<double>& side) {
  const auto n = static_cast<int>(side.size());
  MatrixXd left = MatrixXd::Identity(n, n);
  VectorXd b(n);
  for (int i = 0; i < n; ++i) {
    b(i) = side[static_cast<std::size_t>(i)];
    for (int k = 0; k < n; ++k) {
      const bool both = in[static_cast<std::size_t>(i)] && in[static_cast<std::size_t>(k)];
      if (both) left(i, k) = a(i, k);
    }
  }
  const Eigen::SparseMatrix<double> sparse = left.sparseView();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(sparse);
  return solver.solve(b);
}

double Difference(const std::vector<double>& x, const VectorXd& exact) {
  double most = 0;
  for (int i = 0; i < exact.size(); ++i) {
    most = std::max(most, std::fabs(x[static_cast<std::size_t>(i)] - exact(i)));
  }
  return most / exact.cwiseAbs().maxCoeff();
}

std::vector<char> AnyRows(int n, double share, Random* random) {
  std::vector<char> in;
  for (int i = 0; i < n; ++i) in.push_back(random->Uniform() < share ? 1 : 0);
  in[0] = 1;
  return in;
}

TEST(Skyline, SolvesAsEigenDoesWithAnyRowsLeftOut) {
  Random random(7);
  for (int round = 0; round < 60; ++round) {
    const int n = 1 + round;
    const Sample sample = RandomSample(n, 1 + round % 12, &random);
    Skyline skyline;
    Put(sample, &skyline);
    for (const double share : {1.0, 0.7, 0.2}) {
      const std::vector<char> in = AnyRows(n, share, &random);
      std::vector<double> x = AnySide(n, in, &random);
      const VectorXd exact = EigensAnswer(sample.a, in, x);
      skyline.Factor(in, 0);
      skyline.Solve(&x);
      EXPECT_LT(Difference(x, exact), 1e-10) << n << " rows, " << share;
      for (int i = 0; i < n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (!in[at]) {
          EXPECT_EQ(x[at], 0) << i;
        }
      }
    }
  }
}

TEST(Skyline, FactorsFromTheFirstRowThatChangedAsIfFromTheBeginning) {
  Random random(11);
  for (int round = 0; round < 40; ++round) {
    const int n = 5 + round;
    const Sample sample = RandomSample(n, 6, &random);
    Skyline changed, fresh;
    Put(sample, &changed);
    Put(sample, &fresh);
    std::vector<char> in = AnyRows(n, 0.7, &random);
    changed.Factor(in, 0);
    const int from = static_cast<int>(random.Uniform() * n);
    for (int i = from; i < n; ++i) {
      in[static_cast<std::size_t>(i)] = random.Uniform() < 0.5 ? 1 : 0;
    }
    std::vector<double> x = AnySide(n, in, &random), y = x;
    changed.Factor(in, from);
    changed.Solve(&x);
    fresh.Factor(in, 0);
    fresh.Solve(&y);
    EXPECT_EQ(x, y) << n << " rows from " << from;
  }
}

TEST(Skyline, SolvesIndependentBlocksSeparately) {
  Random random(3);
  const Sample one = RandomSample(9, 4, &random), other = RandomSample(14, 5, &random);
  Sample both;
  both.a = MatrixXd::Zero(23, 23);
  both.a.topLeftCorner(9, 9) = one.a;
  both.a.bottomRightCorner(14, 14) = other.a;
  both.first = one.first;
  for (const int first : other.first) both.first.push_back(9 + first);
  Skyline skyline;
  Put(both, &skyline);
  const std::vector<char> in(23, 1);
  skyline.Factor(in, 0);
  std::vector<double> x = AnySide(23, in, &random);
  for (int i = 0; i < 9; ++i) x[static_cast<std::size_t>(i)] = 0.5;
  std::vector<double> whole = x;
  skyline.Solve(&whole);
  skyline.SolvePart(&x, 9, 23);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(x[i], 0.5) << "not of the part";
  for (std::size_t i = 9; i < 23; ++i) EXPECT_EQ(x[i], whole[i]) << i;
}

TEST(Skyline, ARedundantRowGetsZeroAndTheOthersAreSolved) {
  // The third row is the sum of the first two; the right-hand side is that of x = (1, 2, 0).
  Sample sample;
  sample.first = {0, 0, 0};
  sample.a.resize(3, 3);
  sample.a << 4, 1, 5, 1, 3, 4, 5, 4, 9;
  Skyline skyline;
  Put(sample, &skyline);
  skyline.Factor({1, 1, 1}, 0);
  std::vector<double> x = {6, 7, 13};
  skyline.Solve(&x);
  EXPECT_NEAR(x[0], 1, 1e-10);
  EXPECT_NEAR(x[1], 2, 1e-10);
  EXPECT_NEAR(x[2], 0, 1e-10);
}

TEST(Skyline, CostBoundsTheMultiplicationsOfAFactorisation) {
  EXPECT_EQ(Skyline::Cost({0, 0, 1, 0}), 0 + 2 + 2 + 8);  // widths 1, 2, 2, 4
}

}  // namespace skyline_test
}  // namespace seam
