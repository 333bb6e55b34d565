#pragma once
/// The oracle's poses of a view's bodies: body by body, or part by part where the oracle's bodies
/// have other parts.

#include <functional>
#include <optional>

#include "render/playback/playback.h"

namespace seam {

/// Receives a body (or one part of it, in the body's frame), and the pose of the frame in the
/// oracle and in the view; nullopt: not shown.
using GhostVisitor =
    std::function<void(const BodyShapes&, const Pose& truth, const std::optional<Pose>& shown)>;

/// Visits all moving bodies of the revision that the oracle has, each at the tick whose pose the
/// view shows.
void VisitTruth(const Playback& playback, const DrawnRevision& revision, const Moment& moment,
                const GhostVisitor& visit);

}  // namespace seam
