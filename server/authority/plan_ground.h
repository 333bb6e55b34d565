#pragma once
/// What several steps of one plan look at: the boxes in clusters, and what touches.

#include <optional>
#include <vector>

#include "server/authority/box_clusters.h"
#include "server/authority/plan.h"

namespace seam {

/// What touches now: boxes of two mechanisms that are not farther apart than kPressGap.
struct Touching {
  std::vector<int> lowest;   ///< by mechanism: the lowest of what it touches, directly or not
  std::vector<int> touched;  ///< of each pair of boxes that touch: the mechanism of one
};

/// Groups of the boxes are below `groups`.
Touching FindTouching(const std::vector<MovingBox>& boxes, const BoxClusters& clusters,
                      std::size_t groups);

class PlanGround {
 public:
  /// The view must outlive this.
  explicit PlanGround(const AuthorityView& view) : view_(view), clusters_(view.boxes) {}

  const AuthorityView& view() const { return view_; }
  const BoxClusters& clusters() const { return clusters_; }
  /// Found when it is first asked for.
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
