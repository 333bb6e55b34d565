/// Checks sine, cosine and arctangent beside those of long doubles, and their bits.

#include "common/base/trig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/base/bytes.h"
#include "common/base/random.h"

namespace seam {
namespace trig_test {

/// Returns |got - wanted| in units of the last place of `wanted`.
double UnitsOff(double got, long double wanted) {
  const double near = std::fabs(static_cast<double>(wanted));
  const double unit = std::nextafter(near, HUGE_VAL) - near;
  return static_cast<double>(std::fabs(got - wanted) / static_cast<long double>(unit));
}

TEST(Trig, SineAndCosineAreRightToOneUnitInTheLastPlace) {
  Random random(1);
  double worst = 0;
  for (const double range : {1e-5, 0.8, 4.0, 100.0, 1e5}) {
    for (int i = 0; i < 20000; ++i) {
      const double a = random.Uniform(-range, range);
      const SinCos both = SineAndCosine(a);
      worst = std::max(worst, UnitsOff(both.sine, sinl(a)));
      worst = std::max(worst, UnitsOff(both.cosine, cosl(a)));
    }
  }
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.5);  // the measure itself measures
}

TEST(Trig, MultiplesOfAQuarterTurnKeepTheirDigits) {
  for (int n = 1; n < 60000; ++n) {
    const double a = n * 1.5707963267948966;
    const SinCos both = SineAndCosine(a);
    EXPECT_LT(UnitsOff(both.sine, sinl(a)), 1) << n;
    EXPECT_LT(UnitsOff(both.cosine, cosl(a)), 1) << n;
  }
}

TEST(Trig, LargeAnglesAreOffByLessThanHalfTheDistanceOfNeighbours) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double a = random.Uniform(1e5, 1e15);
    const double half = (std::nextafter(a, HUGE_VAL) - a) / 2;
    EXPECT_LE(std::fabs(Sin(a) - static_cast<double>(sinl(a))), half) << a;
  }
}

TEST(Trig, NoAngleIsNoNumber) {
  for (const double a : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_TRUE(std::isnan(Sin(a)) && std::isnan(Cos(a)));
  }
  EXPECT_TRUE(std::isnan(Atan2(std::nan(""), 1.0)) && std::isnan(Atan2(1.0, std::nan(""))));
}

TEST(Trig, ZerosAndInfinitiesAreAsTheStandardHasThem) {
  const double numbers[] = {0.0, -0.0, 1.0, -1.0, HUGE_VAL, -HUGE_VAL};
  for (const double y : numbers) {
    for (const double x : numbers) {
      EXPECT_EQ(Atan2(y, x), std::atan2(y, x)) << y << " " << x;
      EXPECT_EQ(std::signbit(Atan2(y, x)), std::signbit(std::atan2(y, x))) << y << " " << x;
    }
  }
}

TEST(Trig, ArctangentsAreRightToTwoAndAHalfUnits) {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const double x = random.Uniform(-20, 20) * (i % 7 == 0 ? 1e-9 : 1);
    const double y = random.Uniform(-20, 20) * (i % 3 == 0 ? 1e-5 : 1);
    EXPECT_LT(UnitsOff(Atan2(y, x), atan2l(y, x)), 2.5) << y << " " << x;
  }
}

/// The same hash on every processor and from every compiler; that of libm's results is another with
/// and without fused multiply-adds.
TEST(Trig, TheBitsAreTheseEverywhere) {
  Random random(4);
  std::uint64_t hash = Fnv1a("", 0);
  for (int i = 0; i < 4096; ++i) {
    const double a = random.Uniform(-20, 20), b = random.Uniform(-20, 20);
    const SinCos both = SineAndCosine(a);
    for (const double value : {both.sine, both.cosine, Atan2(a, b)}) {
      hash = Fnv1a(&value, sizeof value, hash);
    }
  }
  EXPECT_EQ(hash, 16213997707756920371u);
}

}  // namespace trig_test
}  // namespace seam
