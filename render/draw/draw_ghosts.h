#pragma once
/// Where the oracle has what a view shows: body by body, or part by part where the oracle's bodies
/// are others.

#include <functional>
#include <optional>

#include "render/playback/playback.h"

namespace seam {

/// Called with a body (or one part of it, in the body's frame), the frame's pose in truth and as
/// shown; nullopt: it is not shown.
using GhostVisitor =
    std::function<void(const BodyShapes&, const Pose& truth, const std::optional<Pose>& shown)>;

/// Visits all of the revision's moving bodies of which the oracle knows where they are.
void VisitTruth(const Playback& playback, const DrawnRevision& revision, const Moment& moment,
                double tick, const GhostVisitor& visit);

}  // namespace seam
