#pragma once
/// The bodies that a picture of a session has to show, and the box around them: over time, in
/// several views and in the oracle.

#include <functional>
#include <set>
#include <vector>

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// A box of the world, m.
struct WorldBox {
  Vec2 min{1e9f, 1e9f}, max{-1e9f, -1e9f};

  bool empty() const { return min.x() > max.x(); }
  Vec2 size() const { return max - min; }
  Vec2 centre() const { return (min + max) / 2; }
  void Add(const Vec2& p, float radius);
  /// Adds a body's outlines at a pose.
  void Add(const BodyShapes& body, const Pose& pose);
  void Add(const WorldBox& other);
};

/// One world of the page.
struct CameraView {
  const Playback* playback = nullptr;
  int peer = 0;
};

/// Samples of a session's time for cameras, 1/s.
constexpr double kSamplesPerSecond = 30;
/// Returns the times from from_s on, 1 / kSamplesPerSecond apart, to to_s or just beyond it.
std::vector<double> SampleTimes(double from_s, double to_s);

/// Gets a body, a pose of it, and 0 if that is the oracle's, 1 if it is the view's.
using PoseVisit = std::function<void(const BodyShapes&, const Pose&, int)>;
/// Visits the poses of each body (of `only`, if given) in the oracle and in the view.
void ForEachPose(const CameraView& view, const std::set<PartId>* only, double s,
                 const PoseVisit& visit);

/// Returns the bodies that move noticeably in from_s..to_s, in the oracle or in one of the views.
std::set<PartId> MovingBodies(const std::vector<CameraView>& views, double from_s, double to_s);

/// Returns the bodies of the players' vehicles, with their whole mechanisms, before any edit.
std::set<PartId> VehicleBodies(const Playback& playback);

/// Returns the players' vehicles, and the body that is farthest from the oracle in from_s..to_s in
/// one of the views, if it is 0.1 m or more: a picture that fits what moves never leaves these out.
std::set<PartId> LeadingBodies(const std::vector<CameraView>& views, double from_s, double to_s);

/// Returns the box of `bodies` at a moment, in the oracle and in all views. Empty without any.
WorldBox BoxOf(const std::vector<CameraView>& views, const std::set<PartId>& bodies, double s);

}  // namespace seam
