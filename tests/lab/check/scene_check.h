#pragma once
/// Finds likely mistakes in a scene that loads and runs. Each check is a file of its own; findings
/// carry the line number in the scene file.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

struct Finding {
  int line = 0;      ///< in the scene file
  std::string text;  ///< one line: the mistake, and the remedy if known
  PartId reversed = -1;  ///< a chain that faces the wrong way: what is in it is no other mistake
};

/// Returns all findings, by line, except those with a comment "check: meant" on their line or on
/// the line above.
std::vector<Finding> CheckMeaning(const Scene& scene);

// The checks; each adds its findings.

/// Bodies that begin in one another or in anchored parts, but for chains that are found reversed.
void FindOverlaps(const Scene& scene, std::vector<Finding>* findings);
/// Bodies whose middle begins in a brick.
void FindInBricks(const Scene& scene, std::vector<Finding>* findings);
/// Chains whose solid side is where the bodies are, and bodies below terrain that nothing catches.
void FindWrongSides(const Scene& scene, std::vector<Finding>* findings);
/// Angles of more than a turn: they may be meant in degrees.
void FindDegrees(const Scene& scene, std::vector<Finding>* findings);
/// Players' regions that overlap, or leave a gap that is narrower than a hand-over needs.
void FindRegions(const Scene& scene, std::vector<Finding>* findings);
/// Players without anything to drive, triggers that nothing can enter or that do nothing, seats
/// that drive nothing.
void FindUnused(const Scene& scene, std::vector<Finding>* findings);
/// Scripts that do not compile, are stopped in a dry room, or use names that nothing has.
void FindInScripts(const Scene& scene, std::vector<Finding>* findings);
/// Joints that begin outside their limits, or with limits that can never be reached.
void FindJointLimits(const Scene& scene, std::vector<Finding>* findings);

}  // namespace seam
