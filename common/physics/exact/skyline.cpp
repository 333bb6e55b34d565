#include "common/physics/exact/skyline.h"

#include <algorithm>

namespace seam {
namespace {

/// A pivot below this share of its diagonal is rounding.
constexpr double kDependent = 1e-10;
/// In place of its inverse then.
constexpr double kNoShare = 1e-30;

/// In two halves, whatever the compiler would do: sums must not depend on it.
inline double Dot(const double* a, const double* b, int from, int to) {
  double even = 0, odd = 0;
  for (; from + 1 < to; from += 2) {
    even += a[from] * b[from];
    odd += a[from + 1] * b[from + 1];
  }
  return from < to ? even + odd + a[from] * b[from] : even + odd;
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
  inverse_.assign(first.size(), 1.0);
}

void Skyline::Clear() { std::fill(matrix_.begin(), matrix_.end(), 0.0); }

void Skyline::Factor(const std::vector<char>& in, int from) {
  const int* const start = start_.data();
  const int* const first = first_.data();
  double* const factor = factor_.data();
  double* const inverse = inverse_.data();
  for (int i = from; i < size(); ++i) {
    const double* a = matrix_.data() + start[i];
    double* l = factor + start[i];
    const int begin = first[i];
    if (!in[static_cast<std::size_t>(i)]) {
      std::fill(l + begin, l + i, 0.0);
      inverse[i] = 1;
      continue;
    }
    for (int k = begin; k < i; ++k) {
      if (!in[static_cast<std::size_t>(k)]) {
        l[k] = 0;
        continue;
      }
      l[k] = a[k] - Dot(l, factor + start[k], std::max(begin, first[k]), k);
    }
    // l holds L D so far; the dots above had the other rows' own L.
    double left = a[i];
    for (int k = begin; k < i; ++k) {
      const double share = l[k] * inverse[k];
      left -= l[k] * share;
      l[k] = share;
    }
    inverse[i] = left > kDependent * a[i] ? 1 / left : kNoShare;
  }
}

void Skyline::SolvePart(std::vector<double>* x, int from, int to) const {
  const int* const start = start_.data();
  const int* const first = first_.data();
  const double* const factor = factor_.data();
  double* v = x->data();
  for (int i = from; i < to; ++i) v[i] -= Dot(factor + start[i], v, first[i], i);
  for (int i = from; i < to; ++i) v[i] *= inverse_[static_cast<std::size_t>(i)];
  for (int i = to - 1; i >= from; --i) {
    const double* l = factor + start[i];
    const double done = v[i];
    if (done == 0) continue;
    for (int k = first[i]; k < i; ++k) v[k] -= l[k] * done;
  }
}

}  // namespace seam
