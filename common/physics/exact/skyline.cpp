#include "common/physics/exact/skyline.h"

#include <algorithm>

namespace seam {
namespace {

/// A pivot below this share of its diagonal is rounding.
constexpr double kDependent = 1e-10;
/// Divides to nothing.
constexpr double kNoShare = 1e30;

/// In two halves, whatever the compiler would do: sums must not depend on it.
double Dot(const double* a, const double* b, int from, int to) {
  double even = 0, odd = 0;
  int t = from;
  for (; t + 1 < to; t += 2) {
    even += a[t] * b[t];
    odd += a[t + 1] * b[t + 1];
  }
  if (t < to) even += a[t] * b[t];
  return even + odd;
}

}  // namespace

void Skyline::SetShape(const std::vector<int>& first) {
  first_ = first;
  start_.resize(first.size());
  int next = 0;
  cost_ = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    start_[i] = next - first[i];
    const int width = static_cast<int>(i) - first[i] + 1;
    next += width;
    cost_ += long{width} * width / 2;
  }
  matrix_.assign(static_cast<std::size_t>(next), 0.0);
  factor_.assign(static_cast<std::size_t>(next), 0.0);
  diagonal_.assign(first.size(), 1.0);
}

void Skyline::Clear() { std::fill(matrix_.begin(), matrix_.end(), 0.0); }

void Skyline::Factor(const std::vector<char>& in, int from) {
  for (int i = from; i < size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    const double* a = matrix_.data() + start_[row];
    double* l = factor_.data() + start_[row];
    const int first = first_[row];
    if (!in[row]) {
      std::fill(l + first, l + i, 0.0);
      diagonal_[row] = 1;
      continue;
    }
    for (int k = first; k < i; ++k) {
      const auto column = static_cast<std::size_t>(k);
      if (!in[column]) {
        l[k] = 0;
        continue;
      }
      const double* other = factor_.data() + start_[column];
      l[k] = a[k] - Dot(l, other, std::max(first, first_[column]), k);
    }
    // l holds L D so far; the dots above had the rows' own L.
    double left = a[i];
    for (int k = first; k < i; ++k) {
      const double share = l[k] / diagonal_[static_cast<std::size_t>(k)];
      left -= l[k] * share;
      l[k] = share;
    }
    diagonal_[row] = left > kDependent * a[i] ? left : kNoShare;
  }
}

void Skyline::Solve(std::vector<double>* x) const {
  double* v = x->data();
  for (int i = 0; i < size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    v[i] -= Dot(factor_.data() + start_[row], v, first_[row], i);
  }
  for (int i = 0; i < size(); ++i) v[i] /= diagonal_[static_cast<std::size_t>(i)];
  for (int i = size() - 1; i >= 0; --i) {
    const auto row = static_cast<std::size_t>(i);
    const double* l = factor_.data() + start_[row];
    const double done = v[i];
    if (done == 0) continue;
    for (int k = first_[row]; k < i; ++k) v[k] -= l[k] * done;
  }
}

}  // namespace seam
