#pragma once
/// A contact of the engine as rows: one that keeps the bodies apart and one of friction for each of
/// its points. The manifold stays for all substeps of a step; its points move with the bodies.

#include <vector>

#include "common/physics/exact/joint_rows.h"
#include "common/physics/exact/row.h"

namespace seam {

struct ExactContact {
  struct Point {
    /// From the centres of mass, m: what turns with the body (in its frame), and what does not: the
    /// radius of a disc, which touches at another of its points each time.
    double ax = 0, ay = 0, bx = 0, by = 0;
    double still_ax = 0, still_ay = 0, still_bx = 0, still_by = 0;
    double apart = 0;  ///< m: the separation less what the points' positions along the normal give
    double approach = 0;  ///< m/s along the normal before the step, negative: towards each other
  };
  b2Contact* made = nullptr;
  int a = -1, b = -1;  ///< in the island's list
  int count = 0;
  double nx = 0, ny = 1;
  double friction = 0, restitution = 0, threshold = 0, belt = 0;  ///< m/s: threshold, belt
  bool returns = false;  ///< all of it: full restitution, where nothing weighs
  Point point[b2_maxManifoldPoints];
};

/// Reads the manifold, the bodies being where the engine has them. `rest`: m/s, at which gravity
/// makes something hit in a step that lies: slower blows have no restitution (nor have those below
/// the engine's threshold, where that is less).
void ReadContact(const std::vector<ExactBody>& bodies, double rest, ExactContact* contact);

/// Writes 2 * count rows: normal, friction of each point. A substep of h.
void FillContact(const ExactContact& contact, const std::vector<ExactBody>& bodies,
                 const Pace& pace, Row* rows);

/// The speed, m/s, at which two points part: a gap is used up in a substep, an overlap undone
/// slowly.
double NormalTarget(double separation, const Pace& pace);

/// Warm start from the manifold, `share` of its impulses; and back.
void LoadImpulses(const ExactContact& contact, double share, Row* rows);
void StoreImpulses(const ExactContact& contact, const Row* rows);

}  // namespace seam
