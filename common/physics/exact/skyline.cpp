#include "common/physics/exact/skyline.h"

#include <algorithm>

namespace seam {
namespace {

/// A pivot below this share of its diagonal is rounding.
constexpr double kDependent = 1e-10;
/// Replaces the inverse of such a pivot.
constexpr double kNoShare = 1e-30;

/// Sums in two halves, independent of the compiler: results must not depend on it.
inline double Dot(const double* a, const double* b, int from, int to) {
  double even = 0, odd = 0;
  for (; from + 1 < to; from += 2) {
    even += a[from] * b[from];
    odd += a[from + 1] * b[from + 1];
  }
  return from < to ? even + odd + a[from] * b[from] : even + odd;
}

long RowCost(const std::vector<int>& first, std::size_t row) {
  const long width = static_cast<long>(row) - first[row] + 1;
  return width * width / 2;
}

inline double Inverse(double left, double diagonal) {
  return left > kDependent * diagonal ? 1 / left : kNoShare;
}

}  // namespace

long Skyline::Cost(const std::vector<int>& first) {
  long cost = 0;
  for (std::size_t i = 0; i < first.size(); ++i) cost += RowCost(first, i);
  return cost;
}

void Skyline::SetShape(const std::vector<int>& first) {
  first_ = first;
  start_.resize(first.size());
  cost_.assign(1, 0);
  int next = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    start_[i] = next - first[i];
    next += static_cast<int>(i) - first[i] + 1;
    cost_.push_back(cost_.back() + RowCost(first, i));
  }
  matrix_.assign(static_cast<std::size_t>(next), 0.0);
  factor_.assign(static_cast<std::size_t>(next), 0.0);
  inverse_.assign(first.size(), 1.0);
  leads_.assign(first.size(), 0);
  int widest = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    widest = std::max(widest, static_cast<int>(i) - first[i] + 1);
    const bool second = i > 0 && leads_[i - 1];
    leads_[i] = !second && i + 1 < first.size() && first[i + 1] == first[i];
  }
  two_.assign(static_cast<std::size_t>(widest), Two{0, 0});
}

void Skyline::Clear(int from) {
  if (from >= size()) return;
  const auto row = static_cast<std::size_t>(from);
  std::fill(matrix_.begin() + start_[row] + first_[row], matrix_.end(), 0.0);
}

void Skyline::Factor(const std::vector<char>& in, int from) {
  // The second row of a pair is factored again together with the first, with the same result.
  if (from > 0 && from < size() && leads_[static_cast<std::size_t>(from - 1)]) --from;
  for (int i = from; i < size(); ++i) {
    if (leads_[static_cast<std::size_t>(i)]) {
      FactorTwo(in.data(), i++);
    } else {
      FactorOne(in.data(), i);
    }
  }
}

void Skyline::FactorOne(const char* in, int i) {
  const int* const start = start_.data();
  const int* const first = first_.data();
  double* const factor = factor_.data();
  double* const inverse = inverse_.data();
  const double* a = matrix_.data() + start[i];
  double* l = factor + start[i];
  const int begin = first[i];
  if (!in[i]) {
    std::fill(l + begin, l + i, 0.0);
    inverse[i] = 1;
    return;
  }
  for (int k = begin; k < i; ++k) {
    l[k] = in[k] ? a[k] - Dot(l, factor + start[k], std::max(begin, first[k]), k) : 0;
  }
  // l holds L D here; the dots above used the other rows' L.
  double left = a[i];
  for (int k = begin; k < i; ++k) {
    const double share = l[k] * inverse[k];
    left -= l[k] * share;
    l[k] = share;
  }
  inverse[i] = Inverse(left, a[i]);
}

/// Factors rows i and i + 1, which begin in the same column, and reads each column of the rows
/// above once for both. Same sums in the same order as in FactorOne.
void Skyline::FactorTwo(const char* in, int i) {
  const int* const start = start_.data();
  const int* const first = first_.data();
  double* const factor = factor_.data();
  double* const inverse = inverse_.data();
  const double* a = matrix_.data() + start[i];
  const double* b = matrix_.data() + start[i + 1];
  const int begin = first[i];
  Two* const both = two_.data();  // from column `begin` on: L D
  for (int k = begin; k < i; ++k) {
    if (!in[k]) {
      both[k - begin] = Two{0, 0};
      continue;
    }
    const double* const l = factor + start[k];
    Two even{0, 0}, odd{0, 0};
    int m = std::max(begin, first[k]);
    for (; m + 1 < k; m += 2) {
      even += l[m] * both[m - begin];
      odd += l[m + 1] * both[m + 1 - begin];
    }
    Two sum = even + odd;
    if (m < k) sum += l[m] * both[m - begin];
    both[k - begin] = Two{a[k], b[k]} - sum;
  }
  double* l = factor + start[i];
  double* next = factor + start[i + 1];
  Two left{a[i], b[i + 1]};
  for (int k = begin; k < i; ++k) {
    const Two old = both[k - begin];
    const Two share = old * inverse[k];
    left -= old * share;
    l[k] = share[0];
    next[k] = share[1];
  }
  if (in[i]) {
    inverse[i] = Inverse(left[0], a[i]);
  } else {
    std::fill(l + begin, l + i, 0.0);
    inverse[i] = 1;
  }
  if (!in[i + 1]) {
    std::fill(next + begin, next + i + 1, 0.0);
    inverse[i + 1] = 1;
    return;
  }
  next[i] = 0;
  if (in[i]) {
    double even = 0, odd = 0;
    int m = begin;
    for (; m + 1 < i; m += 2) {
      even += both[m - begin][1] * l[m];
      odd += both[m + 1 - begin][1] * l[m + 1];
    }
    double sum = even + odd;
    if (m < i) sum += both[m - begin][1] * l[m];
    const double old = b[i] - sum;
    next[i] = old * inverse[i];
    left[1] -= old * next[i];
  }
  inverse[i + 1] = Inverse(left[1], b[i + 1]);
}

void Skyline::SolvePart(std::vector<double>* x, int from, int to) const {
  const int* const start = start_.data();
  const int* const first = first_.data();
  const char* const leads = leads_.data();
  const double* const factor = factor_.data();
  double* v = x->data();
  for (int i = from; i < to; ++i) {
    const double* const a = factor + start[i];
    if (!leads[i]) {
      v[i] -= Dot(a, v, first[i], i);
      continue;
    }
    const double* const b = factor + start[i + 1];
    double even_a = 0, odd_a = 0, even_b = 0, odd_b = 0;
    int k = first[i];
    for (; k + 1 < i; k += 2) {
      even_a += a[k] * v[k];
      odd_a += a[k + 1] * v[k + 1];
      even_b += b[k] * v[k];
      odd_b += b[k + 1] * v[k + 1];
    }
    if (k < i) {
      v[i] -= even_a + odd_a + a[k] * v[k];
      even_b += b[k] * v[k];
      odd_b += b[i] * v[i];
      v[i + 1] -= even_b + odd_b;
    } else {
      v[i] -= even_a + odd_a;
      v[i + 1] -= even_b + odd_b + b[i] * v[i];
    }
    ++i;
  }
  for (int i = from; i < to; ++i) v[i] *= inverse_[static_cast<std::size_t>(i)];
  for (int i = to - 1; i >= from; --i) {
    const double* const b = factor + start[i];
    const double done = v[i];
    if (i == from || !leads[i - 1]) {
      if (done == 0) continue;
      for (int k = first[i]; k < i; ++k) v[k] -= b[k] * done;
      continue;
    }
    --i;
    const double* const a = factor + start[i];
    v[i] -= b[i] * done;
    const double before = v[i];
    if (done == 0 && before == 0) continue;
    for (int k = first[i]; k < i; ++k) v[k] = v[k] - b[k] * done - a[k] * before;
  }
}

}  // namespace seam
