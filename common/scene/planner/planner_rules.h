#pragma once
/// How authority is planned where it follows the players and not rectangles, and how far one hears:
/// [planner] of a scene.

namespace seam {

struct PlannerRules {
  bool given = false;    ///< the scene says here more than `hear`: its regions do not decide
  float acquire = 24;    ///< m; what is awake goes to the nearest player within this
  float keep = 36;       ///< m; and stays until it is farther than this, at least `acquire`
  double dwell_s = 0.5;  ///< an authority lasts at least so long
  /// m; in a room that is not followed whole, what is farther than this from all that a client
  /// has and drives, and maybe than twice this, is nothing to it, and told to it seldom.
  float hear = 120;
  int capacity = 0;      ///< bodies that a client may be given to step; 0: as it measures itself
};

}  // namespace seam
