#pragma once
/// Rules of authority that follows the players instead of regions, and the radius of interest:
/// [planner] of a scene.

namespace seam {

struct PlannerRules {
  bool given = false;    ///< the scene sets more than `hear`: regions do not decide
  float acquire = 24;    ///< m; an awake body goes to the nearest player within this
  float keep = 36;       ///< m; and stays until it is farther away; at least `acquire`
  double dwell_s = 0.5;  ///< shortest duration of an authority
  /// m; radius of interest, in rooms too large to follow whole. A body farther away from all that a
  /// client owns and drives is out of its interest, perhaps only beyond twice this; the client
  /// receives it rarely.
  float hear = 120;
  int capacity = 0;      ///< most bodies that a client may simulate; 0: as it measures itself
};

}  // namespace seam
