#pragma once
/// Angles, rotations and rigid motions of the plane. All arithmetic is in the given scalar type and
/// in one fixed order, so that all peers get the same bits.

#include <Eigen/Core>
#include <cmath>

#include "common/base/trig.h"

namespace seam {

constexpr double kPi = 3.14159265358979323846;
constexpr float kPiFloat = static_cast<float>(kPi);

/// Returns the angle without whole turns, in -pi..pi, rad. NaN for an angle that is not finite.
inline double WrapAngle(double angle) {
  return std::fabs(angle) <= kPi ? angle : std::remainder(angle, 2 * kPi);
}
inline float WrapAngle(float angle) {
  return std::fabs(angle) <= kPiFloat ? angle : std::remainder(angle, 2 * kPiFloat);
}

/// Returns `angle` plus the whole turns that bring it nearest to `near`, rad.
inline double UnwrapAngle(double angle, double near) { return near + WrapAngle(angle - near); }
inline float UnwrapAngle(float angle, float near) { return near + WrapAngle(angle - near); }

/// A counter-clockwise rotation about the origin. Cosine and sine are computed once, for use on
/// several vectors.
template <class Scalar>
struct Rotation {
  using Vector = Eigen::Matrix<Scalar, 2, 1>;

  Scalar cosine = 1, sine = 0;

  Rotation() = default;
  /// Takes a cosine and sine computed elsewhere.
  Rotation(Scalar c, Scalar s) : cosine(c), sine(s) {}
  explicit Rotation(Scalar angle) : cosine(Cos(angle)), sine(Sin(angle)) {}

  Vector operator()(const Vector& v) const {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
  }
  /// Returns `v` rotated by the same angle clockwise.
  Vector Back(const Vector& v) const {
    return {cosine * v.x() + sine * v.y(), cosine * v.y() - sine * v.x()};
  }
};

/// Returns `v` rotated counter-clockwise by `angle`, rad.
inline Eigen::Vector2d Turned(const Eigen::Vector2d& v, double angle) {
  return Rotation<double>(angle)(v);
}
inline Eigen::Vector2f Turned(const Eigen::Vector2f& v, float angle) {
  return Rotation<float>(angle)(v);
}

/// A rigid motion of the plane: p -> p rotated by `angle`, then moved by `shift`. Also the pose of
/// a frame: it maps the frame's coordinates to its parent's.
struct Transform2 {
  Eigen::Vector2d shift{0, 0};  ///< m
  double angle = 0;             ///< rad, not wrapped

  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const { return shift + Turned(p); }
  /// Maps a direction: rotates it without moving it.
  Eigen::Vector2d Turned(const Eigen::Vector2d& v) const { return seam::Turned(v, angle); }
  /// Returns the composition: first `inner`, then this.
  Transform2 Then(const Transform2& inner) const {
    return {(*this)(inner.shift), angle + inner.angle};
  }
  Transform2 Inverse() const { return {-seam::Turned(shift, -angle), -angle}; }
};

/// Returns the third component of a x b: twice the area of the triangle 0 a b, positive if it is
/// counter-clockwise.
template <class A, class B>
typename A::Scalar Cross(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace seam
