#pragma once
/// A contact of the engine as rows: for each of its points one row that keeps the bodies apart and
/// one of friction. The manifold stays for all substeps of a step; its points move with the bodies.

#include <vector>

#include "common/physics/exact/joint_rows.h"
#include "common/physics/exact/row.h"

namespace seam {

struct ExactContact {
  struct Point {
    /// Arms from the centres of mass, m: the part that turns with the body (in its frame), and the
    /// part that does not, the radius of a disc, which touches at another of its points each time.
    double ax = 0, ay = 0, bx = 0, by = 0;
    double still_ax = 0, still_ay = 0, still_bx = 0, still_by = 0;
    double apart = 0;     ///< m: the separation less the points' distance along the normal
    double approach = 0;  ///< m/s along the normal before the step, negative: towards each other
  };
  b2Contact* made = nullptr;
  int a = -1, b = -1;  ///< indices into the island's list of bodies
  int count = 0;
  double nx = 0, ny = 1;
  double friction = 0, restitution = 0, threshold = 0, belt = 0;  ///< m/s: threshold, belt
  bool returns = false;  ///< full restitution even for slow impacts, as there is no gravity
  Point point[b2_maxManifoldPoints];
};

/// Reads the manifold; the bodies must be where the engine has them. `rest`: the speed, m/s, that
/// gravity gives a resting body. Slower impacts have no restitution; the engine's threshold applies
/// if it is lower.
void ReadContact(const std::vector<ExactBody>& bodies, double rest, ExactContact* contact);

/// Writes 2 * count rows, normal and friction of each point, for a substep of pace.h.
void FillContact(const ExactContact& contact, const std::vector<ExactBody>& bodies,
                 const Pace& pace, Row* rows);

/// Returns the target speed, m/s, at which two points part: a gap is closed in a substep, an
/// overlap is undone slowly.
double NormalTarget(double separation, const Pace& pace);

/// Loads `share` of the manifold's impulses into the rows (warm start); StoreImpulses writes them
/// back.
void LoadImpulses(const ExactContact& contact, double share, Row* rows);
void StoreImpulses(const ExactContact& contact, const Row* rows);

}  // namespace seam
