#pragma once
/// Force of water on one body in one step: buoyancy, form drag, friction, viscosity. Pure
/// arithmetic, for any engine.

#include <Eigen/Core>

#include "common/base/geometry.h"
#include "common/scene/water.h"
#include "common/stages/water/wet_shape.h"

namespace seam {

/// A rigid body in water.
struct FloatingBody {
  Vec2d position{0, 0};          ///< m; origin of the shape's frame
  Rotation<double> rotation;     ///< body's angle
  Vec2d centre{0, 0};            ///< m; centre of mass, in the world
  Vec2d velocity{0, 0};          ///< m/s; velocity of the centre of mass
  double spin = 0;               ///< rad/s
  double mass = 0, inertia = 0;  ///< kg, kg m^2 about the centre of mass

  Vec2d ToWorld(const Vec2d& p) const { return position + rotation(p); }
};

Bounds BoundsOf(const Water& water);

/// Returns the displaced area. `cells`: as the water's method needs them, else nullptr.
AreaMoments Displaced(const WetShape& shape, const WetCells* cells, const FloatingBody& body,
                      const Bounds& water);

struct Push {
  Vec2d force{0, 0};  ///< N, at the centre of mass
  double torque = 0;  ///< N m
};

/// Sum of the forces of several waters on one body. With u the velocity of a point of the body
/// relative to the flow, n the edge's outward normal, t its direction and rho the density:
///
///   buoyancy    -rho * gravity * displaced area, at its centre
///   form drag   -rho/2 * drag_normal * (u.n)^2 n per length of wet edge where u.n > 0: pressure
///               on edges that move against the water, no suction behind them
///   friction    -rho/2 * drag_tangent * |u.t| (u.t) t per length of wet edge
///   viscosity   -viscosity * u per displaced area
///
/// Integrals along an edge and over an area are exact, for spin too. No added mass.
class WaterSum {
 public:
  /// `gravity`: m/s^2. Both must outlive the sum.
  WaterSum(const FloatingBody& body, const Vec2d& gravity) : body_(body), gravity_(gravity) {}

  void Add(const WetShape& shape, const WetCells* cells, const Water& water);
  bool empty() const { return empty_; }

  /// Returns the constant force over the next step of `h` s. Explicit drag is unstable for h >
  /// vt/g; this is linearly implicit (Rosenbrock 1963, one stage): with M the masses, F all forces
  /// and K the drag's slope by velocity, the change of velocity is (M + h K)^-1 h F. Never reverses
  /// a relative velocity, never adds energy in still water, and is exact at terminal speed. F
  /// excludes joints and contacts.
  Push Over(double h) const;

 private:
  void AddEdge(const WetEdge& edge, const Bounds& bounds, const Water& water);
  void Resist(const Vec2d& arm, const Vec2d& way, double speed, double factor);
  void AddLinear(const Eigen::Vector3d& row, double speed, double factor);
  Vec2d Relative(const Vec2d& arm, const Water& water) const;

  const FloatingBody& body_;
  const Vec2d& gravity_;
  bool empty_ = true;
  Push lift_;                                        // buoyancy
  Eigen::Vector3d drag_{0, 0, 0};                    // N, N, N m
  Eigen::Matrix3d slope_ = Eigen::Matrix3d::Zero();  // -d drag / d velocity
};

}  // namespace seam
