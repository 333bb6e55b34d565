#pragma once
/// Sine, cosine and arctangent made of sums and products alone: the same bits on every processor.
/// Those of libm differ in the last bit where it has fused multiply-adds, and simulations part by
/// it. Those of floats stay libm's, which computes them in doubles: the difference is rounded away.

#include <cmath>

namespace seam {

struct SinCos {
  double sine, cosine;
};

/// Returns both for `angle`, rad, to 1 unit in the last place for |angle| below 100000; beyond that
/// the error is less than half the distance between neighbouring angles. Not a number for infinite
/// angles. Reduction after Cody and Waite, then Taylor's series on [-pi/4, pi/4].
SinCos SineAndCosine(double angle);

inline double Sin(double angle) { return SineAndCosine(angle).sine; }
inline double Cos(double angle) { return SineAndCosine(angle).cosine; }
inline float Sin(float angle) { return std::sin(angle); }
inline float Cos(float angle) { return std::cos(angle); }

/// As std::atan2: the angle of (x, y), rad, -pi..pi, to 2 units in the last place.
double Atan2(double y, double x);

}  // namespace seam
