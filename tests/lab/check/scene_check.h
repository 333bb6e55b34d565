#pragma once
/// What a scene says that runs but is surely not meant. Each question is a file of its own; a scene
/// is answered for by the numbers of its file's lines.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

struct Finding {
  int line = 0;      ///< in the scene file
  std::string text;  ///< one line: what is wrong, and what to do where that is known
};

/// All findings, by line. Left out are those on whose line, or on the one above it, the file has a
/// comment with "check: meant".
std::vector<Finding> CheckMeaning(const Scene& scene);

// Its questions; each adds what it finds.

/// Bodies that begin in one another or in what is anchored.
void FindOverlaps(const Scene& scene, std::vector<Finding>* findings);
/// Bodies whose middle begins in a brick.
void FindInBricks(const Scene& scene, std::vector<Finding>* findings);
/// Chains whose solid side is where the bodies are, and bodies below terrain that nothing catches.
void FindWrongSides(const Scene& scene, std::vector<Finding>* findings);
/// Players' regions that overlap, or leave a gap that is narrower than a hand-over needs.
void FindRegions(const Scene& scene, std::vector<Finding>* findings);
/// Players without anything to drive, triggers that nothing can enter or that do nothing, seats
/// that drive nothing.
void FindUnused(const Scene& scene, std::vector<Finding>* findings);
/// Limits of joints that what they join begins outside of, or can never come to.
void FindJointLimits(const Scene& scene, std::vector<Finding>* findings);

}  // namespace seam
