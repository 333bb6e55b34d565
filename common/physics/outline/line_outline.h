#pragma once
/// The outline of lines that meet at their ends: both sides of each, and how they go on.
///
///        b <----- a        Each line has two edges, with air to the right of each: a-b and b-a. At
///        a b -----> a        joint an edge goes on along the next line; at a free end it turns
///        left.

#include <Eigen/Core>
#include <vector>

#include "common/physics/outline/solid_outline.h"

namespace seam {

struct OutlineLine {
  Eigen::Vector2d from{0, 0}, to{0, 0};  ///< m
  int group = 0;                         ///< as SolidPolygon::group
};

/// Returns the edges of each line: none if no other meets it. Ends less than `gap` (m) apart meet.
std::vector<SolidOutline> LineOutlinesOf(const std::vector<OutlineLine>& lines, double gap);

}  // namespace seam
