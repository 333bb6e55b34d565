#include "common/base/trig.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seam {
namespace {

constexpr double kTwoPi = 0x1.921fb54442d18p+2;  // 2 pi
constexpr double kReducible = 1e5;              // rad
// Half of pi as the sum of 33, 33 and 53 bits: the first two times a number of 20 bits are exact.
constexpr double kQuarter[3] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
constexpr double kQuartersPerRad = 0x1.45f306dc9c883p-1;

/// An angle without its whole quarter turns: `high + low`, -pi/4..pi/4, and their number.
struct Reduced {
  double high, low;
  int quarters;
};

Reduced Reduce(double angle) {
  const double n = std::nearbyint(angle * kQuartersPerRad);
  const double near = angle - n * kQuarter[0];  // exact
  const double next = n * kQuarter[1];
  const double high = near - next;
  // What the subtraction lost (Knuth's two-sum), and the third part.
  const double back = high - near;
  const double low = (near - (high - back)) - (next + back) - n * kQuarter[2];
  const double sum = high + low;
  return {sum, (high - sum) + low, static_cast<int>(n)};
}

/// Returns 1 - q / ((n + 1) (n + 2)) (1 - q / ((n + 3) (n + 4)) (1 - ...)): the series of sine from
/// its term x^n / n! on, or that of cosine, over that term.
template <int n, int terms>
double Series(double q) {
  if constexpr (terms == 0) {
    return 1;
  } else {
    return 1 - q * (1.0 / ((n + 1) * (n + 2))) * Series<n + 2, terms - 1>(q);
  }
}

/// atan(k / 8).
constexpr double kArctangents[] = {0,
                                   0x1.fd5ba9aac2f6ep-4,
                                   0x1.f5b75f92c80ddp-3,
                                   0x1.6f61941e4def1p-2,
                                   0x1.dac670561bb4fp-2,
                                   0x1.1e00babdefeb4p-1,
                                   0x1.4978fa3269ee1p-1,
                                   0x1.700a7c5784634p-1,
                                   0x1.921fb54442d18p-1};

/// Returns the arctangent of 0..1: that of the nearest eighth, and a series for the rest, which is
/// at most 1/16.
double Arctangent(double t) {
  const double k = std::nearbyint(8 * t), eighth = k / 8;
  const double u = (t - eighth) / (1 + t * eighth), q = u * u;
  double tail = 0;
  for (int n = 13; n >= 3; n -= 2) tail = q * ((n % 4 == 1 ? 1.0 : -1.0) / n + tail);
  return kArctangents[static_cast<int>(k)] + (u + u * tail);
}

}  // namespace

SinCos SineAndCosine(double angle) {
  if (!std::isfinite(angle)) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  if (std::fabs(angle) > kReducible) angle = std::remainder(angle, kTwoPi);
  const Reduced r = Reduce(angle);
  const double x = r.high, q = x * x, half = q / 2;
  const double one = 1 - half;
  const double cosine =
      one + (((1 - one) - half) + (q * q * (1.0 / 24) * Series<4, 7>(q) - x * r.low));
  const double sine = x + (r.low * one - x * q * (1.0 / 6) * Series<3, 7>(q));
  switch (r.quarters & 3) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
  }
}

double Atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double across = std::fabs(x), up = std::fabs(y);
  const double least = std::min(across, up), most = std::max(across, up);
  // Both zero or both infinite: as the standard has it.
  const double ratio = least == most ? (most > 0 ? 1 : 0) : least / most;
  double angle = Arctangent(ratio);
  constexpr double kHalfTurn = kTwoPi / 2, kHalfTurnRest = 0x1.1a62633145c07p-53;  // pi
  const double towards = std::signbit(x) ? -1 : 1;
  if (up > across) {
    angle = kHalfTurn / 2 - (towards * angle - kHalfTurnRest / 2);
  } else if (towards < 0) {
    angle = kHalfTurn - (angle - kHalfTurnRest);
  }
  return std::copysign(angle, y);
}

}  // namespace seam
