#pragma once
/// Data shared by the steps of one plan: the boxes in clusters, and the touching boxes.

#include <optional>
#include <vector>

#include "server/authority/box_clusters.h"
#include "server/authority/plan.h"

namespace seam {

/// Touching boxes: of two mechanisms and at most kPressGap apart.
struct Touching {
  std::vector<int> lowest;   ///< by mechanism: lowest in its component of touching ones
  std::vector<int> touched;  ///< one mechanism of each pair of touching boxes
};

/// Requires that all groups of the boxes are below `groups`.
Touching FindTouching(const std::vector<MovingBox>& boxes, const BoxClusters& clusters,
                      std::size_t groups);

class PlanGround {
 public:
  /// `view` must outlive this object.
  explicit PlanGround(const AuthorityView& view) : view_(view), clusters_(view.boxes) {}

  const AuthorityView& view() const { return view_; }
  const BoxClusters& clusters() const { return clusters_; }
  /// Computed at the first call.
  const Touching& touching() const {
    if (!touching_) touching_ = FindTouching(view_.boxes, clusters_, view_.mechanisms.size());
    return *touching_;
  }

 private:
  const AuthorityView& view_;
  const BoxClusters clusters_;
  mutable std::optional<Touching> touching_;
};

}  // namespace seam
